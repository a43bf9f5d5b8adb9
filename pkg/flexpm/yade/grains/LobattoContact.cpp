// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Views of a bond's points.
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

	/// (points,) view of row `row` of the `rows` rows of each point of a contact.
	template <class T> py::object pointView(int contact, flexpm::Array<T> flexpm::Contacts::*values, int row = 0, int rows = 1)
	{
		const auto           owned    = ownedContact(contact);
		const auto&          contacts = owned->contacts;
		const std::ptrdiff_t step     = rows * flexpm::lanes * sizeof(T);
		const T*             first    = (contacts.*values).data() + contacts.point_index(owned.place, 0, row, rows);
		return flexpm_bindings::array_view(first, { contacts.points_of(owned.place) }, { step }, py::object(owned.engine), Access::readOnly);
	}

	/// The same for a member of flexpm::PointState.
	py::object stateView(int contact, int row) { return pointView(contact, &flexpm::Contacts::states, row, flexpm::PointRow::count); }

	/// (points,) or (points, columns) copy of what `value(assembly, place, point, all)` appends.
	template <class Value> py::object pointCopy(int contact, int columns, Value value)
	{
		const auto          owned = ownedContact(contact);
		std::vector<double> all;
		for (int p = 0; p < owned->contacts.points_of(owned.place); ++p)
			value(*owned, owned.place, p, all);
		return flexpm_bindings::copied(all, columns);
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
	return flexpm_bindings::copied(std::vector<double> { start.x, start.y, end.x, end.y }, 2);
}

LobattoPhys::~LobattoPhys() { ++destroyedContacts(); }

py::object LobattoPhys::opening() const { return stateView(contact, flexpm::PointRow::opening); }

py::object LobattoPhys::slip() const { return stateView(contact, flexpm::PointRow::slip); }

py::object LobattoPhys::area() const { return pointView(contact, &flexpm::Contacts::areas); }

py::object LobattoPhys::cracked() const { return pointView(contact, &flexpm::Contacts::crack_modes); }

py::object LobattoPhys::damage() const
{
	return pointCopy(contact, 0, [](const auto& a, int place, int p, auto& all) { all.push_back(flexpm::damage_of(a.contacts, place, p)); });
}

py::object LobattoPhys::traction() const
{
	return pointCopy(contact, 2, [](const auto& a, int place, int p, auto& all) {
		const auto t = flexpm::point_traction(a, place, p);
		all.insert(all.end(), { t.x, t.y });
	});
}

} // namespace yade
