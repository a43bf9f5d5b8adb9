// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/statics/wide_motions.hpp>

#include <flexpm/kernel/iteration/coarse_grid.hpp>

#include <utility>

namespace flexpm {
namespace {

/// Contacts so many times as stiff as grains open little: rigid motions would save fewer iterations
/// than they cost.
constexpr double stiff_contacts = 4.0;
/// In larger solids bricks are wider, and rigid motions save more.
constexpr std::size_t many_grains = 50000;

using Held = std::vector<std::uint8_t>;

/// Add to what is not held of a triple.
void add_free(double* u, const Held& held, int triple, Vector v)
{
    const double along[] = { v.x, v.y, v.z };
    for (int axis = 0; axis < 3; ++axis)
        if (!held[3 * triple + axis]) u[3 * triple + axis] += along[axis];
}

/// Springs of elements at their held nodes.
std::vector<RigidSolid::Hold> holds_of(const LinearSolid& solid, const Held& held)
{
    std::vector<RigidSolid::Hold> holds;
    for (const LinearSolid::Element& e : solid.elements) {
        for (int k = 0; k < 4; ++k) {
            const std::uint8_t* on = held.data() + 3 * e.nodes[k];
            if (!on[0] && !on[1] && !on[2]) continue;
            const SpaceGradient own = stiffness_block(e.shape, solid.kinds[e.kind], k, k);
            holds.push_back({ e.nodes[k],
                { { on[0] ? own.x.x : 0.0, 0.0, 0.0 }, { 0.0, on[1] ? own.y.y : 0.0, 0.0 },
                    { 0.0, 0.0, on[2] ? own.z.z : 0.0 } } });
        }
    }
    return holds;
}

/// The same grains, as if they were rigid.
RigidSolid as_rigid(const LinearSolid& solid, const Held& held)
{
    RigidSolid rigid(solid);
    for (std::size_t g = 0; g + 1 < solid.first_nodes.size(); ++g) {
        const int first = solid.first_nodes[g], end = solid.first_nodes[g + 1];
        rigid.grain.insert(rigid.grain.end(), end - first, static_cast<int>(g));
        rigid.centres.push_back(solid.places[end - 1]);
        rigid.radii.push_back(norm(solid.places[first] - rigid.centres.back()));
    }
    rigid.holds = holds_of(solid, held);
    return rigid;
}

/// Stiffness of contacts relative to that of grains, both against the strain of the whole solid [-].
double relative_stiffness(const RigidSolid& rigid)
{
    const LinearSolid& solid = rigid.solid;
    double of_contacts = 0.0, of_grains = 0.0;
    for (const LinearSolid::Face& face : solid.faces) {
        const auto centre = [&](int side) {
            return rigid.centres[rigid.grain[face.nodes[side][0]]];
        };
        const Vector branch = centre(1) - centre(0);
        for (const LinearSolid::Spring& s : face.springs)
            of_contacts += s.area * (face.normal_stiffness + 2.0 * face.shear_stiffness) / 3.0
                * dot(branch, branch);
    }
    for (const LinearSolid::Element& e : solid.elements)
        of_grains +=
            e.shape.volume * (solid.kinds[e.kind].normal + 2.0 * solid.kinds[e.kind].shear);
    return of_contacts / of_grains;
}

CoarseGrid straining_grid(const LinearSolid& solid, const RigidSolid& rigid)
{
    CoarseGrid grid(solid.places, rigid.centres, CoarseGrid::Moves::nodes);
    // volumes lie at the nodes, so that no motion of a node is without a stiffness
    std::vector<double> volumes(solid.places.size(), 0.0);
    std::vector<int> kind(volumes.size(), 0);
    for (const LinearSolid::Element& e : solid.elements) {
        for (int n : e.nodes) {
            volumes[n] += 0.25 * e.shape.volume;
            kind[n] = e.kind;
        }
    }
    for (std::size_t n = 0; n < volumes.size(); ++n)
        if (volumes[n] > 0.0) grid.add_volume(solid.places[n], volumes[n], solid.kinds[kind[n]]);
    for (const RigidSolid::Hold& h : rigid.holds)
        grid.add_spring(solid.places[h.node], h.k);
    for (const LinearSolid::Press& p : solid.presses)
        grid.add_spring(solid.place_of(p), press_block(p));
    grid.factorize();
    return grid;
}

CoarseGrid opening_grid(const RigidSolid& rigid)
{
    const LinearSolid& solid = rigid.solid;
    CoarseGrid grid(solid.places, rigid.centres, CoarseGrid::Moves::grains);
    for (const LinearSolid::Face& face : solid.faces) {
        const auto& [a, b] = face.nodes;
        const Vector branch =
            rigid.centres[rigid.grain[b.front()]] - rigid.centres[rigid.grain[a.front()]];
        for (const LinearSolid::Spring& s : face.springs) {
            Vector place;
            for (int k = 0; k < static_cast<int>(a.size()); ++k)
                place = place + s.share(k) * solid.places[a[k]];
            grid.add_contact(place, branch, spring_block(face, s));
        }
    }
    const auto hold = [&](int grain, Vector place, const SpaceGradient& k) {
        grid.add_spring(grain, place - rigid.centres[grain], k);
    };
    for (const RigidSolid::Hold& h : rigid.holds)
        hold(rigid.grain[h.node], solid.places[h.node], h.k);
    for (const LinearSolid::Press& p : solid.presses)
        hold(rigid.grain[p.nodes.front()], solid.place_of(p), press_block(p));
    grid.factorize();
    return grid;
}

/// Smooth motions of nodes, which open no contact.
class SmoothNodes : public WideMotions {
public:
    SmoothNodes(CoarseGrid grid, const Held& held) : grid_(std::move(grid)), held_(held) { }
    void add(const double* forces, double* u) const override { grid_.add_motion(held_, forces, u); }

private:
    CoarseGrid grid_;
    const Held& held_;
};

/// 1 for unknowns of rigid grains that are held, or that nothing resists: translations or turns of
/// grains whose blocks are 0 but for rounding.
Held not_moved(const DiagonalBlocks& blocks, Held held)
{
    constexpr double rounding = 1e-12;
    const auto trace = [&](std::size_t triple) {
        const double* k = blocks.values().data() + 9 * triple;
        return k[0] + k[4] + k[8];
    };
    for (std::size_t i = 0; i + 5 < held.size(); i += 6) {
        const double way = trace(i / 3), turn = trace(i / 3 + 1), least = rounding * (way + turn);
        for (int axis = 0; axis < 3; ++axis) {
            if (!(way > least)) held[i + axis] = 1;
            if (!(turn > least)) held[i + 3 + axis] = 1;
        }
    }
    return held;
}

/// Smooth motions of rigid grains, which open contacts.
class SmoothGrains : public WideMotions {
public:
    /// @param held  of the unknowns, and of grains that nothing resists
    SmoothGrains(const RigidSolid& rigid, Held held) :
        rigid_(rigid),
        held_(std::move(held)),
        grid_(opening_grid(rigid))
    {
    }
    void add(const double* forces, double* u) const override
    {
        std::vector<GridMotion> loads;
        loads.reserve(rigid_.centres.size());
        for (int g = 0; g < static_cast<int>(rigid_.centres.size()); ++g)
            loads.push_back(
                { triple_at(forces, 2 * g), rigid_.radii[g] * triple_at(forces, 2 * g + 1) });
        const std::vector<GridMotion> motions = grid_.motions(loads);
        for (int g = 0; g < static_cast<int>(motions.size()); ++g) {
            add_free(u, held_, 2 * g, motions[g].way);
            add_free(u, held_, 2 * g + 1, rigid_.radii[g] * motions[g].turn);
        }
    }

private:
    const RigidSolid& rigid_;
    Held held_;
    CoarseGrid grid_;
};

/// Motions in which deformable grains stay rigid: of each alone, and smooth ones.
class RigidMotions : public WideMotions {
public:
    RigidMotions(RigidSolid rigid, const Held& held) :
        rigid_(std::move(rigid)),
        held_(held),
        blocks_(rigid_.diagonal_blocks()),
        loose_(not_moved(blocks_, Held(6 * rigid_.centres.size(), 0))),
        smooth_(rigid_, loose_)
    {
        blocks_.invert(loose_);
    }
    void add(const double* forces, double* u) const override
    {
        std::vector<double> on(loose_.size(), 0.0), motion(on.size());
        rigid_.gather(forces, on.data());
        for (std::size_t i = 0; i < on.size(); ++i)
            if (loose_[i]) on[i] = 0.0;
        blocks_.multiply(on.data(), motion.data());
        smooth_.add(on.data(), motion.data());
        rigid_.for_each_node(motion.data(), [&](int n, Vector way) { add_free(u, held_, n, way); });
    }

private:
    RigidSolid rigid_;
    const Held& held_;
    DiagonalBlocks blocks_;
    Held loose_;
    SmoothGrains smooth_;
};

}  // namespace

std::vector<std::unique_ptr<WideMotions>> wide_motions_of(
    const LinearSolid& solid, const Held& held)
{
    std::vector<std::unique_ptr<WideMotions>> found;
    RigidSolid rigid = as_rigid(solid, held);
    found.push_back(std::make_unique<SmoothNodes>(straining_grid(solid, rigid), held));
    if (relative_stiffness(rigid) < stiff_contacts || rigid.centres.size() > many_grains)
        found.push_back(std::make_unique<RigidMotions>(std::move(rigid), held));
    return found;
}

std::vector<std::unique_ptr<WideMotions>> wide_motions_of(const RigidSolid& rigid, const Held& held)
{
    std::vector<std::unique_ptr<WideMotions>> found;
    // sets of nodes that float have unknowns at the end
    Held own(held.begin(), held.begin() + static_cast<long>(6 * rigid.centres.size()));
    found.push_back(
        std::make_unique<SmoothGrains>(rigid, not_moved(rigid.diagonal_blocks(), std::move(own))));
    return found;
}

}  // namespace flexpm
