// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Drawing a deformable grain.
#include <flexpm/yade/grains/LaguerreCell.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/view/colours.hpp>
#include <flexpm/kernel/view/grain_values.hpp>
#include <flexpm/kernel/view/solid_faces.hpp>
#include <flexpm/yade/grains/AssemblyOwner.hpp>
#include <flexpm/yade/grains/Gl1_LaguerreCell.hpp>
#include <flexpm/yade/grains/GlScale.hpp>

#include <GL/gl.h>

#include <cmath>
#include <mutex>
#include <optional>

namespace yade {

YADE_PLUGIN((Gl1_LaguerreCell));

bool     Gl1_LaguerreCell::mesh  = false;
Real     Gl1_LaguerreCell::scale = 1.;
string   Gl1_LaguerreCell::colour;
bool     Gl1_LaguerreCell::autoRange = true;
Vector2r Gl1_LaguerreCell::range;
Vector3r Gl1_LaguerreCell::cutNormal;
Real     Gl1_LaguerreCell::cutOffset = 0.;
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
			const auto p = grains.position(grains.node(grain, n), scale);
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

	/// Axes of the window in the scene: right, up, and towards the viewer.
	struct Window {
		Vector3r right, up, front;

		/// Those that OpenGL draws with, whatever the scale.
		static Window present()
		{
			double m[16];
			glGetDoublev(GL_MODELVIEW_MATRIX, m);
			const auto row = [&](int i) { return Vector3r(m[i], m[4 + i], m[8 + i]).normalized(); };
			return { row(0), row(1), row(2) };
		}
	};

	/// What the picture shows that is being drawn: YADE draws one grain after the other.
	struct Shown {
		const flexpm::Grains*             of    = nullptr;
		int                               first = -1; ///< grain with which the picture has begun
		string                            colour;
		std::optional<flexpm::GrainValue> what;
		std::vector<double>               values;
		// a solid has these, too
		std::vector<std::vector<flexpm::NodePair>> edges;
		Window                                     window;

		/// Whether this grain is the first of a picture.
		bool begins(const flexpm::Grains& grains, int grain, const string& asked)
		{
			if (of == &grains && grain != first && asked == colour) return false;
			of     = &grains;
			first  = grain;
			colour = asked;
			what   = flexpm::grain_value(asked, grains.layout.dimension);
			return true;
		}
	};
	Shown shown;

	void beginPicture(const OwnedAssembly& owned)
	{
		owned.showNodes();
		if (owned.space) {
			shown.edges  = flexpm::polyhedron_edges(*owned.space);
			shown.window = Window::present();
		}
		if (!shown.what) return;
		// contacts come and go while a simulation runs
		const std::lock_guard<std::mutex> lock(Omega::instance().getScene()->interactions->drawloopmutex);
		shown.values = owned.with([](const auto& state) { return flexpm::grain_values(state, *shown.what); });
		if (!Gl1_LaguerreCell::autoRange) return;
		const auto found        = flexpm::range_of(shown.values);
		Gl1_LaguerreCell::range = Vector2r(found.low, found.high);
	}

	/// The scale of a solid faces the viewer, beside the box around all grains as the window shows it.
	flexpm::Extent turnToViewer(const flexpm::SolidState& state)
	{
		const auto     box    = flexpm::extent_of(state.grains);
		const Window&  window = shown.window;
		const Vector3r low = toYade(box.low), half = .5 * (toYade(box.high) - low), middle = low + half;
		const Real     wide = half.dot(window.right.cwiseAbs()), high = half.dot(window.up.cwiseAbs());
		const double   axes[16] = { window.right[0], window.right[1], window.right[2], 0., window.up[0], window.up[1], window.up[2], 0.,
			                    window.front[0], window.front[1], window.front[2], 0., middle[0],    middle[1],    middle[2],    1. };
		glMultMatrixd(axes);
		return { { -wide, -high }, { wide, high } };
	}

	void drawScale(const OwnedAssembly& owned, const Vector3r& origin)
	{
		glPushMatrix();
		glTranslated(-origin[0], -origin[1], -origin[2]);
		const auto& range  = Gl1_LaguerreCell::range;
		const auto  extent = owned.space ? turnToViewer(*owned.space) : flexpm::extent_of(owned.grains());
		GlScale(extent, Gl1_LaguerreCell::textColor).draw(*shown.what, { range[0], range[1] });
		glPopMatrix();
	}

	Vector3r colourOf(const Shape& shape, int grain)
	{
		if (!shown.what) return shape.color;
		const auto&  range = Gl1_LaguerreCell::range;
		const double value = shown.values[grain];
		const auto   c     = flexpm::is_kind(*shown.what) ? flexpm::colour_of_kind(int(value)) : flexpm::colour_of(value, { range[0], range[1] });
		return Vector3r(c.red, c.green, c.blue);
	}

	/// Undo the rotation of the body: the nodes of a rigid grain have turned with it already.
	void turnBack(const State& state)
	{
		const AngleAxisr turn(state.ori.conjugate());
		glRotated(turn.angle() * Mathr::RAD_TO_DEG, turn.axis()[0], turn.axis()[1], turn.axis()[2]);
	}

	/// Polygons and lines of a polyhedron about its body's position.
	struct SolidPen {
		Vector3r origin;

		void vertex(const flexpm::Vector& p) const { glVertex3d(p.x - origin[0], p.y - origin[1], p.z - origin[2]); }

		void polygon(const flexpm::Polygon& corners, GLenum kind) const
		{
			glBegin(kind);
			for (const auto& p : corners)
				vertex(p);
			glEnd();
		}

		void fill(const flexpm::GrainFaces& faces, const Vector3r& colour) const
		{
			for (const auto& face : faces.outside) {
				Gl1_LaguerreCell::setColour(Gl1_LaguerreCell::light(face, shown.window.front) * colour);
				polygon(face, GL_POLYGON);
			}
			Gl1_LaguerreCell::setColour(colour);
			for (const auto& face : faces.section)
				polygon(face, GL_POLYGON);
		}

		void draw(const flexpm::GrainFaces& faces, const Vector3r& colour, bool wire) const
		{
			if (!wire) fill(faces, colour);
			glDisable(GL_POLYGON_OFFSET_FILL);
			glColor3d(.15, .15, .15);
			if (wire || Gl1_LaguerreCell::mesh) {
				for (const auto& face : faces.outside)
					polygon(face, GL_LINE_LOOP);
			}
			glBegin(GL_LINES);
			for (const auto& line : faces.lines)
				for (const auto& end : line)
					vertex(end);
			glEnd();
		}
	};

	void drawPlane(const Pen& pen, const Vector3r& colour, bool wire)
	{
		Gl1_LaguerreCell::setColour(colour);
		if (!wire) pen.grains.is_rigid(pen.grain) ? pen.fan() : pen.triangles(GL_TRIANGLES);
		glDisable(GL_POLYGON_OFFSET_FILL);
		glColor3d(.15, .15, .15);
		if (wire || Gl1_LaguerreCell::mesh) pen.triangles(GL_LINE_LOOP);
		pen.outline();
	}

} // namespace

Gl1_LaguerreCell::~Gl1_LaguerreCell() = default;

flexpm::CutPlane Gl1_LaguerreCell::cut()
{
	const Real size = cutNormal.norm();
	if (!(size > 0.)) return {};
	const Vector3r n = cutNormal / size;
	return { { n[0], n[1], n[2] }, cutOffset };
}

Real Gl1_LaguerreCell::light(const flexpm::Polygon& corners, const Vector3r& toViewer)
{
	return .65 + .35 * std::abs(toYade(flexpm::normal_of(corners)).dot(toViewer));
}

Vector3r Gl1_LaguerreCell::toViewer() { return Window::present().front; }

void Gl1_LaguerreCell::setColour(const Vector3r& colour) { glColor3d(colour[0], colour[1], colour[2]); }

void Gl1_LaguerreCell::go(const shared_ptr<Shape>& shape, const shared_ptr<State>& state, bool wire, const GLViewInfo&)
{
	const int grain = static_cast<const LaguerreCell&>(*shape).grain;
	// a window must not fail when a script has taken the solver out of O.engines
	const auto owned = findAssembly(*Omega::instance().getScene());
	if (!owned.engine || grain < 0 || grain >= owned.grains().count) return;
	glDisable(GL_LIGHTING);
	turnBack(*state);
	if (shown.begins(owned.grains(), grain, colour)) {
		beginPicture(owned);
		if (shown.what) drawScale(owned, state->pos);
	}
	glEnable(GL_POLYGON_OFFSET_FILL); // lines lie in the plane of the faces and must win
	glPolygonOffset(1.f, 2.f);
	if (owned.space)
		SolidPen { state->pos }.draw(flexpm::grain_faces(*owned.space, grain, shown.edges[grain], scale, cut()), colourOf(*shape, grain), wire);
	else
		drawPlane({ owned.grains(), grain, state->pos, scale }, colourOf(*shape, grain), wire);
	glEnable(GL_LIGHTING);
}

} // namespace yade
