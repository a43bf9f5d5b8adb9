// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Drawing a deformable grain.
#include <flexpm/yade/grains/LaguerreCell.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/yade/grains/AssemblyOwner.hpp>
#include <flexpm/yade/grains/Gl1_LaguerreCell.hpp>

#include <GL/gl.h>

namespace yade {

YADE_PLUGIN((Gl1_LaguerreCell));

bool Gl1_LaguerreCell::mesh  = false;
Real Gl1_LaguerreCell::scale = 1.;

namespace {

	/// Draws nodes of one grain about its body's position, which is OpenGL's origin.
	struct Pen {
		const flexpm::Grains& grains;
		int                   grain;
		Vector3r              origin;
		Real                  scale;

		void vertex(int n) const
		{
			const int  node = grains.node(grain, n);
			const auto p = flexpm::vector_at(grains.reference, node), u = flexpm::vector_at(grains.displacement, node);
			glVertex3d(p.x + scale * u.x - origin[0], p.y + scale * u.y - origin[1], 0.);
		}

		void triangles(GLenum kind) const
		{
			for (int t = 0; t < flexpm::triangles_of(grains, grain); ++t) {
				glBegin(kind);
				for (int n : flexpm::triangle_nodes(grains, grain, t))
					vertex(n);
				glEnd();
			}
		}

		void outline() const
		{
			glBegin(GL_LINE_LOOP);
			for (int n = 0; n < grains.vertices_of(grain); ++n)
				vertex(n);
			glEnd();
		}
	};

} // namespace

Gl1_LaguerreCell::~Gl1_LaguerreCell() = default;

void Gl1_LaguerreCell::go(const shared_ptr<Shape>& shape, const shared_ptr<State>& state, bool wire, const GLViewInfo&)
{
	const int grain = static_cast<const LaguerreCell&>(*shape).grain;
	// a window must not fail when a script has taken the solver out of O.engines
	const auto owned = findAssembly(*Omega::instance().getScene());
	if (!owned.engine || grain < 0 || grain >= owned->grains.count) return;
	const Pen pen { owned->grains, grain, state->pos, scale };
	glDisable(GL_LIGHTING);
	glColor3d(shape->color[0], shape->color[1], shape->color[2]);
	glEnable(GL_POLYGON_OFFSET_FILL); // lines lie in the plane of the faces and must win
	glPolygonOffset(1.f, 2.f);
	if (!wire) pen.triangles(GL_TRIANGLES);
	glDisable(GL_POLYGON_OFFSET_FILL);
	glColor3d(.15, .15, .15);
	if (wire || mesh) pen.triangles(GL_LINE_LOOP);
	pen.outline();
	glEnable(GL_LIGHTING);
}

} // namespace yade
