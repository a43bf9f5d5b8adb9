// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  numpy arrays over the kernel's memory, and C-contiguous buffers read from Python, both without a copy.
#pragma once

#include <boost/python.hpp>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace flexpm_bindings {

template <class T> constexpr const char* type_string()
{
	static_assert(std::is_same_v<T, double> || std::is_same_v<T, std::int32_t> || std::is_same_v<T, std::uint8_t>, "no numpy type given");
	return std::is_same_v<T, double> ? "<f8" : std::is_same_v<T, std::int32_t> ? "<i4" : "|u1";
}

enum class Access { readOnly, readWrite };

/// numpy array over memory that `owner` keeps alive; it must not move or be freed while the array lives.
///
/// @param strides  bytes from one element to the next along each axis
template <class T>
boost::python::object
array_view(const T* data, const std::vector<std::ptrdiff_t>& shape, const std::vector<std::ptrdiff_t>& strides, boost::python::object owner, Access access)
{
	namespace py = boost::python;
	static const T nothing {};
	py::list       sizes, steps;
	for (std::ptrdiff_t n : shape)
		sizes.append(n);
	for (std::ptrdiff_t n : strides)
		steps.append(n);
	py::dict interface;
	interface["version"]               = 3;
	interface["typestr"]               = type_string<T>();
	interface["shape"]                 = py::tuple(sizes);
	interface["strides"]               = py::tuple(steps);
	interface["data"]                  = py::make_tuple(reinterpret_cast<std::uintptr_t>(data != nullptr ? data : &nothing), access == Access::readOnly);
	py::object holder                  = py::import("types").attr("SimpleNamespace")();
	holder.attr("__array_interface__") = interface;
	holder.attr("owner")               = owner; // numpy keeps the holder, the holder keeps the owner
	return py::import("numpy").attr("asarray")(holder);
}

/// The same for rows of `columns` values without gaps; one axis if columns is 0.
template <class T> boost::python::object dense_view(const T* data, std::size_t rows, int columns, boost::python::object owner, Access access)
{
	const auto n = static_cast<std::ptrdiff_t>(rows), size = static_cast<std::ptrdiff_t>(sizeof(T));
	if (columns == 0) return array_view(data, { n }, { size }, owner, access);
	return array_view(data, { n, columns }, { columns * size, size }, owner, access);
}

/// numpy array with its own copy of the values; one axis if columns is 0. Read-only where a write would seem to change
/// what was copied.
template <class T> boost::python::object copied(const std::vector<T>& values, int columns, Access access = Access::readWrite)
{
	const std::size_t     rows = columns == 0 ? values.size() : values.size() / columns;
	boost::python::object copy = dense_view(values.data(), rows, columns, boost::python::object(), Access::readOnly).attr("copy")();
	if (access == Access::readOnly) copy.attr("setflags")(false);
	return copy;
}

/// View of a member vector as rows of scalars; the owner is the Python object that holds the C++ one.
template <class T, class Class, class Item, std::vector<Item> Class::*member> boost::python::object rows(boost::python::object self)
{
	const auto&   items   = boost::python::extract<const Class&>(self)().*member;
	constexpr int columns = sizeof(Item) == sizeof(T) ? 0 : static_cast<int>(sizeof(Item) / sizeof(T));
	return dense_view(reinterpret_cast<const T*>(items.data()), items.size(), columns, self, Access::readOnly);
}
template <class Class, class Item, std::vector<Item> Class::*member> constexpr auto integers = rows<int, Class, Item, member>;

/// Read access to a C-contiguous buffer of doubles or 32-bit integers (a numpy array) for the time of a call.
template <class T> class InputArray {
public:
	/// @throws std::invalid_argument  unless type and number of axes fit; `name` is named in the message
	InputArray(const boost::python::object& object, int axes, const char* name)
	{
		if (PyObject_GetBuffer(object.ptr(), &view, PyBUF_C_CONTIGUOUS | PyBUF_FORMAT) != 0) boost::python::throw_error_already_set();
		const std::string format = view.format != nullptr ? view.format : "B";
		const bool        fits   = std::is_same_v<T, double> ? format == "d" : (format == "i" || (format == "l" && sizeof(long) == sizeof(T)));
		if (!fits || view.ndim != axes) {
			const std::string found = format + " with " + std::to_string(view.ndim) + " axes";
			PyBuffer_Release(&view);
			throw std::invalid_argument(
			        std::string(name) + " = array of type " + found + ", must be C-contiguous " + type_string<T>() + " with " + std::to_string(axes)
			        + " axes; convert it with numpy.ascontiguousarray");
		}
	}
	~InputArray() { PyBuffer_Release(&view); }
	InputArray(const InputArray&)            = delete;
	InputArray& operator=(const InputArray&) = delete;

	std::size_t size(int axis) const { return static_cast<std::size_t>(view.shape[axis]); }
	const T*    data() const { return static_cast<const T*>(view.buf); }

private:
	Py_buffer view {};
};

} // namespace flexpm_bindings
