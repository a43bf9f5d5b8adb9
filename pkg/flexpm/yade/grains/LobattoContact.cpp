// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What a bond's handles read of its points.
#include <flexpm/yade/grains/LobattoContact.hpp>

#include <flexpm/kernel/assembly/access.hpp>
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

	/// (points,) or (points, columns) copy of what `value(assembly, place, point, all)` appends: the arrays move when contacts come and go.
	template <class T, class Value> py::object pointCopy(int contact, int columns, Value value)
	{
		const auto     owned = ownedContact(contact);
		std::vector<T> all;
		for (int p = 0; p < owned->contacts.points_of(owned.place); ++p)
			value(*owned, owned.place, p, all);
		return flexpm_bindings::copied(all, columns, Access::readOnly);
	}

	/// The same of a number of each point, read by that function.
	py::object numbersOf(int contact, double (*read)(const flexpm::Contacts&, int, int))
	{
		return pointCopy<double>(contact, 0, [read](const auto& a, int place, int p, auto& all) { all.push_back(read(a.contacts, place, p)); });
	}

	Vector3r vector(flexpm::Point p) { return Vector3r(p.x, p.y, 0); }

	Vector3r normalOf(const flexpm::Assembly& a, int place) { return vector(a.contacts.normal(place)); }

	Vector3r middleOf(const flexpm::Assembly& a, int place)
	{
		return .5 * (vector(flexpm::contact_end(a, place, 0)) + vector(flexpm::contact_end(a, place, 1)));
	}

	Vector3r normalForceOf(const flexpm::Assembly& a, int place)
	{
		const Vector3r normal = normalOf(a, place);
		return vector(flexpm::contact_force(a.contacts, place)).dot(normal) * normal;
	}

	Vector3r shearForceOf(const flexpm::Assembly& a, int place) { return vector(flexpm::contact_force(a.contacts, place)) - normalForceOf(a, place); }

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
	return normalOf(*owned, owned.place);
}

Vector3r LobattoGeom::presentContactPoint() const
{
	const auto owned = ownedContact(contact);
	return middleOf(*owned, owned.place);
}

Real LobattoGeom::presentPenetrationDepth() const
{
	const auto owned = ownedContact(contact);
	return -flexpm::mean_opening(owned->contacts, owned.place);
}

py::object LobattoGeom::ends() const
{
	const auto owned = ownedContact(contact);
	const auto start = flexpm::contact_end(*owned, owned.place, 0), end = flexpm::contact_end(*owned, owned.place, 1);
	return flexpm_bindings::copied(std::vector<double> { start.x, start.y, end.x, end.y }, 2, Access::readOnly);
}

LobattoPhys::~LobattoPhys() { ++destroyedContacts(); }

Vector3r LobattoPhys::presentNormalForce() const
{
	const auto owned = ownedContact(contact);
	return normalForceOf(*owned, owned.place);
}

Vector3r LobattoPhys::presentShearForce() const
{
	const auto owned = ownedContact(contact);
	return shearForceOf(*owned, owned.place);
}

void makeBond(const flexpm::Assembly& assembly, int contact, Interaction& interaction)
{
	auto        geom = boost::make_shared<LobattoGeom>();
	auto        phys = boost::make_shared<LobattoPhys>();
	const auto& pair = assembly.contacts.pairs[flexpm::contact_with_id(assembly, contact)];
	geom->refR1      = flexpm::equal_sphere(assembly, pair[0]);
	geom->refR2      = flexpm::equal_sphere(assembly, pair[1]);
	geom->contact    = contact;
	phys->contact    = contact;
	interaction.geom = geom;
	interaction.phys = phys;
}

void mirrorBond(const flexpm::Assembly& assembly, int place, LobattoGeom& geom, LobattoPhys& phys)
{
	geom.normal           = normalOf(assembly, place);
	geom.contactPoint     = middleOf(assembly, place);
	geom.penetrationDepth = -flexpm::mean_opening(assembly.contacts, place);
	const auto stiffness  = flexpm::bond_stiffness(assembly.contacts, place);
	phys.kn               = stiffness.normal;
	phys.ks               = stiffness.shear;
	phys.normalForce      = normalForceOf(assembly, place);
	phys.shearForce       = shearForceOf(assembly, place);
}

void hideBond(LobattoGeom& geom, LobattoPhys& phys)
{
	const Vector3r none = Vector3r::Constant(std::numeric_limits<Real>::quiet_NaN());
	geom.normal = geom.contactPoint = phys.normalForce = phys.shearForce = none;
	geom.penetrationDepth                                                = none[0];
}

py::object LobattoPhys::opening() const { return numbersOf(contact, flexpm::opening_of); }

py::object LobattoPhys::slip() const { return numbersOf(contact, flexpm::slip_of); }

py::object LobattoPhys::area() const
{
	return pointCopy<double>(contact, 0, [](const auto& a, int place, int p, auto& all) { all.push_back(a.contacts.area(place, p)); });
}

py::object LobattoPhys::cracked() const
{
	return pointCopy<std::uint8_t>(contact, 0, [](const auto& a, int place, int p, auto& all) { all.push_back(a.contacts.crack(place, p).mode); });
}

py::object LobattoPhys::damage() const { return numbersOf(contact, flexpm::damage_of); }

py::object LobattoPhys::traction() const
{
	return pointCopy<double>(contact, 2, [](const auto& a, int place, int p, auto& all) {
		const auto t = flexpm::traction_of(a.contacts, place, p);
		all.insert(all.end(), { t.normal, t.shear });
	});
}

} // namespace yade
