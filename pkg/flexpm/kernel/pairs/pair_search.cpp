// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/pairs/pair_search.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/groups.hpp>
#include <flexpm/kernel/geometry/near_boxes.hpp>
#include <flexpm/kernel/pairs/grain_bodies.hpp>
#include <flexpm/kernel/pairs/pair_forces.hpp>
#include <flexpm/kernel/pairs/pair_friction.hpp>
#include <flexpm/kernel/space/overlap.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace flexpm {

namespace {

/// Way along a face, or apart, at which a contact ends, over the square root of its area, and the
/// sine of the angle between its faces [-].
constexpr double parting_way = 0.02, parting_turn = 0.0349;

/// Distance within which grains are near, over the mean diameter [-].
constexpr double near_distance = 0.05;

/// Normal of one side of a contact, from the first grain to the second.
Vector side_normal(const SolidState& s, int contact, int side)
{
    const FaceContacts& c = s.contacts;
    std::vector<Vector> corners;
    for (int k = 0; k < c.corners_of(contact); ++k)
        corners.push_back(s.grains.position(c.node(contact, side, k)));
    return normal_of(corners);
}

std::vector<int> parted_contacts(const SolidState& s)
{
    std::vector<int> parted;
    const FaceContacts& c = s.contacts;
    for (int contact = 0; contact < c.count; ++contact)
        if (!c.has_ended(contact) && is_cracked_through(c, contact) && has_parted(s, contact))
            parted.push_back(contact);
    return parted;
}

/// What the points of a contact store and bear.
struct FaceLoad {
    double pressure_energy = 0.0;  ///< [J]
    double shear_energy = 0.0;     ///< [J]
    double damage = 0.0;           ///< dissipated [J]
    double friction = 0.0;         ///< [J]
    double closure = 0.0;          ///< largest elastic closure of a point [m]
    double crack_slip = 0.0;       ///< at which one point would have their friction [m]
    Vector force;                  ///< on the second grain [N]
};

FaceLoad load_of(const SolidState& s, int contact)
{
    const FaceContacts& c = s.contacts;
    const LawParameters& law = c.law_of(contact);
    const std::vector<FacePlace> places = places_of(s, contact);
    FaceLoad load;
    double pressed = 0.0, mean = 0.0;
    for (int p = 0; p < c.points_of(contact); ++p) {
        const FacePointState state = c.point_state(contact, p);
        const double area = c.area(contact, p), whole = law::elastic_energy(law, places[p], state);
        const Point elastic = places[p].slip - state.plastic_slip;
        const double shear = 0.5 * law.shear_stiffness * dot(elastic, elastic);
        load.pressure_energy += area * (whole - shear);
        const double closure = std::sqrt(2.0 * std::max(whole - shear, 0.0) / law.normal_stiffness);
        if (closure > load.closure) load.closure = closure;
        load.shear_energy += area * shear;
        load.damage += area * state.damage_energy;
        load.friction += area * state.friction_energy;
        // friction falls in proportion to the slip up to its residual value
        const double slip =
            std::min(c.state(contact, p, FaceRow::crack_slip), law::slip_to_residual(law));
        const double force = area * closure;
        load.crack_slip += force * slip;
        pressed += force;
        mean += slip / c.points_of(contact);
    }
    load.crack_slip = pressed > 0.0 ? load.crack_slip / pressed : mean;
    load.force = contact_force(s, contact);
    return load;
}

/// Take a contact out of the lanes; what it has dissipated goes to the ledger.
void end_contact(SolidState& s, int contact, const FaceLoad& load)
{
    FaceContacts& c = s.contacts;
    if (c.ended.empty()) {
        c.ended.assign(c.count, 0);
        c.bonded_areas = c.areas;
    }
    c.ended[contact] = 1;
    for (int p = 0; p < c.points_of(contact); ++p)
        c.areas[c.point_index(contact, p)] = 0.0;
    s.ledger.removed_damage += load.damage;
    s.ledger.removed_friction += load.friction;
}

/// Stored in pairs, and dissipated by them [J].
double energy_of(const std::vector<PairContact>& pairs)
{
    double sum = 0.0;
    for (const PairContact& p : pairs)
        sum += p.elastic_energy + p.friction_energy;
    return sum;
}

/// Box around a grain, and half of the distance within which others are near.
AxisBox box_around(const SolidState& s, int grain, double margin)
{
    constexpr double infinite = std::numeric_limits<double>::infinity();
    AxisBox box { { infinite, infinite, infinite }, { -infinite, -infinite, -infinite } };
    for (int n = 0; n < s.grains.vertices_of(grain); ++n) {
        const Vector at = present_position(s, grain, s.grains.node(grain, n));
        box.low = { std::min(box.low.x, at.x), std::min(box.low.y, at.y),
            std::min(box.low.z, at.z) };
        box.high = { std::max(box.high.x, at.x), std::max(box.high.y, at.y),
            std::max(box.high.z, at.z) };
    }
    const Vector more { margin, margin, margin };
    return { box.low - more, box.high + more };
}

/// Grains that may meet others: those with a face on the surface, or one whose contact has ended.
struct FreeGrains {
    std::vector<std::uint8_t> surface, ended;
    Groups bodies;  ///< that faces on each other hold together

    explicit FreeGrains(const SolidState& s) :
        surface(s.grains.count, 0),
        ended(s.grains.count, 0),
        bodies(s.grains.count)
    {
        for (int grain : s.surface.grain)
            surface[grain] = 1;
        for (int c = 0; c < s.contacts.count; ++c) {
            const auto [a, b] = s.contacts.pairs[c];
            if (s.contacts.has_ended(c))
                ended[a] = ended[b] = 1;
            else
                bodies.join(a, b);
        }
    }

    bool has_free_face(int grain) const { return surface[grain] || ended[grain]; }
    /// Grains of one body whose contacts all last cannot meet.
    bool may_meet(int a, int b) { return ended[a] || ended[b] || bodies.of(a) != bodies.of(b); }
    bool can_meet()
    {
        if (std::find(ended.begin(), ended.end(), 1) != ended.end()) return true;
        for (std::size_t g = 1; g < surface.size(); ++g)
            if (bodies.of(static_cast<int>(g)) != bodies.of(0)) return true;
        return false;
    }
};

/// Largest distance of a box around a grain from the grain [m].
double box_margin(const SolidState& s) { return 0.5 * near_distance * mean_diameter(s.grains); }

/// Pairs of grains without a common face that are near, ascending.
std::vector<GrainPair> near_pairs(const SolidState& s, FreeGrains& free)
{
    std::vector<int> grains;
    std::vector<AxisBox> boxes;
    const double margin = box_margin(s);
    for (int g = 0; g < s.grains.count; ++g) {
        if (!free.has_free_face(g)) continue;
        grains.push_back(g);
        boxes.push_back(box_around(s, g, margin));
    }
    const std::vector<GrainPair> together = mated_pairs(s);
    std::vector<GrainPair> pairs;
    for (const auto& [i, k] : meeting_boxes(boxes)) {
        const GrainPair pair { grains[i], grains[k] };
        if (free.may_meet(pair[0], pair[1])
            && !std::binary_search(together.begin(), together.end(), pair)) {
            pairs.push_back(pair);
        }
    }
    return pairs;
}

/// Laws of pairs that come: that of a joint on which both grains lie, else that of their minerals.
class PairLaws {
public:
    explicit PairLaws(const SolidState& of) : s(of)
    {
        const FaceContacts& c = s.contacts;
        if (c.joint.empty()) return;
        joints.resize(s.grains.count);
        for (int contact = 0; contact < c.count; ++contact)
            if (c.joint[contact] >= 0)
                for (int grain : c.pairs[contact])
                    joints[grain].push_back({ c.joint[contact], c.law[contact] });
    }

    int of(const GrainPair& pair) const
    {
        if (!joints.empty())
            for (const auto& [joint, law] : joints[pair[0]])
                for (const auto& other : joints[pair[1]])
                    if (other[0] == joint) return law;
        return s.grains.law_index(pair[0], pair[1]);
    }

private:
    const SolidState& s;
    std::vector<std::vector<std::array<int, 2>>> joints;  ///< of each grain, with their laws
};

/// Keep the pairs that are near, and add those that have come; leave the plan without work.
void replace_pairs(SolidState& s, const std::vector<GrainPair>& near)
{
    std::vector<PairContact> kept;
    const PairLaws laws(s);
    auto old = s.pairs.begin();
    for (const GrainPair& grains : near) {
        for (; old != s.pairs.end() && old->grains < grains; ++old)
            s.ledger.removed_friction += old->friction_energy + old->elastic_energy;
        if (old != s.pairs.end() && old->grains == grains) {
            kept.push_back(*old++);
            continue;
        }
        PairContact pair;
        pair.grains = grains;
        pair.law = laws.of(grains);
        pair.clearance = std::numeric_limits<double>::infinity();  // until it is found
        kept.push_back(pair);
    }
    for (; old != s.pairs.end(); ++old)
        s.ledger.removed_friction += old->friction_energy + old->elastic_energy;
    s.pairs = std::move(kept);
}

int body_index(const PairPlan& plan, int grain)
{
    const auto found = std::lower_bound(plan.bodies.begin(), plan.bodies.end(), grain,
        [](const GrainBody& body, int g) { return body.grain < g; });
    return static_cast<int>(found - plan.bodies.begin());
}

/// Clearances of pairs that are new, and of those that do not press: not more than they overlap.
void find_clearances(SolidState& s)
{
    SpaceOverlap overlap;
    for (std::size_t i = 0; i < s.pairs.size(); ++i) {
        PairContact& pair = s.pairs[i];
        if (pair.presses()) continue;
        if (!(pair.clearance > 0.0)) {
            pair.clearance = 0.0;  // what was left of a hand-over
            continue;
        }
        const PairWork& work = s.plan.pairs.pairs[i];
        const auto body = [&](int k) { return s.plan.pairs.bodies[work.bodies[k]].view(); };
        pair.clearance = std::min(pair.clearance, overlap.birth_clearance(body(0), body(1)));
    }
}

/// Clearance at which a pair stores an energy over K_n. Bodies are enlarged by no more than the
/// closure of the contact: where they have little in common, they store less of it.
double clearance_of(SpaceOverlap& overlap, const ContactBody& a, const ContactBody& b,
    double energy, double closure)
{
    if (!(energy > 0.0) || !std::isfinite(energy)) return overlap.birth_clearance(a, b);
    if (!(overlap.measure(a, b, -closure).energy > energy)) return -closure;
    return overlap.clearance_for(a, b, energy);
}

/// Faces of contacts that have ended can be pressed from now on: this must store no energy in other
/// pairs of their grains. Pairs that do not press begin anew, and bodies are not enlarged any more.
void open_faces(SolidState& s, const std::vector<int>& ended)
{
    std::vector<std::uint8_t> opens(s.grains.count, 0);
    for (int contact : ended)
        for (int grain : s.contacts.pairs[contact])
            opens[grain] = 1;
    for (PairContact& pair : s.pairs) {
        if (!opens[pair.grains[0]] && !opens[pair.grains[1]]) continue;
        pair.clearance = pair.presses() ? std::max(pair.clearance, 0.0)
                                        : std::numeric_limits<double>::infinity();
    }
}

/// Let the pair of a contact that has ended take over what it stores and bears.
void take_over(SolidState& s, int contact, const FaceLoad& load)
{
    const GrainPair grains = s.contacts.pairs[contact];
    const int number = pair_number(s, grains);
    if (number < 0) return;
    PairContact* const pair = &s.pairs[number];
    const LawParameters& law = s.contacts.law_of(contact);
    pair->law = s.contacts.law[contact];
    pair->face = contact;
    pair->crack_slip = load.crack_slip;
    const PairWork& work = s.plan.pairs.pairs[number];
    const auto body = [&](int k) { return s.plan.pairs.bodies[work.bodies[k]].view(); };
    thread_local SpaceOverlap overlap;
    pair->clearance = clearance_of(
        overlap, body(0), body(1), load.pressure_energy / law.normal_stiffness, load.closure);
    const BodyOverlap now = overlap.measure(body(0), body(1), pair->clearance);
    if (!(now.area > 0.0) || !(load.pressure_energy > 0.0)) return;
    Vector on_b;
    for (const FaceForce& on : overlap.forces())
        if (on.face >= body(0).faces) on_b = on_b + on.force;
    const double size = norm(on_b);
    if (!(size > 0.0)) return;
    // the force that the contact has borne along the surface, as far as that adds no energy
    pair->normal = (1.0 / size) * on_b;
    pair->area = now.area;
    pair->normal_force = law.normal_stiffness * size;
    const Vector along = load.force - dot(load.force, pair->normal) * pair->normal;
    pair->slip = (-1.0 / (law.shear_stiffness * now.area)) * along;
    const double stored = spring_energy(*pair, law.shear_stiffness);
    if (stored > load.shear_energy) pair->slip = std::sqrt(load.shear_energy / stored) * pair->slip;
}

/// Bound of the speed of all vertices of a grain.
double largest_speed(const SolidState& s, int grain)
{
    const Grains& grains = s.grains;
    const Vector at_centre = space_vector(grains.velocity, grains.centre(grain));
    const double spin = s.is_rigid() ? norm(s.bodies[grain].spin) : 0.0;
    if (s.is_rigid() && spin == 0.0) return norm(at_centre);
    const Vector centre = space_vector(grains.reference, grains.centre(grain));
    double largest = 0.0;
    for (int n = 0; n < grains.vertices_of(grain); ++n) {
        const int node = grains.node(grain, n);
        const Vector of = s.is_rigid() ? space_vector(grains.reference, node) - centre
                                       : space_vector(grains.velocity, node);
        largest = std::max(largest, dot(of, of));
    }
    largest = std::sqrt(largest);
    return s.is_rigid() ? norm(at_centre) + spin * largest : largest;
}

}  // namespace

bool has_parted(const SolidState& s, int contact)
{
    const FaceContacts& c = s.contacts;
    const double limit = parting_way * std::sqrt(contact_area(c, contact));
    const std::vector<FacePlace> places = places_of(s, contact);
    bool presses = false, slides = false, opens = false;
    for (int p = 0; p < c.points_of(contact); ++p) {
        if (!(c.area(contact, p) > 0.0)) continue;
        presses = presses || traction_of(s, contact, p).normal < 0.0;
        slides = slides || norm(places[p].slip) > limit;
        opens = opens || places[p].opening > limit;
    }
    if (slides || (opens && !presses)) return true;
    const Vector turn = cross(side_normal(s, contact, 0), side_normal(s, contact, 1));
    return norm(turn) > parting_turn;
}

bool look_for_pairs(SolidState& s)
{
    show_places(s);
    const std::vector<int> parted = parted_contacts(s);
    double stored = 0.0;
    std::vector<FaceLoad> loads;
    for (int contact : parted) {
        loads.push_back(load_of(s, contact));
        stored += loads.back().pressure_energy + loads.back().shear_energy;
        end_contact(s, contact, loads.back());
    }
    FreeGrains free(s);
    const bool can_meet = free.can_meet();
    s.unsearched_way = can_meet ? 0.0 : -1.0;
    replace_pairs(s, can_meet ? near_pairs(s, free) : std::vector<GrainPair> {});
    prepare_pairs(s);
    stored += energy_of(s.pairs);
    open_faces(s, parted);
    for (std::size_t i = 0; i < parted.size(); ++i)
        take_over(s, parted[i], loads[i]);
    find_clearances(s);
    update_pairs(s, 0.0);
    // faces that can be pressed now are one reason why pairs store less
    s.ledger.removed_friction += stored - energy_of(s.pairs);
    return !s.pairs.empty();
}

bool has_to_search(SolidState& s, double dt)
{
    if (s.unsearched_way < 0.0) return false;
    double largest = 0.0;
    for (int g = 0; g < s.grains.count; ++g)
        largest = std::max(largest, largest_speed(s, g));
    s.unsearched_way += dt * largest;
    return s.unsearched_way > box_margin(s);
}

void prepare_pairs(SolidState& s)
{
    PairPlan& plan = s.plan.pairs;
    plan.bodies.clear();
    plan.pairs.clear();
    plan.first_use.clear();
    plan.uses.clear();
    if (s.pairs.empty()) return;
    if (plan.faces.first.empty()) plan.faces = faces_of(s);
    std::vector<int> grains;
    for (const PairContact& pair : s.pairs)
        grains.insert(grains.end(), pair.grains.begin(), pair.grains.end());
    std::sort(grains.begin(), grains.end());
    grains.erase(std::unique(grains.begin(), grains.end()), grains.end());
    for (int grain : grains)
        plan.bodies.push_back(body_of(s, plan.faces, grain));
    std::vector<std::vector<PairUse>> of_block(s.grains.blocks());
    for (std::size_t i = 0; i < s.pairs.size(); ++i) {
        PairWork work;
        for (int k = 0; k < 2; ++k) {
            const int grain = s.pairs[i].grains[k];
            work.bodies[k] = body_index(plan, grain);
            of_block[s.grains.block_of(grain)].push_back({ static_cast<int>(i), k });
        }
        plan.pairs.push_back(work);
    }
    plan.first_use = { 0 };
    for (const auto& uses : of_block) {
        plan.uses.insert(plan.uses.end(), uses.begin(), uses.end());
        plan.first_use.push_back(static_cast<int>(plan.uses.size()));
    }
}

}  // namespace flexpm
