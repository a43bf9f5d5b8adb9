// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Drawing a bond.
#include <flexpm/yade/grains/LaguerreCell.hpp>
#include <flexpm/yade/grains/LobattoContact.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/view/bond_forces.hpp>
#include <flexpm/kernel/view/bond_lines.hpp>
#include <flexpm/kernel/view/solid_faces.hpp>
#include <flexpm/yade/grains/AssemblyOwner.hpp>
#include <flexpm/yade/grains/Gl1_LaguerreCell.hpp>
#include <flexpm/yade/grains/Gl1_LobattoPhys.hpp>

#include <GL/gl.h>

namespace yade {

YADE_PLUGIN((Gl1_LobattoPhys));

bool Gl1_LobattoPhys::cracks     = true;
bool Gl1_LobattoPhys::forces     = false;
Real Gl1_LobattoPhys::crackWidth = 3.;
Real Gl1_LobattoPhys::forceWidth = 8.;

namespace {

	/// The largest force of the picture that is being drawn: YADE draws one bond after the other.
	struct BondPicture {
		const flexpm::Grains* of      = nullptr;
		int                   first   = -1; ///< contact with which the picture has begun
		long                  step    = -1;
		Real                  largest = 0.;
		std::vector<bool>     onSurface; ///< nodes of a solid
		Vector3r              toViewer;

		void look(const flexpm::Assembly&) { }
		void look(const flexpm::SolidState& state)
		{
			onSurface = flexpm::surface_nodes(state);
			toViewer  = Gl1_LaguerreCell::toViewer();
		}

		template <class State> void update(const OwnedAssembly& owned, const State& state, int contact)
		{
			if (of == &state.grains && contact != first && step == long(state.step)) return;
			of    = &state.grains;
			first = contact;
			step  = long(state.step);
			owned.showNodes();
			largest = flexpm::largest_contact_force(state);
			look(state);
		}
	};
	BondPicture picture;

	void draw(const Vector3r& from, const Vector3r& to, Real width)
	{
		glLineWidth(float(width));
		glBegin(GL_LINES);
		glVertex3d(from[0], from[1], from[2]);
		glVertex3d(to[0], to[1], to[2]);
		glEnd();
		glLineWidth(1.f);
	}

	void draw(const flexpm::Line& line, Real width) { draw(toYade(line.from), toYade(line.to), width); }
	void draw(const flexpm::Segment& line, Real width) { draw(toYade(line[0]), toYade(line[1]), width); }

	template <class State> void drawForce(const State& state, int place)
	{
		const Real force = flexpm::normal_force(state, place);
		if (force == 0. || picture.largest == 0.) return;
		if (force < 0.)
			glColor3d(0., 0., 0.);
		else
			glColor3d(.85, .1, .1);
		draw(flexpm::branch_line(state.grains, state.contacts.pairs[place], Gl1_LaguerreCell::scale),
		     Gl1_LobattoPhys::forceWidth * std::abs(force) / picture.largest);
	}

	void drawPart(const flexpm::Assembly& a, int place, int point, const Vector3r& colour)
	{
		Gl1_LaguerreCell::setColour(colour);
		draw(flexpm::point_line(a, place, point, Gl1_LaguerreCell::scale), Gl1_LobattoPhys::crackWidth);
	}

	/// The part of the face, the line of it in a section, and where it shows outside.
	void drawPart(const flexpm::SolidState& s, int place, int point, const Vector3r& colour)
	{
		const auto plane = Gl1_LaguerreCell::cut();
		const Real scale = Gl1_LaguerreCell::scale, width = Gl1_LobattoPhys::crackWidth;
		for (const auto& part : flexpm::point_part(s, place, point, scale)) {
			const auto left = flexpm::in_front(part, plane);
			if (left.empty()) continue;
			Gl1_LaguerreCell::setColour(Gl1_LaguerreCell::light(part, picture.toViewer) * colour);
			glBegin(GL_POLYGON);
			for (const auto& p : left)
				glVertex3d(p.x, p.y, p.z);
			glEnd();
			Gl1_LaguerreCell::setColour(colour);
			draw(flexpm::cut_line(part, plane), width);
		}
		for (const auto& line : flexpm::point_rim(s, place, point, scale, picture.onSurface))
			draw(flexpm::in_front(line, plane), width);
	}

	template <class State> void drawCracks(const State& state, int place)
	{
		const auto& contacts = state.contacts;
		for (int p = 0; p < contacts.points_of(place); ++p) {
			const auto mode = contacts.crack(place, p).mode;
			if (mode != flexpm::tensile_crack && mode != flexpm::shear_crack) continue;
			drawPart(state, place, p, mode == flexpm::tensile_crack ? Vector3r(0., .447, .698) : Vector3r(.835, .369, 0.));
		}
	}

} // namespace

Gl1_LobattoPhys::~Gl1_LobattoPhys() = default;

void Gl1_LobattoPhys::go(const shared_ptr<IPhys>& phys, const shared_ptr<Interaction>&, const shared_ptr<Body>&, const shared_ptr<Body>&, bool)
{
	const auto owned = findAssembly(*Omega::instance().getScene());
	if (!owned.engine) return;
	const int contact = static_cast<const LobattoPhys&>(*phys).contact, place = contactAt(owned, contact);
	if (place < 0) return;
	glDisable(GL_LIGHTING);
	glDepthFunc(owned.plane ? GL_ALWAYS : GL_LEQUAL); // grains of the plane lie in the same plane
	glPushAttrib(GL_ENABLE_BIT);
	glDisable(GL_CULL_FACE); // faces of cracks are seen from both sides
	owned.with([&](const auto& state) {
		picture.update(owned, state, contact);
		if (forces) drawForce(state, place);
		if (cracks) drawCracks(state, place);
	});
	glPopAttrib();
	glDepthFunc(GL_LESS);
	glEnable(GL_LIGHTING);
}

} // namespace yade
