// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Drawing a bond.
#include <flexpm/yade/grains/LaguerreCell.hpp>
#include <flexpm/yade/grains/LobattoContact.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/view/bond_lines.hpp>
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
	struct Shown {
		const flexpm::Assembly* of      = nullptr;
		int                     first   = -1; ///< contact with which the picture has begun
		long                    step    = -1;
		Real                    largest = 0.;

		void update(const flexpm::Assembly& assembly, int contact)
		{
			if (of == &assembly && contact != first && step == long(assembly.step)) return;
			of      = &assembly;
			first   = contact;
			step    = long(assembly.step);
			largest = flexpm::largest_contact_force(assembly);
		}
	};
	Shown shown;

	void draw(const flexpm::Line& line, Real width)
	{
		glLineWidth(float(width));
		glBegin(GL_LINES);
		glVertex3d(line.from.x, line.from.y, 0.);
		glVertex3d(line.to.x, line.to.y, 0.);
		glEnd();
		glLineWidth(1.f);
	}

	void drawForce(const flexpm::Assembly& assembly, int place)
	{
		const Real force = flexpm::normal_force(assembly, place);
		if (force == 0. || shown.largest == 0.) return;
		if (force < 0.)
			glColor3d(0., 0., 0.);
		else
			glColor3d(.85, .1, .1);
		draw(flexpm::branch_line(assembly, place, Gl1_LaguerreCell::scale), Gl1_LobattoPhys::forceWidth * std::abs(force) / shown.largest);
	}

	void drawCracks(const flexpm::Assembly& assembly, int place)
	{
		const auto& contacts = assembly.contacts;
		for (int p = 0; p < contacts.points_of(place); ++p) {
			const auto mode = contacts.crack(place, p).mode;
			if (mode != flexpm::tensile_crack && mode != flexpm::shear_crack) continue;
			if (mode == flexpm::tensile_crack)
				glColor3d(0., .447, .698);
			else
				glColor3d(.835, .369, 0.);
			draw(flexpm::point_line(assembly, place, p, Gl1_LaguerreCell::scale), Gl1_LobattoPhys::crackWidth);
		}
	}

} // namespace

Gl1_LobattoPhys::~Gl1_LobattoPhys() = default;

void Gl1_LobattoPhys::go(const shared_ptr<IPhys>& phys, const shared_ptr<Interaction>&, const shared_ptr<Body>&, const shared_ptr<Body>&, bool)
{
	const auto owned = findAssembly(*Omega::instance().getScene());
	if (!owned.engine) return;
	const int contact = static_cast<const LobattoPhys&>(*phys).contact, place = flexpm::contact_with_id(*owned, contact);
	if (place < 0) return;
	shown.update(*owned, contact);
	glDisable(GL_LIGHTING);
	glDepthFunc(GL_ALWAYS); // the grains lie in the same plane
	if (forces) drawForce(*owned, place);
	if (cracks) drawCracks(*owned, place);
	glDepthFunc(GL_LESS);
	glEnable(GL_LIGHTING);
}

} // namespace yade
