// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What a bond's handles read of its points.
#include <flexpm/yade/grains/LobattoContact.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/view/snapshot.hpp>
#include <flexpm/yade/bindings/array_view.hpp>
#include <flexpm/yade/grains/AssemblyOwner.hpp>

#include <limits>

namespace yade {

namespace py = boost::python;
using flexpm_bindings::Access;

YADE_PLUGIN((LobattoGeom)(LobattoPhys));

namespace {

	using flexpm::Assembly;
	using flexpm::Contacts;
	using flexpm::FaceContacts;
	using flexpm::FaceRow;
	using flexpm::SolidState;
	using Numbers = std::vector<double>;

	/// (points,) or (points, columns) copy of what `value(state, place, point, all)` appends: the arrays move when contacts come and go.
	template <class T, class Value> py::object pointCopy(int contact, int columns, Value value)
	{
		const auto     owned = ownedContact(contact);
		std::vector<T> all;
		owned.with([&](const auto& state) {
			for (int p = 0; p < state.contacts.points_of(owned.place); ++p)
				value(state, owned.place, p, all);
		});
		return flexpm_bindings::copied(all, columns, Access::readOnly);
	}

	/// Components of a vector: of a contact of the plane, and of one of space.
	int columnsOf(int contact, int ofPlane, int ofSpace) { return ownedContact(contact).plane ? ofPlane : ofSpace; }

	/// What a contact of space has, and one of the plane tells in other words.
	OwnedContact requireSpace(int contact, const char* quantity)
	{
		const auto owned = ownedContact(contact);
		if (owned.plane) flexpm::refuse(quantity, "2D", "must be 3D; in 2D use ends, traction and area");
		return owned;
	}

	py::object vectorsOf(const std::vector<flexpm::Vector>& vectors)
	{
		Numbers all;
		for (const auto& v : vectors)
			all.insert(all.end(), { v.x, v.y, v.z });
		return flexpm_bindings::copied(all, 3, Access::readOnly);
	}

	// what a bond of the plane and one of space tell
	Vector3r normalOf(const Assembly& a, int place) { return toYade(a.contacts.normal(place)); }
	Vector3r normalOf(const SolidState& s, int place) { return toYade(flexpm::contact_normal(s, place)); }

	Vector3r middleOf(const Assembly& a, int place) { return .5 * (toYade(flexpm::contact_end(a, place, 0)) + toYade(flexpm::contact_end(a, place, 1))); }
	Vector3r middleOf(const SolidState& s, int place) { return toYade(flexpm::contact_middle(s, place)); }

	/// On the second grain.
	Vector3r forceOf(const Assembly& a, int place) { return toYade(flexpm::contact_force(a.contacts, place)); }
	Vector3r forceOf(const SolidState& s, int place) { return toYade(flexpm::contact_force(s, place)); }

	template <class State> Vector3r normalForceOf(const State& state, int place)
	{
		const Vector3r normal = normalOf(state, place);
		return forceOf(state, place).dot(normal) * normal;
	}

	template <class State> Vector3r shearForceOf(const State& state, int place) { return forceOf(state, place) - normalForceOf(state, place); }

	Real meanOpening(const Assembly& a, int place) { return flexpm::mean_opening(a.contacts, place); }
	Real meanOpening(const SolidState& s, int place) { return flexpm::mean_opening(s, place); }

	void addOpening(const Assembly& a, int place, int p, Numbers& all) { all.push_back(flexpm::opening_of(a.contacts, place, p)); }
	void addOpening(const SolidState& s, int place, int p, Numbers& all) { all.push_back(flexpm::places_of(s, place)[p].opening); }

	void addSlip(const Assembly& a, int place, int p, Numbers& all) { all.push_back(flexpm::slip_of(a.contacts, place, p)); }
	void addSlip(const SolidState& s, int place, int p, Numbers& all)
	{
		const auto slip = flexpm::places_of(s, place)[p].slip;
		all.insert(all.end(), { slip.x, slip.y });
	}

	void addDamage(const Assembly& a, int place, int p, Numbers& all) { all.push_back(flexpm::damage_of(a.contacts, place, p)); }
	void addDamage(const SolidState& s, int place, int p, Numbers& all) { all.push_back(flexpm::traction_of(s, place, p).damage); }

	void addTraction(const Assembly& a, int place, int p, Numbers& all)
	{
		const auto t = flexpm::traction_of(a.contacts, place, p);
		all.insert(all.end(), { t.normal, t.shear });
	}
	void addTraction(const SolidState& s, int place, int p, Numbers& all)
	{
		const auto t = flexpm::traction_of(s, place, p);
		all.insert(all.end(), { t.normal, t.shear.x, t.shear.y });
	}

	/// Radius of a sphere that has the volume of a grain.
	Real equalSphere(const Assembly& a, int grain) { return flexpm::equal_sphere(a, grain); }
	Real equalSphere(const SolidState& s, int grain) { return s.grains.radius[grain]; }

} // namespace

std::atomic<long>& destroyedContacts()
{
	static std::atomic<long> count { 0 };
	return count;
}

LobattoGeom::~LobattoGeom() { ++destroyedContacts(); }

Vector3r LobattoGeom::presentNormal() const
{
	const auto owned = ownedContact(contact);
	return owned.with([&](const auto& state) { return normalOf(state, owned.place); });
}

Vector3r LobattoGeom::presentContactPoint() const
{
	const auto owned = ownedContact(contact);
	return owned.with([&](const auto& state) { return middleOf(state, owned.place); });
}

Real LobattoGeom::presentPenetrationDepth() const
{
	const auto owned = ownedContact(contact);
	return owned.with([&](const auto& state) { return -meanOpening(state, owned.place); });
}

py::object LobattoGeom::ends() const
{
	const auto owned = ownedContact(contact);
	if (owned.space) flexpm::refuse("ends", "3D", "must be 2D; use corners for a 3D face");
	const auto start = flexpm::contact_end(*owned.plane, owned.place, 0), end = flexpm::contact_end(*owned.plane, owned.place, 1);
	return flexpm_bindings::copied(Numbers { start.x, start.y, end.x, end.y }, 2, Access::readOnly);
}

py::object LobattoGeom::corners() const
{
	const auto owned = requireSpace(contact, "corners");
	return vectorsOf(flexpm::middle_face(*owned.space, owned.place));
}

py::object LobattoGeom::points() const
{
	const auto                  owned  = requireSpace(contact, "points");
	const auto                  middle = flexpm::middle_face(*owned.space, owned.place);
	std::vector<flexpm::Vector> all;
	for (int p = 0; p < owned.space->contacts.points_of(owned.place); ++p)
		all.push_back(flexpm::point_place(owned.space->contacts, owned.place, p, middle));
	return vectorsOf(all);
}

LobattoPhys::~LobattoPhys() { ++destroyedContacts(); }

Vector3r LobattoPhys::presentNormalForce() const
{
	const auto owned = ownedContact(contact);
	return owned.with([&](const auto& state) { return normalForceOf(state, owned.place); });
}

Vector3r LobattoPhys::presentShearForce() const
{
	const auto owned = ownedContact(contact);
	return owned.with([&](const auto& state) { return shearForceOf(state, owned.place); });
}

void makeBond(const OwnedAssembly& owned, int contact, Interaction& interaction)
{
	auto geom = boost::make_shared<LobattoGeom>();
	auto phys = boost::make_shared<LobattoPhys>();
	owned.with([&](const auto& state) {
		const auto& pair = state.contacts.pairs[contactAt(owned, contact)];
		geom->refR1      = equalSphere(state, pair[0]);
		geom->refR2      = equalSphere(state, pair[1]);
	});
	geom->contact    = contact;
	phys->contact    = contact;
	interaction.geom = geom;
	interaction.phys = phys;
}

void mirrorBond(const OwnedAssembly& owned, int place, LobattoGeom& geom, LobattoPhys& phys)
{
	owned.with([&](const auto& state) {
		geom.normal           = normalOf(state, place);
		geom.contactPoint     = middleOf(state, place);
		geom.penetrationDepth = -meanOpening(state, place);
		const auto stiffness  = flexpm::bond_stiffness(state.contacts, place);
		phys.kn               = stiffness.normal;
		phys.ks               = stiffness.shear;
		phys.normalForce      = normalForceOf(state, place);
		phys.shearForce       = shearForceOf(state, place);
	});
}

void hideBond(LobattoGeom& geom, LobattoPhys& phys)
{
	const Vector3r none = Vector3r::Constant(std::numeric_limits<Real>::quiet_NaN());
	geom.normal = geom.contactPoint = phys.normalForce = phys.shearForce = none;
	geom.penetrationDepth                                                = none[0];
}

py::object LobattoPhys::opening() const
{
	return pointCopy<double>(contact, 0, [](const auto& s, int place, int p, auto& all) { addOpening(s, place, p, all); });
}

py::object LobattoPhys::slip() const
{
	return pointCopy<double>(contact, columnsOf(contact, 0, 2), [](const auto& s, int place, int p, auto& all) { addSlip(s, place, p, all); });
}

py::object LobattoPhys::area() const
{
	return pointCopy<double>(contact, 0, [](const auto& s, int place, int p, auto& all) { all.push_back(s.contacts.area(place, p)); });
}

py::object LobattoPhys::cracked() const
{
	return pointCopy<std::uint8_t>(
	        contact, 0, [](const auto& s, int place, int p, auto& all) { all.push_back(std::uint8_t(s.contacts.crack(place, p).mode)); });
}

py::object LobattoPhys::damage() const
{
	return pointCopy<double>(contact, 0, [](const auto& s, int place, int p, auto& all) { addDamage(s, place, p, all); });
}

py::object LobattoPhys::traction() const
{
	return pointCopy<double>(contact, columnsOf(contact, 2, 3), [](const auto& s, int place, int p, auto& all) { addTraction(s, place, p, all); });
}

py::object LobattoPhys::forces() const
{
	const auto owned = requireSpace(contact, "forces");
	return vectorsOf(flexpm::point_forces(*owned.space, owned.place));
}

} // namespace yade
