// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Drawing a deformable grain.
#include <flexpm/yade/grains/LaguerreCell.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/view/colours.hpp>
#include <flexpm/kernel/view/grain_values.hpp>
#include <flexpm/yade/grains/AssemblyOwner.hpp>
#include <flexpm/yade/grains/Gl1_LaguerreCell.hpp>
#include <flexpm/yade/grains/GlScale.hpp>

#include <GL/gl.h>

#include <mutex>

namespace yade {

YADE_PLUGIN((Gl1_LaguerreCell));

bool     Gl1_LaguerreCell::mesh  = false;
Real     Gl1_LaguerreCell::scale = 1.;
string   Gl1_LaguerreCell::colour;
bool     Gl1_LaguerreCell::autoRange = true;
Vector2r Gl1_LaguerreCell::range;
Vector3r Gl1_LaguerreCell::textColor;

namespace {

	/// Draws nodes of one grain about its body's position, which is OpenGL's origin.
	struct Pen {
		const flexpm::Grains& grains;
		int                   grain;
		Vector3r              origin;
		Real                  scale;

		void vertex(int n) const
		{
			const auto p = flexpm::drawn_position(grains, grains.node(grain, n), scale);
			glVertex3d(p.x - origin[0], p.y - origin[1], 0.);
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

		/// Triangles of a rigid grain, which has none of its own: about its centre, which sees all corners.
		void fan() const
		{
			glBegin(GL_TRIANGLE_FAN);
			vertex(grains.vertices_of(grain));
			for (int n = 0; n <= grains.vertices_of(grain); ++n)
				vertex(n % grains.vertices_of(grain));
			glEnd();
		}

		void outline() const
		{
			glBegin(GL_LINE_LOOP);
			for (int n = 0; n < grains.vertices_of(grain); ++n)
				vertex(n);
			glEnd();
		}
	};

	/// What the picture shows that is being drawn: YADE draws one grain after the other.
	struct Shown {
		const flexpm::Assembly*           of    = nullptr;
		int                               first = -1; ///< grain with which the picture has begun
		string                            colour;
		std::optional<flexpm::GrainValue> what;
		std::vector<double>               values;

		/// Whether this grain is the first of a picture.
		bool begins(const flexpm::Assembly& assembly, int grain, const string& asked)
		{
			if (of == &assembly && grain != first && asked == colour) return false;
			of     = &assembly;
			first  = grain;
			colour = asked;
			what   = flexpm::grain_value(asked);
			return true;
		}
	};
	Shown shown;

	void beginPicture(const flexpm::Assembly& assembly)
	{
		if (!shown.what) return;
		// contacts come and go while a simulation runs
		const std::lock_guard<std::mutex> lock(Omega::instance().getScene()->interactions->drawloopmutex);
		shown.values = flexpm::grain_values(assembly, *shown.what);
		if (!Gl1_LaguerreCell::autoRange) return;
		const auto found        = flexpm::range_of(shown.values);
		Gl1_LaguerreCell::range = Vector2r(found.low, found.high);
	}

	void drawScale(const flexpm::Assembly& assembly, const Vector3r& origin)
	{
		glPushMatrix();
		glTranslated(-origin[0], -origin[1], -origin[2]);
		const auto& range = Gl1_LaguerreCell::range;
		GlScale(flexpm::extent_of(assembly.grains), Gl1_LaguerreCell::textColor).draw(*shown.what, { range[0], range[1] });
		glPopMatrix();
	}

	void setColour(const Shape& shape, int grain)
	{
		if (!shown.what) return glColor3d(shape.color[0], shape.color[1], shape.color[2]);
		const auto&  range = Gl1_LaguerreCell::range;
		const double value = shown.values[grain];
		const auto   c     = flexpm::is_kind(*shown.what) ? flexpm::colour_of_kind(int(value)) : flexpm::colour_of(value, { range[0], range[1] });
		glColor3d(c.red, c.green, c.blue);
	}

	/// Undo the rotation of the body: the nodes of a rigid grain have turned with it already.
	void turnBack(const State& state)
	{
		const AngleAxisr turn(state.ori.conjugate());
		glRotated(turn.angle() * Mathr::RAD_TO_DEG, turn.axis()[0], turn.axis()[1], turn.axis()[2]);
	}

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
	turnBack(*state);
	if (shown.begins(*owned, grain, colour)) {
		beginPicture(*owned);
		if (shown.what) drawScale(*owned, state->pos);
	}
	setColour(*shape, grain);
	glEnable(GL_POLYGON_OFFSET_FILL); // lines lie in the plane of the faces and must win
	glPolygonOffset(1.f, 2.f);
	if (!wire) owned->grains.is_rigid(grain) ? pen.fan() : pen.triangles(GL_TRIANGLES);
	glDisable(GL_POLYGON_OFFSET_FILL);
	glColor3d(.15, .15, .15);
	if (wire || mesh) pen.triangles(GL_LINE_LOOP);
	pen.outline();
	glEnable(GL_LIGHTING);
}

} // namespace yade
