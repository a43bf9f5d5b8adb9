// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Bitwise comparison of two assemblies, and a specimen that breaks while it is stepped.
#pragma once

#include <flexpm/kernel/assembly/serialization.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>

#include "support/driven.hpp"

#include <cstring>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

namespace same_bits {

template <class T, class = void> struct IsArray : std::false_type {
};
template <class T>
struct IsArray<T, std::enable_if_t<std::is_arithmetic<typename T::value_type>::value>>
    : std::true_type {
};

template <class T> struct IsList : std::false_type {
};
template <class T, class A> struct IsList<std::vector<T, A>> : std::true_type {
};

/// The bytes of every number and array of numbers that a part of an assembly must keep, by name.
using Bytes = std::map<std::string, std::string>;

template <class Part> void add_bytes(const Part& part, const std::string& name, Bytes& all)
{
    if constexpr (std::is_arithmetic<Part>::value || std::is_enum<Part>::value) {
        all[name].assign(reinterpret_cast<const char*>(&part), sizeof part);
    } else if constexpr (std::is_same<Part, std::map<flexpm::GrainPair, double>>::value) {
        for (const auto& [pair, value] : part)
            add_bytes(value, name + std::to_string(pair[0]) + '-' + std::to_string(pair[1]), all);
    } else if constexpr (IsArray<Part>::value) {
        all[name].assign(reinterpret_cast<const char*>(part.data()),
            part.size() * sizeof(typename Part::value_type));
    } else if constexpr (IsList<Part>::value) {
        for (std::size_t i = 0; i < part.size(); ++i)
            add_bytes(part[i], name + '.' + std::to_string(i), all);
    } else {
        flexpm::visit_members(part, [&](const char* member, const auto& value) {
            add_bytes(value, name.empty() ? member : name + '.' + member, all);
        });
    }
}

template <class Part> Bytes bytes(const Part& part)
{
    Bytes all;
    add_bytes(part, "", all);
    return all;
}

/// A part with only those members of another that it lists, as a saved state holds them.
template <class Part> Part copy_of_members(const Part& part)
{
    std::map<std::string, const void*> from;
    flexpm::visit_members(part, [&](const char* name, const auto& value) { from[name] = &value; });
    Part copy;
    flexpm::visit_members(copy, [&](const char* name, auto& value) {
        using Value = std::decay_t<decltype(value)>;
        value = *static_cast<const Value*>(from.at(name));
    });
    return copy;
}

/// Names of what differs; empty if nothing does.
template <class Part> std::string difference(const Part& a, const Part& b)
{
    const Bytes first = bytes(a), second = bytes(b);
    std::string names;
    for (const auto& [name, value] : first) {
        const auto other = second.find(name);
        if (other == second.end() || other->second != value) names += name + ' ';
    }
    for (const auto& [name, value] : second) {
        if (first.count(name) == 0) names += name + ' ';
    }
    return names;
}

/// A random specimen with pressed sides, sheared and drawn apart so fast that points crack within
/// 500 steps.
inline flexpm::Assembly breaking(const flexpm::AssemblyOptions& options = specimens::options())
{
    flexpm::Assembly a =
        specimens::assemble(specimens::random_grains(12e-3, 15e-3, 3e-3, 9), options);
    flexpm::scale_masses(a, 0.7);
    flexpm::prescribe(a, flexpm::side_nodes(a, 0), 1, 0.0);
    flexpm::prescribe(a, flexpm::side_nodes(a, 2), 1, 5e-8);
    flexpm::prescribe(a, flexpm::side_nodes(a, 2), 0, 1e-7);
    for (int side : { 1, 3 })
        flexpm::set_pressure(a, side, 1e5);
    return a;
}

}  // namespace same_bits
