// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Drawing a deformable grain.
#include <flexpm/yade/LaguerreCell.hpp>

#include <flexpm/kernel/grain_access.hpp>
#include <flexpm/yade/Gl1_LaguerreCell.hpp>
#include <flexpm/yade/GrainSolver.hpp>

#include <GL/gl.h>

namespace yade {

YADE_PLUGIN((Gl1_LaguerreCell));

bool Gl1_LaguerreCell::mesh  = false;
Real Gl1_LaguerreCell::scale = 1.;

Gl1_LaguerreCell::~Gl1_LaguerreCell() = default;

void Gl1_LaguerreCell::go(const shared_ptr<Shape>& shape, const shared_ptr<State>& state, bool wire, const GLViewInfo&)
{
	const int   grain = static_cast<const LaguerreCell&>(*shape).grain;
	const auto& a     = GrainSolver::ofScene(*Omega::instance().getScene())->assembly;
	// OpenGL's origin is the body's position
	const auto vertex = [&](int n) {
		const int node = a.node(grain, n);
		glVertex3d(
		        a.reference[node] + scale * a.displacement[node] - state->pos[0],
		        a.reference[node + flexpm::lanes] + scale * a.displacement[node + flexpm::lanes] - state->pos[1],
		        0.);
	};
	const auto draw = [&](GLenum kind) {
		for (int t = 0; t < flexpm::triangles_of(a, grain); ++t) {
			glBegin(kind);
			for (int n : flexpm::triangle_nodes(a, grain, t))
				vertex(n);
			glEnd();
		}
	};
	glDisable(GL_LIGHTING);
	glColor3d(shape->color[0], shape->color[1], shape->color[2]);
	if (!wire) draw(GL_TRIANGLES);
	glColor3d(.15, .15, .15);
	if (wire || mesh) draw(GL_LINE_LOOP);
	glBegin(GL_LINE_LOOP);
	for (int n = 0; n < a.group(a.grain_slot[grain] / flexpm::lanes).vertices; ++n)
		vertex(n);
	glEnd();
	glEnable(GL_LIGHTING);
}

} // namespace yade
