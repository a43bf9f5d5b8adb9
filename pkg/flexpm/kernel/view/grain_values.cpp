// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/view/grain_values.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/measure/grain_stress.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <type_traits>

namespace flexpm {

namespace {

struct Description {
    GrainValue what;
    const char* name;
    const char* title;
    double factor;
};

constexpr std::array<Description, 10> descriptions { {
    { GrainValue::stress_xx, "stress_xx", "stress xx [MPa]", 1e-6 },
    { GrainValue::stress_yy, "stress_yy", "stress yy [MPa]", 1e-6 },
    { GrainValue::stress_xy, "stress_xy", "stress xy [MPa]", 1e-6 },
    { GrainValue::stress_zz, "stress_zz", "stress zz [MPa]", 1e-6 },
    { GrainValue::stress_yz, "stress_yz", "stress yz [MPa]", 1e-6 },
    { GrainValue::stress_xz, "stress_xz", "stress xz [MPa]", 1e-6 },
    { GrainValue::displacement, "displacement", "displacement [mm]", 1e3 },
    { GrainValue::damage, "damage", "damage [-]", 1.0 },
    { GrainValue::mineral, "mineral", "mineral", 1.0 },
    { GrainValue::fragment, "fragment", "fragment", 1.0 },
} };

const Description& description_of(GrainValue what)
{
    return *std::find_if(descriptions.begin(), descriptions.end(),
        [&](const Description& one) { return one.what == what; });
}

bool is_of_space(GrainValue what)
{
    return what == GrainValue::stress_zz || what == GrainValue::stress_yz
        || what == GrainValue::stress_xz;
}

/// What fragments are measured by: area or volume.
template <class State> double size_of(const State& s, int grain)
{
    if constexpr (std::is_same_v<State, Assembly>)
        return cell_area(s.grains, grain);
    else
        return grain_stress(s, grain).volume;
}

double stress_of(const SpaceTensor& t, GrainValue what)
{
    switch (what) {
    case GrainValue::stress_xx:
        return t.xx;
    case GrainValue::stress_yy:
        return t.yy;
    case GrainValue::stress_zz:
        return t.zz;
    case GrainValue::stress_yz:
        return t.yz;
    case GrainValue::stress_xz:
        return t.xz;
    default:
        return t.xy;
    }
}

bool is_bond(const Contacts& contacts, int c) { return contacts.bonded[c] && !contacts.erased[c]; }
bool is_bond(const FaceContacts&, int) { return true; }

double damage_of(const FaceContacts& contacts, int contact, int point)
{
    const FacePointState state = contacts.point_state(contact, point);
    return law::damage(contacts.law_of(contact), state.max_opening, state.shear_damage);
}

/// Calls visit(contact) for all bonds that are there.
template <class List, class Visit> void for_each_bond(const List& contacts, Visit visit)
{
    for (int c = 0; c < contacts.count; ++c) {
        if (is_bond(contacts, c)) visit(c);
    }
}

/// Displacement of the centre of a grain [m].
double way_of(const Grains& grains, int grain)
{
    return grains.length(grains.vector(grains.displacement, grains.centre(grain)));
}

template <class State> std::vector<double> damages(const State& a)
{
    std::vector<double> sums(a.grains.count), points(a.grains.count);
    for_each_bond(a.contacts, [&](int c) {
        for (int grain : a.contacts.pairs[c]) {
            for (int p = 0; p < a.contacts.points_of(c); ++p)
                sums[grain] += damage_of(a.contacts, c, p);
            points[grain] += a.contacts.points_of(c);
        }
    });
    for (int g = 0; g < a.grains.count; ++g)
        sums[g] /= std::max(points[g], 1.0);
    return sums;
}

/// The first grain of those with which each hangs together.
template <class State> std::vector<int> first_of_fragments(const State& a)
{
    std::vector<int> first(a.grains.count);
    std::iota(first.begin(), first.end(), 0);
    const auto root = [&](int grain) {
        while (first[grain] != grain)
            grain = first[grain] = first[first[grain]];
        return grain;
    };
    for_each_bond(a.contacts, [&](int c) {
        bool holds = false;
        for (int p = 0; p < a.contacts.points_of(c); ++p)
            holds = holds || damage_of(a.contacts, c, p) < 1.0;
        if (!holds) return;
        const int one = root(a.contacts.pairs[c][0]), other = root(a.contacts.pairs[c][1]);
        first[std::max(one, other)] = std::min(one, other);
    });
    for (int g = 0; g < a.grains.count; ++g)
        first[g] = root(g);
    return first;
}

template <class State> std::vector<double> fragments(const State& a)
{
    const std::vector<int> first = first_of_fragments(a);
    std::vector<double> size(a.grains.count);
    std::vector<int> order;
    for (int g = 0; g < a.grains.count; ++g) {
        if (a.grains.erased[g]) continue;
        size[first[g]] += size_of(a, g);
        if (first[g] == g) order.push_back(g);
    }
    std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return size[i] > size[j]; });
    std::vector<double> rank(a.grains.count), found(a.grains.count);
    for (std::size_t i = 0; i < order.size(); ++i)
        rank[order[i]] = static_cast<double>(i);
    for (int g = 0; g < a.grains.count; ++g)
        found[g] = rank[first[g]];
    return found;
}

template <class State> double single_value(const State& a, int grain, GrainValue what)
{
    if (what == GrainValue::mineral) return a.grains.material[grain];
    if (what == GrainValue::displacement) return way_of(a.grains, grain);
    return stress_of(grain_stress(a, grain).stress, what);
}

}  // namespace

std::optional<GrainValue> grain_value(const std::string& name, int dimensions)
{
    for (const Description& one : descriptions) {
        const bool known = dimensions == space_layout.dimension || !is_of_space(one.what);
        if (known && one.name == name) return one.what;
    }
    return {};
}

bool is_kind(GrainValue what)
{
    return what == GrainValue::mineral || what == GrainValue::fragment;
}

std::string scale_title(GrainValue what) { return description_of(what).title; }

double scale_factor(GrainValue what) { return description_of(what).factor; }

template <class State> std::vector<double> grain_values(const State& a, GrainValue what)
{
    std::vector<double> values(a.grains.count);
    if (what == GrainValue::damage) {
        values = damages(a);
    } else if (what == GrainValue::fragment) {
        values = fragments(a);
    } else {
        for (int g = 0; g < a.grains.count; ++g)
            values[g] = single_value(a, g, what);
    }
    for (int g = 0; g < a.grains.count; ++g) {
        if (a.grains.erased[g]) values[g] = std::numeric_limits<double>::quiet_NaN();
    }
    return values;
}

template std::vector<double> grain_values<Assembly>(const Assembly&, GrainValue);
template std::vector<double> grain_values<SolidState>(const SolidState&, GrainValue);

Extent extent_of(const Grains& grains)
{
    constexpr double far = std::numeric_limits<double>::max();
    const double depth = grains.layout.dimension == 2 ? 0.0 : far;
    Extent found { { far, far, depth }, { -far, -far, -depth } };
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        for (int n = 0; n < grains.vertices_of(g); ++n) {
            const Vector p = grains.position(grains.node(g, n));
            found.low = { std::min(found.low.x, p.x), std::min(found.low.y, p.y),
                std::min(found.low.z, p.z) };
            found.high = { std::max(found.high.x, p.x), std::max(found.high.y, p.y),
                std::max(found.high.z, p.z) };
        }
    }
    return found;
}

}  // namespace flexpm
