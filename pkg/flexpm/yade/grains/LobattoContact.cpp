// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What a bond's handles read of its points.
#include <flexpm/yade/grains/LobattoContact.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/assembly/snapshot.hpp>
#include <flexpm/yade/bindings/array_view.hpp>
#include <flexpm/yade/grains/AssemblyOwner.hpp>

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

	/// The same of a row of the state of each point.
	py::object stateCopy(int contact, int row)
	{
		return pointCopy<double>(contact, 0, [row](const auto& a, int place, int p, auto& all) { all.push_back(a.contacts.state(place, p, row)); });
	}

} // namespace

std::atomic<long>& destroyedContacts()
{
	static std::atomic<long> count { 0 };
	return count;
}

LobattoGeom::~LobattoGeom() { ++destroyedContacts(); }

Vector3r LobattoGeom::normal() const
{
	const auto owned = ownedContact(contact);
	const auto n     = owned->contacts.normal(owned.place);
	return Vector3r(n.x, n.y, 0);
}

Vector3r LobattoGeom::contactPoint() const
{
	const auto owned = ownedContact(contact);
	const auto start = flexpm::contact_end(*owned, owned.place, 0), end = flexpm::contact_end(*owned, owned.place, 1);
	return .5 * Vector3r(start.x + end.x, start.y + end.y, 0);
}

py::object LobattoGeom::ends() const
{
	const auto owned = ownedContact(contact);
	const auto start = flexpm::contact_end(*owned, owned.place, 0), end = flexpm::contact_end(*owned, owned.place, 1);
	return flexpm_bindings::copied(std::vector<double> { start.x, start.y, end.x, end.y }, 2, Access::readOnly);
}

LobattoPhys::~LobattoPhys() { ++destroyedContacts(); }

py::object LobattoPhys::opening() const { return stateCopy(contact, flexpm::PointRow::opening); }

py::object LobattoPhys::slip() const { return stateCopy(contact, flexpm::PointRow::slip); }

py::object LobattoPhys::area() const
{
	return pointCopy<double>(contact, 0, [](const auto& a, int place, int p, auto& all) { all.push_back(a.contacts.area(place, p)); });
}

py::object LobattoPhys::cracked() const
{
	return pointCopy<std::uint8_t>(
	        contact, 0, [](const auto& a, int place, int p, auto& all) { all.push_back(a.contacts.crack_modes[a.contacts.point_index(place, p)]); });
}

py::object LobattoPhys::damage() const
{
	return pointCopy<double>(contact, 0, [](const auto& a, int place, int p, auto& all) { all.push_back(flexpm::damage_of(a.contacts, place, p)); });
}

py::object LobattoPhys::traction() const
{
	return pointCopy<double>(contact, 2, [](const auto& a, int place, int p, auto& all) {
		const auto t = flexpm::point_traction(a, place, p);
		all.insert(all.end(), { t.x, t.y });
	});
}

} // namespace yade
