// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Bitwise comparison of two assemblies, and a specimen that breaks while it is stepped.
#pragma once

#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>

#include "support/driven.hpp"

#include <cstring>
#include <map>
#include <string>
#include <type_traits>

namespace same_bits {

template <class T, class = void> struct IsArray : std::false_type {
};
template <class T>
struct IsArray<T, std::enable_if_t<std::is_arithmetic<typename T::value_type>::value>>
    : std::true_type {
};

/// The bytes of every number and array of numbers that an assembly must keep.
inline std::map<std::string, std::string> bytes(const flexpm::Assembly& a)
{
    std::map<std::string, std::string> all;
    flexpm::visit_state(a, [&](const char* name, const auto& value) {
        using T = std::decay_t<decltype(value)>;
        if constexpr (std::is_arithmetic<T>::value) {
            all[name].assign(reinterpret_cast<const char*>(&value), sizeof value);
        } else if constexpr (IsArray<T>::value) {
            all[name].assign(reinterpret_cast<const char*>(value.data()),
                value.size() * sizeof(typename T::value_type));
        }
    });
    return all;
}

/// Names of what differs; empty if nothing does.
inline std::string difference(const flexpm::Assembly& a, const flexpm::Assembly& b)
{
    const auto first = bytes(a), second = bytes(b);
    std::string names;
    for (const auto& [name, value] : first) {
        if (second.at(name) != value) names += name + ' ';
    }
    return names;
}

/// A random specimen with pressed sides, sheared and drawn apart so fast that points crack within 500 steps.
inline flexpm::Assembly breaking(const flexpm::AssemblyOptions& options = specimens::options())
{
    flexpm::Assembly a =
        specimens::assemble(specimens::random_grains(12e-3, 15e-3, 3e-3, 9), options);
    flexpm::scale_masses(a, 0.7);
    flexpm::drive(a, flexpm::side_nodes(a, 0), 1, 0.0);
    flexpm::drive(a, flexpm::side_nodes(a, 2), 1, 5e-8);
    flexpm::drive(a, flexpm::side_nodes(a, 2), 0, 1e-7);
    for (int side : { 1, 3 })
        flexpm::set_pressure(a, side, 1e5);
    return a;
}

}  // namespace same_bits
