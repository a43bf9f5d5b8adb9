// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Contacts, `lanes` at a time.
#include <flexpm/kernel/plane_lanes/contact_forces.hpp>

#include <flexpm/kernel/assembly/law_rows.hpp>
#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/law/bilinear_step.hpp>
#include <flexpm/kernel/plane_lanes/contact_kinematics.hpp>
#include <flexpm/kernel/plane_lanes/crack_record.hpp>

namespace flexpm {

namespace {

constexpr int block_distance = 2;  ///< blocks to the rows to ask for, which follow each other
constexpr int node_distance = 6;   ///< blocks to the nodes to ask for, which lie anywhere

/// No point of the block has any damage: true of most blocks.
template <int Points> FLEXPM_INLINE bool is_intact(const ContactLanes& b)
{
    alignas(64) std::int64_t damaged[lanes];
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        double opened = 0.0, sheared = 0.0;
        for (int p = 0; p < Points; ++p) {
            const PointState s = load_rows<PointState>(b.state + p * point_rows * lanes, l);
            opened = std::max(opened, s.max_opening);
            sheared = std::max(sheared, s.shear_damage);
        }
        damaged[l] =
            (opened > load_rows<LawParameters>(b.law, l).elastic_opening) | (sheared > 0.0);
    }
    return !any_of(damaged);
}

/// Law of a point: one that has cracked may have lost friction.
///
/// @tparam Extended  false: no law of the block dilates, and no friction has fallen
template <bool Extended> FLEXPM_INLINE LawParameters law_at(const ContactLanes& b, int p, int l)
{
    LawParameters law = load_rows<LawParameters>(b.law, l);
    if (Extended) law.friction = law::friction_after(law, b.crack_slip[p * lanes + l]);
    return law;
}

/// Plastic slip of a step [m], 0 of one on the elastic branch, from the shear tractions before and
/// after it.
FLEXPM_INLINE double plastic_slip(
    const LawParameters& law, double before, double slip_step, double after)
{
    return std::fabs(before + law.shear_stiffness * slip_step - after) / law.shear_stiffness;
}

/// Rows of a state that an elastic step changes: the first ones.
constexpr int elastic_rows = row_of<&PointState::slip> + 1;

/// Traction of one point of each contact [Pa].
struct TractionRows {
    double* normal;
    double* shear;
};

/// Slides the points that leave their branch, which shear has used up: `next` holds what an elastic
/// step would have made of all.
template <bool Extended>
FLEXPM_INLINE void slide_lanes(
    const ContactLanes& b, int p, const std::int64_t* leaves, double* next, TractionRows traction)
{
    double* state = b.state + p * point_rows * lanes;
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const PointState s = load_rows<PointState>(state, l);
        PointState trial = s;
        trial.opening = next[row_of<&PointState::opening> * lanes + l];
        trial.shear_traction = next[row_of<&PointState::shear_traction> * lanes + l];
        trial.slip = next[row_of<&PointState::slip> * lanes + l];
        const LawParameters law = law_at<Extended>(b, p, l);
        const Sliding slide = slide_used_up<Extended>(law, traction.normal[l], s, trial);
        const bool slides = leaves[l] != 0;
        if (Extended) {
            const double plastic =
                std::fabs(trial.shear_traction - slide.shear) / law.shear_stiffness;
            b.crack_slip[p * lanes + l] += (slides & law::weakens(law)) ? plastic : 0.0;
        }
        traction.normal[l] = slides ? slide.normal : traction.normal[l];
        traction.shear[l] = slides ? slide.shear : traction.shear[l];
        next[row_of<&PointState::shear_traction> * lanes + l] = traction.shear[l];
        state[row_of<&PointState::friction_energy> * lanes + l] =
            s.friction_energy + (slides ? slide.loss : 0.0);
    }
}

/// Advances a point of each contact if all stay on their branches or only friction holds them;
/// otherwise changes no state.
template <bool Intact, bool Extended>
FLEXPM_INLINE bool advance_elastic_lanes(
    const ContactLanes& b, const PointMotion& motion, int p, TractionRows traction)
{
    double* state = b.state + p * point_rows * lanes;
    alignas(64) std::int64_t leaves[lanes], needs_law[lanes];
    alignas(64) double next[elastic_rows * lanes];
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        PointState s;
        Traction t;
        const PointState old = load_rows<PointState>(state, l);
        const bool elastic = advance_elastic<Intact, Extended>(law_at<Extended>(b, p, l),
            motion.opening[p * lanes + l], motion.slip[p * lanes + l], old, s, t);
        next[row_of<&PointState::opening> * lanes + l] = s.opening;
        next[row_of<&PointState::max_opening> * lanes + l] = s.max_opening;
        next[row_of<&PointState::shear_traction> * lanes + l] = s.shear_traction;
        next[row_of<&PointState::slip> * lanes + l] = s.slip;
        traction.normal[l] = t.normal;
        traction.shear[l] = t.shear;
        leaves[l] = !elastic;
        needs_law[l] = !elastic & !(old.shear_damage >= 1.0);
    }
    if (any_of(leaves)) {
        if (Intact || any_of(needs_law)) return false;
        slide_lanes<Extended>(b, p, leaves, next, traction);
    }
    for (int i = 0; i < elastic_rows * lanes; ++i)
        state[i] = next[i];
    return true;
}

/// Advances a point of each contact. Returns the lanes that cracked in this step.
template <bool Extended>
FLEXPM_INLINE int advance_lanes(const ContactLanes& b, const PointMotion& motion, int p,
    TractionRows traction, std::uint8_t* cracked)
{
    double* state = b.state + p * point_rows * lanes;
    alignas(64) double fresh[lanes];
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        PointState s = load_rows<PointState>(state, l);
        const LawParameters law = law_at<Extended>(b, p, l);
        const double slip_step = motion.slip[p * lanes + l], before = s.shear_traction;
        const Traction t =
            advance_point<Extended>(law, motion.opening[p * lanes + l], slip_step, s);
        if (Extended) {
            const bool rubs = (t.damage_before >= 1.0) & law::weakens(law);
            b.crack_slip[p * lanes + l] +=
                rubs ? plastic_slip(law, before, slip_step, t.shear) : 0.0;
        }
        store_rows(s, state, l);
        traction.normal[l] = t.normal;
        traction.shear[l] = t.shear;
        fresh[l] = ((t.damage_before < 1.0) & (t.damage >= 1.0)) ? 1.0 : 0.0;
    }
    int cracks = 0;
    for (int l = 0; l < lanes; ++l) {
        cracked[l] = fresh[l] > 0.0;
        cracks += cracked[l];
    }
    return cracks;
}

/// Returns the lanes, summed over points, that cracked in this step; `cracked` holds zeros before.
template <int Points, bool Intact, bool Extended>
FLEXPM_INLINE int advance_points(const ContactLanes& b, const PointMotion& motion, double* normal,
    double* shear, std::uint8_t* cracked)
{
    int cracks = 0;
    for (int p = 0; p < Points; ++p) {
        const TractionRows traction = { normal + p * lanes, shear + p * lanes };
        if (b.prefetch_distance != 0) {
            const int row = (b.prefetch_distance * Points + p) * point_rows;
            prefetch_rows(b.state + row * lanes, point_rows);
        }
        if (advance_elastic_lanes<Intact, Extended>(b, motion, p, traction)) continue;
        cracks += advance_lanes<Extended>(b, motion, p, traction, cracked + p * lanes);
    }
    return cracks;
}

template <int Points, bool Whole, bool Wide>
FLEXPM_INLINE int update_lanes(const ContactLanes& b, double dt, std::uint8_t* cracked)
{
    PointMotion motion;
    // two calls, not one through a pointer: only a direct call is compiled for each instruction set
    if (any_normal_of_edge(b))
        move_points<Points, true, Whole, Wide>(b, dt, motion);
    else
        move_points<Points, false, Whole, Wide>(b, dt, motion);

    alignas(64) double normal[Points * lanes], shear[Points * lanes];
    const bool intact = is_intact<Points>(b);
    // the friction of intact points is whole
    const int cracks = b.dilating || (b.weakening && !intact)
        ? advance_points<Points, false, true>(b, motion, normal, shear, cracked)
        : intact ? advance_points<Points, true, false>(b, motion, normal, shear, cracked)
                 : advance_points<Points, false, false>(b, motion, normal, shear, cracked);
    if (!Whole) prefetch_ahead(b, b.weight, 2 * Points);
    prefetch_ahead(b, b.area, Points, Whole ? 2 : Points);
    prefetch_ahead(b, b.force, Contacts::force_values);
    spread_forces<Points, Whole>(b, normal, shear);
    return cracks;
}

template <int Points, bool Wide>
FLEXPM_INLINE int update_block(const ContactLanes& b, double dt, std::uint8_t* cracked)
{
    if constexpr (Points == 3) {
        if (b.whole_edges) return update_lanes<3, true, Wide>(b, dt, cracked);
    }
    return update_lanes<Points, false, Wide>(b, dt, cracked);
}

template <int Points> auto update_for()
{
    return variant_of<update_block<Points, false>, update_block<Points, true>>();
}

ContactLanes rows_from(Assembly& a, int block, const LawRows& law)
{
    Contacts& contacts = a.contacts;
    const int contact = block * lanes, points = contacts.points_in(block);
    return { a.grains.reference.data(), a.grains.displacement.data(), a.grains.velocity.data(),
        a.plan.next_centre.data(), contacts.nodes.data() + contact * NodeRow::count,
        contacts.weights.data() + contact * 2 * points, contacts.areas.data() + contact * points,
        contacts.branches.data() + contact * dimension,
        contacts.inverse_edge_lengths.data() + contact * 2,
        contacts.normals.data() + contact * dimension,
        contacts.states.data() + contact * points * point_rows,
        contacts.paired_slips.data() + contact * points,
        contacts.crack_slips.data() + contact * points,
        contacts.forces.data() + contact * Contacts::force_values, law.values, false, false, false,
        a.plan.prefetch.needed ? block_distance : 0 };
}

/// Go on to the rows of the next block.
void advance_block(ContactLanes& b, int points)
{
    b.nodes += lanes * NodeRow::count;
    b.weight += lanes * 2 * points;
    b.area += lanes * points;
    b.branch += lanes * dimension;
    b.inverse_edge_length += lanes * 2;
    b.normal += lanes * dimension;
    b.state += lanes * points * point_rows;
    b.paired_slip += lanes * points;
    b.crack_slip += lanes * points;
    b.force += lanes * Contacts::force_values;
}

}  // namespace

void update_contact_blocks(Assembly& a, int first, int end, double dt)
{
    if (first == end) return;
    LawRows law;
    ContactLanes rows = rows_from(a, first, law);
    const int points = a.contacts.points_in(first);
    const auto update = points == 3 ? update_for<3>()
        : points == 2               ? update_for<2>()
                                    : update_for<1>();
    for (int block = first; block < end; ++block, advance_block(rows, points)) {
        law.fill(a.contacts, block);
        if (a.plan.prefetch.needed && block + node_distance < a.contacts.blocks()) {
            prefetch_nodes(a, block + node_distance);
        }
        rows.dilating = law.dilating;
        rows.weakening = law.weakening;
        rows.whole_edges = a.plan.whole_edges[block] != 0;
        std::uint8_t cracked[most_points * lanes] = {};
        if (update(rows, dt, cracked) > 0) record_cracks(a, block, dt, cracked);
    }
}

}  // namespace flexpm
