// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  BodyOverlap of convex bodies in both dimensions against closed forms, differences of its
/// energy, and its balances.
#include "support/catch.hpp"
#include "support/convex_bodies.hpp"
#include "support/sphere_samples.hpp"

using namespace convex_bodies;

namespace {

constexpr Vector half_of_one { 0.5, 0.5, 0.5 };

/// Body turned about its centre.
template <class Geometry> Body<Geometry> turned_body(Body<Geometry> body, const Quaternion& turn)
{
    for (Vector& node : body.nodes)
        node = turned(turn, node);
    return body;
}

/// Body at a distance above another of height 1, so that both overlap by a depth [m].
template <class Geometry> Body<Geometry> lowered(Body<Geometry> body, double depth)
{
    double lowest = 0.0;
    for (const Vector& node : body.nodes)
        lowest = std::min(lowest, node.y);
    body.centre = { 0.0, 0.5 - lowest - depth, 0.0 };
    return body;
}

template <class Geometry>
Vector force_from(const Body<Geometry>& below, const Body<Geometry>& above)
{
    PairOverlap<Geometry> pair;
    overlap_of(pair, below, above);
    return force_on(pair, below, 1);
}

/// Prism of a plane's body with ends that do not count.
Body<InSpace> prism_of(const Body<InPlane>& body, double thickness)
{
    Body<InSpace> prism;
    prism.centre = body.centre;
    const int n = static_cast<int>(body.nodes.size());
    for (const double z : { -0.5 * thickness, 0.5 * thickness })
        for (const Vector& node : body.nodes)
            prism.nodes.push_back(node + Vector { 0.0, 0.0, z });
    for (std::size_t f = 0; f < body.faces.size(); ++f) {
        const int i = body.faces[f][0], k = body.faces[f][1];
        prism.faces.push_back({ i, k, k + n, i + n });
        prism.counted.push_back(body.counted[f]);
    }
    // edges have no order
    std::vector<int> ring { 0 };
    while (static_cast<int>(ring.size()) < n) {
        for (const std::vector<int>& edge : body.faces) {
            if (edge[0] != ring.back()) continue;
            ring.push_back(edge[1]);
            break;
        }
    }
    std::vector<int> back(ring.rbegin(), ring.rend());
    for (int& node : ring)
        node += n;
    prism.faces.push_back(back);
    prism.faces.push_back(ring);
    prism.counted.insert(prism.counted.end(), 2, false);
    return prism;
}

/// Two random rigid bodies that collide, stepped by velocity Verlet. Their inertia is that of a sphere
/// or a disc, so that a spin is constant without a moment.
template <class Geometry> class Impact {
public:
    explicit Impact(std::uint64_t seed) : random(seed), bodies { draw(), draw() }
    {
        const Vector toward = direction<Geometry>(random);
        bodies[1].centre = toward;
        set_depth(pair, bodies[0], bodies[1], 1e-9);
        bodies[1].centre = bodies[1].centre + 1e-3 * toward;
        velocity = { 0.5 * toward, -0.5 * toward };
        for (Vector& s : spin)
            s = between(random, -1.0, 1.0) * axis();
    }

    /// Step until the bodies have separated. Return the number of steps in touch, 0 if they never touch.
    int run(double dt)
    {
        const double before = kinetic();
        force();
        int touched = 0;
        for (int step = 0; step < 100000; ++step) {
            for (int k = 0; k < 2; ++k) {
                velocity[k] = velocity[k] + 0.5 * dt * forces[k];
                spin[k] = spin[k] + (0.5 * dt / inertia) * moments[k];
                bodies[k].centre = bodies[k].centre + dt * velocity[k];
                const Quaternion by = rotation_by(dt * spin[k]);
                for (Vector& node : bodies[k].nodes)
                    node = turned(by, node);
            }
            force();
            for (int k = 0; k < 2; ++k) {
                velocity[k] = velocity[k] + 0.5 * dt * forces[k];
                spin[k] = spin[k] + (0.5 * dt / inertia) * moments[k];
            }
            lost_in_touch = std::max(lost_in_touch, std::abs(kinetic() + stored - before) / before);
            if (stored > 0.0) {
                ++touched;
            } else if (touched > 0) {
                lost = std::abs(kinetic() - before) / before;
                return touched;
            }
        }
        return 0;
    }

    double lost = 0.0;           ///< of the energy, after separation [-]
    double lost_in_touch = 0.0;  ///< largest one in touch [-]

private:
    static constexpr double stiffness = 1e5, inertia = 0.1;

    Random random;
    PairOverlap<Geometry> pair;
    std::array<Body<Geometry>, 2> bodies;
    std::array<Vector, 2> velocity, spin, forces, moments;
    double stored = 0.0;

    Body<Geometry> draw() { return random_body<Geometry>(random); }
    Vector axis()
    {
        return Geometry::dimension == 3 ? direction<Geometry>(random) : Vector { 0, 0, 1 };
    }
    double kinetic() const
    {
        double sum = 0.0;
        for (int k = 0; k < 2; ++k)
            sum += 0.5 * dot(velocity[k], velocity[k]) + 0.5 * inertia * dot(spin[k], spin[k]);
        return sum;
    }
    void force()
    {
        stored = stiffness * overlap_of(pair, bodies[0], bodies[1]).energy;
        forces = moments = {};
        for (const FaceForce& on : pair.forces()) {
            const int k = on.face < static_cast<int>(bodies[0].faces.size()) ? 0 : 1;
            forces[k] = forces[k] + stiffness * on.force;
            moments[k] = moments[k] + stiffness * cross(on.point, on.force);
        }
    }
};

}  // namespace

TEMPLATE_TEST_CASE(
    "boxes press flush or half off by the closed form", "[overlap]", InPlane, InSpace)
{
    const Body<TestType> below = box<TestType>(half_of_one);
    const bool space = TestType::dimension == 3;
    for (const double depth : { 0.1, 1e-2, 1e-3 }) {
        Body<TestType> above = lowered(below, depth);
        PairOverlap<TestType> pair;
        const BodyOverlap flush = overlap_of(pair, below, above);
        const double ratio = space ? 1.0 - depth + depth * depth / 3.0 : 1.0 - 0.5 * depth;
        const Vector force = force_on(pair, below, 1);
        CHECK(force.y / depth == Approx(ratio).epsilon(1e-11));
        CHECK(std::abs(force.x) < 1e-14);
        const double cube = depth * depth * depth;
        const double energy = space ? 0.5 * depth * depth - cube / 3.0 + depth * cube / 12.0
                                    : 0.5 * depth * depth - cube / 6.0;
        CHECK(flush.energy == Approx(energy).epsilon(1e-11));
        CHECK(flush.depth == Approx(0.5 * depth).epsilon(1e-11));
        // sides of both lie in the same planes, which belong to the first body
        CHECK(flush.area == Approx(1.0).epsilon(1e-11));

        // one half off: the overlap is a box, two sides of which belong to different bodies
        above.centre.x = 0.5;
        const Vector half = force_from(below, above);
        const double square = depth * depth;
        CHECK(half.y
            == Approx(space ? 0.5 * depth - 0.75 * square + cube / 3.0 : 0.5 * depth - 0.5 * square)
                   .epsilon(1e-11));
        CHECK(half.x == Approx(0.5 * square - (space ? cube / 6.0 : 0.0)).epsilon(1e-11));
    }
}

TEST_CASE("a corner of a square on an edge presses by the closed form", "[overlap]")
{
    const Body<InPlane> below = box<InPlane>(half_of_one);
    for (const double depth : { 0.05, 1e-3 }) {
        const Quaternion turn = rotation_by({ 0.0, 0.0, 0.25 * pi });
        const Vector force = force_from(below, lowered(turned_body(below, turn), depth));
        CHECK(force.y == Approx(2.0 * (std::sqrt(2.0) - 1.0) * depth * depth).epsilon(1e-9));
    }
}

TEST_CASE("corner, edge and crossed edges of cubes press by the closed forms", "[overlap]")
{
    const Body<InSpace> cube = box<InSpace>(half_of_one);
    const double root = std::sqrt(2.0) - 1.0;
    for (const double depth : { 0.05, 1e-3 }) {
        const double cubed = depth * depth * depth;
        // the diagonal of the cube along -y
        const Vector axis = (1.0 / std::sqrt(2.0)) * Vector { 1.0, 0.0, -1.0 };
        const Quaternion upright = rotation_by(std::acos(1.0 / std::sqrt(3.0)) * axis);
        const Body<InSpace> corner = lowered(turned_body(cube, upright), depth);
        CHECK(force_from(cube, corner).y
            == Approx(0.5 * (3.0 - std::sqrt(3.0)) * cubed).epsilon(1e-9));

        // the ends of the edge, of length 0.4, take the corrections of the third order
        const Quaternion onto_edge = rotation_by({ 0.0, 0.0, 0.25 * pi });
        const Body<InSpace> beam = box<InSpace>({ 0.5, 0.5, 0.2 });
        const Body<InSpace> edge = lowered(turned_body(beam, onto_edge), depth);
        CHECK(force_from(cube, edge).y
            == Approx(2.0 * root * depth * depth * 0.4 - 4.0 / 3.0 * root * root * cubed)
                   .epsilon(1e-9));

        const Quaternion across = rotation_by({ 0.25 * pi, 0.0, 0.0 });
        Body<InSpace> below = turned_body(cube, onto_edge), above = turned_body(cube, across);
        below.centre = {};
        above.centre = { 0.0, std::sqrt(2.0) - depth, 0.0 };
        CHECK(force_from(below, above).y == Approx(std::sqrt(2.0) / 3.0 * cubed).epsilon(1e-9));
    }
}

TEMPLATE_TEST_CASE("walls and equal planes count once", "[overlap]", InPlane, InSpace)
{
    // A layer of the depth below a wall that lies where the floor of one body and the top of the
    // other are equally near; all other faces of both are walls in the same planes.
    const double layer = 0.02;
    Body<TestType> a = box<TestType>({ 0.5, 0.5 * layer, 0.5 }), b = box<TestType>(half_of_one);
    a.counted.assign(a.faces.size(), false);
    b.counted = a.counted;
    a.counted[3] = b.counted[2] = true;
    Random random(29);
    PairOverlap<TestType> pair;
    for (int k = 0; k < 50; ++k) {
        const Quaternion turn = rotation<TestType>(random);
        Body<TestType> one = turned_body(a, turn), two = turned_body(b, turn);
        one.centre = turned(turn, { 0.0, 0.5 * layer, 0.0 });
        two.centre = turned(turn, { 0.0, 2.0 * layer - 0.5, 0.0 });
        const BodyOverlap found = overlap_of(pair, one, two);
        CHECK(found.energy == Approx(layer * layer).epsilon(1e-11));
        CHECK(found.depth == Approx(layer).epsilon(1e-11));
        // the floor is pushed by all of the layer, the wall by the pressure on it
        double floor = 0.0, wall = 0.0;
        for (const FaceForce& on : pair.forces()) {
            if (on.face == 2) wall = norm(on.force);
            if (on.face == 3) floor = norm(on.force);
            if (on.face >= static_cast<int>(a.faces.size())) CHECK(norm(on.force) < 1e-12);
        }
        CHECK(floor == Approx(2.0 * layer).epsilon(1e-11));
        CHECK(wall == Approx(2.0 * layer).epsilon(1e-11));
        CHECK(norm(force_on(pair, one, 0)) < 1e-12);
        // walls that touch have nothing between them
        two.centre = turned(turn, { 0.0, 0.5 + layer, 0.0 });
        CHECK(overlap_of(pair, one, two).energy < 1e-15);
    }
}

TEMPLATE_TEST_CASE("slanted walls take the closed form", "[overlap]", InPlane, InSpace)
{
    // The sides of the upper body lean outwards or inwards and do not count: its section at a
    // height t above the lower face is 0.6 + 2 lean t wide.
    const double root = std::sqrt(0.5), depth = 0.05, width = 0.6;
    for (const double lean : { 1.0, -1.0 }) {
        std::vector<Vector> normals { { root, -lean * root, 0 }, { -root, -lean * root, 0 },
            { 0, 1, 0 }, { 0, -1, 0 } };
        std::vector<double> offsets { root * (0.3 + 0.1 * lean), root * (0.3 + 0.1 * lean), 0.1,
            0.1 };
        if (TestType::dimension == 3) {
            normals.insert(normals.end(), { { 0, 0, 1 }, { 0, 0, -1 } });
            offsets.insert(offsets.end(), { 0.5, 0.5 });
        }
        Body<TestType> above = lowered(body_of<TestType>(normals, offsets), depth);
        above.counted.assign(above.faces.size(), false);
        above.counted[2] = above.counted[3] = true;
        PairOverlap<TestType> pair;
        const BodyOverlap found = overlap_of(pair, box<TestType>({ 2.0, 0.5, 2.0 }), above);
        CHECK(found.energy == Approx(0.5 * depth * depth * (width + lean * depth)).epsilon(1e-11));
        CHECK(found.area == Approx(width + std::min(2.0 * lean * depth, 0.0)).epsilon(1e-11));
        CHECK(found.depth == Approx(0.5 * depth).epsilon(1e-11));
    }
}

TEMPLATE_TEST_CASE("the energy is the sum of depths over points", "[overlap]", InPlane, InSpace)
{
    Random random(31);
    PairOverlap<TestType> pair;
    for (int k = 0; k < 4; ++k) {
        RandomPair<TestType> sampled(pair, random, 0.08);
        for (Body<TestType>* const body : { &sampled.a, &sampled.b })
            for (std::size_t f = 0; f < body->faces.size(); ++f)
                body->counted[f] = k == 0 || random.next() < 0.6;
        const Planes<TestType> of_a(sampled.a), of_b(sampled.b);
        const double energy = pair.measure(of_a.view, of_b.view, 0.0).energy;
        // rows of points through the overlap, as far as the second body reaches
        const int rows = TestType::dimension == 3 ? 60 : 400;
        const double side = 1.6, step = side / rows;
        const auto depth_at = [&](Vector at) {
            double least = 1e300;
            for (const Planes<TestType>* const of : { &of_a, &of_b }) {
                for (const ContactPlane& p : of->planes) {
                    const double depth = p.offset - dot(p.normal, at - of->view.centre);
                    if (depth < 0.0) return 0.0;
                    if (p.counted) least = std::min(least, depth);
                }
            }
            return least;
        };
        double sum = 0.0;
        for (int i = 0; i < rows; ++i)
            for (int j = 0; j < rows; ++j)
                for (int l = 0; l < (TestType::dimension == 3 ? rows : 1); ++l) {
                    const Vector from { -0.5 * side + (i + 0.5) * step,
                        -0.5 * side + (j + 0.5) * step,
                        TestType::dimension == 3 ? -0.5 * side + (l + 0.5) * step : 0.0 };
                    sum += depth_at(sampled.b.centre + from);
                }
        CHECK(2.0 * sum * std::pow(step, TestType::dimension) == Approx(energy).epsilon(0.05));
    }
}

TEMPLATE_TEST_CASE("the overlap scales with the size of the bodies", "[overlap]", InPlane, InSpace)
{
    Random random(3);
    PairOverlap<TestType> pair;
    for (int k = 0; k < 20; ++k) {
        const RandomPair<TestType> sampled(pair, random, between(random, 0.001, 0.08));
        const BodyOverlap once = overlap_of(pair, sampled.a, sampled.b);
        const std::vector<FaceForce> forces = pair.forces();
        for (const double scale : { 1e-4, 1e3 }) {
            Body<TestType> a = sampled.a, b = sampled.b;
            for (Body<TestType>* const body : { &a, &b }) {
                body->centre = scale * body->centre;
                for (Vector& node : body->nodes)
                    node = scale * node;
            }
            const BodyOverlap scaled = overlap_of(pair, a, b);
            CHECK(scaled.energy
                == Approx(once.energy * std::pow(scale, TestType::dimension + 1)).epsilon(1e-9));
            CHECK(scaled.depth == Approx(once.depth * scale).epsilon(1e-9));
            REQUIRE(pair.forces().size() == forces.size());
        }
    }
}

TEMPLATE_TEST_CASE(
    "nodal forces are the gradient of the energy and balance", "[overlap]", InPlane, InSpace)
{
    Random random(5);
    PairOverlap<TestType> pair;
    int walls = 0;
    const int pairs = flexpm_test::cases("FLEXPM_PAIRS", 500);
    for (int k = 0; k < pairs; ++k) {
        const double depth = between(random, 0.0005, 0.08);
        RandomPair<TestType> sampled(pair, random, depth);
        Body<TestType>&a = sampled.a, &b = sampled.b;
        // one half of the pairs has faces that do not count, two thirds a clearance
        if (k % 2 == 1) {
            for (Body<TestType>* const body : { &a, &b })
                for (std::size_t f = 0; f < body->faces.size(); ++f)
                    body->counted[f] = random.next() < 0.6;
        }
        const double clearance = std::array<double, 3> { 0.0, 0.3 * depth, -0.2 * depth }[k % 3];
        // bent faces
        for (Body<TestType>* const body : { &a, &b })
            for (Vector& node : body->nodes)
                node = node + 1e-3 * depth * direction<TestType>(random);

        const BodyOverlap found = overlap_of(pair, a, b, clearance, false);
        const auto forces = nodal_forces(pair, a, b);
        const int first = static_cast<int>(a.faces.size());
        Vector sum, moment, nodal_sum, nodal_moment;
        double size = 0.0;
        for (const FaceForce& on : pair.forces()) {
            const bool of_a = on.face < first;
            walls += of_a ? !a.counted[on.face] : !b.counted[on.face - first];
            sum = sum + on.force;
            moment = moment + cross(on.point + (of_a ? a : b).centre - a.centre, on.force);
            size += norm(on.force);
        }
        std::array<std::vector<Vector>, 2> displacements;
        double slope = 0.0, all = 0.0;
        for (int q = 0; q < 2; ++q) {
            const Body<TestType>& body = q == 0 ? a : b;
            for (std::size_t i = 0; i < body.nodes.size(); ++i) {
                const Vector at = body.nodes[i] + body.centre - a.centre;
                displacements[q].push_back(direction<TestType>(random));
                slope -= dot(displacements[q].back(), forces[q][i]);
                all += norm(forces[q][i]);
                nodal_sum = nodal_sum + forces[q][i];
                nodal_moment = nodal_moment + cross(at, forces[q][i]);
            }
        }
        CAPTURE(k, depth, found.energy, found.depth);
        REQUIRE(found.energy > 0.0);
        CHECK(norm(sum) <= 1e-12 * size);
        CHECK(norm(moment) <= 1e-12 * size);
        CHECK(norm(nodal_sum) <= 1e-12 * all);
        CHECK(norm(nodal_moment) <= 1e-12 * all);
        const auto energy = [&](double step) {
            Body<TestType> one = a, two = b;
            for (std::size_t i = 0; i < one.nodes.size(); ++i)
                one.nodes[i] = one.nodes[i] + step * displacements[0][i];
            for (std::size_t i = 0; i < two.nodes.size(); ++i)
                two.nodes[i] = two.nodes[i] + step * displacements[1][i];
            return overlap_of(pair, one, two, clearance, false).energy;
        };
        const double h = 1e-3 * std::min(depth, found.depth);
        const double difference =
            (8.0 * (energy(h) - energy(-h)) - (energy(2.0 * h) - energy(-2.0 * h))) / (12.0 * h);
        CHECK(std::abs(difference - slope) <= 1e-7 * all);
    }
    CHECK(walls > pairs / 10);
}

TEMPLATE_TEST_CASE("each node's force is a derivative of the energy", "[overlap]", InPlane, InSpace)
{
    Random random(7);
    PairOverlap<TestType> pair;
    for (int k = 0; k < 5; ++k) {
        RandomPair<TestType> sampled(pair, random, between(random, 0.01, 0.05));
        const double depth = overlap_of(pair, sampled.a, sampled.b).depth, h = 1e-3 * depth;
        const auto forces = nodal_forces(pair, sampled.a, sampled.b);
        double all = 0.0;
        for (int q = 0; q < 2; ++q)
            for (const Vector& force : forces[q])
                all += norm(force);
        for (int q = 0; q < 2; ++q) {
            for (std::size_t i = 0; i < forces[q].size(); ++i) {
                const Vector displacement = direction<TestType>(random);
                const auto energy = [&](double step) {
                    Body<TestType> one = sampled.a, two = sampled.b;
                    Vector& node = (q == 0 ? one : two).nodes[i];
                    node = node + step * displacement;
                    return overlap_of(pair, one, two, 0.0, false).energy;
                };
                const double difference =
                    (8.0 * (energy(h) - energy(-h)) - (energy(2.0 * h) - energy(-2.0 * h)))
                    / (12.0 * h);
                CHECK(std::abs(difference + dot(displacement, forces[q][i])) <= 1e-7 * all);
            }
        }
    }
}

TEMPLATE_TEST_CASE(
    "a body across the seam of two bonded ones feels no seam", "[overlap]", InPlane, InSpace)
{
    Random random(11);
    PairOverlap<TestType> pair;
    const Body<TestType> whole = box<TestType>({ 2.0, 0.5, 2.0 });
    Body<TestType> left = box<TestType>({ 1.0, 0.5, 2.0 }), right = left;
    left.centre.x = -1.0;
    right.centre.x = 1.0;
    double most = 0.0;
    for (int k = 0; k < 50; ++k) {
        const double depth = between(random, 0.001, 0.05);
        Body<TestType> above = lowered(random_body<TestType>(random), depth);
        above.centre.x = between(random, -0.4, 0.4);
        left.counted.assign(left.faces.size(), true);
        right.counted = left.counted;
        const auto halves = [&] {
            Vector sum = force_from(left, above);
            return sum + force_from(right, above);
        };
        const double with_seam = std::abs(halves().x);
        left.counted[0] = right.counted[1] = false;
        const double energy = overlap_of(pair, whole, above).energy;
        const Vector force = force_on(pair, whole, 1), sum = halves();
        CHECK(std::abs(sum.x) <= 1e-12 * force.y);
        CHECK(norm(sum - force) <= 1e-11 * force.y);
        CHECK(overlap_of(pair, left, above).energy + overlap_of(pair, right, above).energy
            == Approx(energy).epsilon(1e-11));
        most = std::max(most, with_seam / force.y);
    }
    CHECK(most > 0.05);  // a counted seam is felt
}

TEMPLATE_TEST_CASE("pairs are born without energy and force", "[overlap]", InPlane, InSpace)
{
    Random random(13);
    PairOverlap<TestType> pair;
    std::vector<Body<TestType>> bodies;
    for (int k = 0; k < 40; ++k) {
        bodies.push_back(random_body<TestType>(random));
        if (k % 4 != 0) continue;
        for (Vector& node : bodies.back().nodes)
            node = node + 0.01 * direction<TestType>(random);
    }
    int born = 0, unborn = 0, forces = 0;
    double most = 0.0;
    const auto draw = [&] { return static_cast<std::size_t>(40.0 * random.next()); };
    const int births = 10 * flexpm_test::cases("FLEXPM_PAIRS", 500);
    while (born < births) {
        const std::size_t i = draw(), k = draw();
        Body<TestType>&a = bodies[i], &b = bodies[k];
        if (i == k) continue;
        // corner to corner, or the middle of two corners of a face to that of another
        const auto& face =
            a.faces[static_cast<std::size_t>(static_cast<double>(a.faces.size()) * random.next())];
        Vector at = a.nodes[face[0]];
        if (born % 2 == 1) at = 0.5 * (at + a.nodes[face[1]]);
        const Vector outward = (1.0 / norm(at)) * at;
        Vector nearest = b.nodes[0];
        for (const std::vector<int>& other : b.faces) {
            Vector to = b.nodes[other[0]];
            if (born % 2 == 1) to = 0.5 * (to + b.nodes[other[1]]);
            if (dot(to, outward) < dot(nearest, outward)) nearest = to;
        }
        b.centre = a.centre + at - nearest - between(random, 1e-5, 0.05) * outward;
        const bool flat = i % 4 != 0 && k % 4 != 0;
        const Planes<TestType> of_a(a, flat), of_b(b, flat);
        const double depth = pair.measure(of_a.view, of_b.view, 0.0).depth;
        if (!(depth > 0.0)) continue;
        ++born;
        const BodyOverlap at_birth = pair.measure(of_a.view, of_b.view, depth + 1e-12);
        forces += !pair.forces().empty();
        unborn += at_birth.energy == 0.0 && at_birth.depth == 0.0 && at_birth.area == 0.0;
        // and with more clearance
        const double more = depth * (1.0 + 3.0 * random.next() * random.next());
        unborn -= pair.measure(of_a.view, of_b.view, more).energy != 0.0;
        if (born % 10 != 0) continue;
        most = std::max(most, pair.birth_clearance(of_a.view, of_b.view) - depth);
        forces += !pair.forces().empty();
        // a part of the overlap is left below the clearance
        CHECK(pair.measure(of_a.view, of_b.view, 0.999 * depth).energy > 0.0);
    }
    CHECK(unborn == born);
    CHECK(forces == 0);
    CHECK(most < 1e-11);
}

TEMPLATE_TEST_CASE("small overlaps keep their digits", "[overlap]", InPlane, InSpace)
{
    // mostly edges that cross: no face separates bodies that nearly touch
    Random random(37);
    PairOverlap<TestType> pair;
    for (int k = 0; k < 200; ++k) {
        RandomPair<TestType> sampled(pair, random, 1e-3);
        const double depth = overlap_of(pair, sampled.a, sampled.b).depth;
        for (const double part : { 1e-2, 1e-4 }) {
            const double rest = part * depth;
            const BodyOverlap found = overlap_of(pair, sampled.a, sampled.b, depth - rest);
            CHECK(found.depth == Approx(rest).epsilon(1e-14 / rest));
            Vector sum, moment;
            double size = 0.0;
            for (const FaceForce& on : pair.forces()) {
                const bool of_a = on.face < static_cast<int>(sampled.a.faces.size());
                const Vector from = of_a ? Vector {} : sampled.b.centre - sampled.a.centre;
                sum = sum + on.force;
                moment = moment + cross(on.point + from, on.force);
                size += norm(on.force);
            }
            CHECK(norm(sum) <= 1e-16 / rest * size);
            CHECK(norm(moment) <= 1e-16 / rest * size);
            CHECK(overlap_of(pair, sampled.a, sampled.b, depth + rest).energy == 0.0);
        }
    }
}

TEMPLATE_TEST_CASE("a clearance is found from the energy", "[overlap]", InPlane, InSpace)
{
    // all faces of both squares or cubes move inwards
    const Body<TestType> below = box<TestType>(half_of_one), above = lowered(below, 0.1);
    const Planes<TestType> of_a(below), of_b(above);
    PairOverlap<TestType> pair;
    for (const double c : { 0.02, 0.0, -0.01 }) {
        const double side = 1.0 - 2.0 * c, depth = 0.1 - 2.0 * c;
        const double cube = depth * depth * depth;
        const double energy = TestType::dimension == 3
            ? 0.5 * side * side * depth * depth - side * cube / 3.0 + depth * cube / 12.0
            : 0.5 * side * depth * depth - cube / 6.0;
        CHECK(std::abs(pair.clearance_for(of_a.view, of_b.view, energy) - c) < 1e-12);
    }
    Random random(17);
    for (int k = 0; k < 40; ++k) {
        const RandomPair<TestType> sampled(pair, random, between(random, 0.001, 0.08));
        const Planes<TestType> one(sampled.a), two(sampled.b);
        const double energy = pair.measure(one.view, two.view, 0.0).energy;
        for (const double share : { 1e-6, 0.5, 0.99, 1.3, 5.0 }) {
            const double c = pair.clearance_for(one.view, two.view, share * energy);
            CHECK((c > 0.0) == (share < 1.0));
            CHECK(
                pair.measure(one.view, two.view, c).energy == Approx(share * energy).epsilon(1e-9));
        }
        CHECK(pair.clearance_for(one.view, two.view, 0.0)
            == pair.birth_clearance(one.view, two.view));
    }
}

TEST_CASE("an energy that no clearance gives is refused", "[overlap]")
{
    Body<InSpace> a = box<InSpace>(half_of_one), b = lowered(a, 0.1);
    a.counted.assign(a.faces.size(), false);
    b.counted = a.counted;
    const Planes<InSpace> of_a(a), of_b(b);
    SpaceOverlap pair;
    CHECK_THROWS_WITH(
        pair.clearance_for(of_a.view, of_b.view, 1e-6), Catch::Contains("counted faces"));
    CHECK_THROWS_AS(pair.clearance_for(of_a.view, of_b.view, -1.0), std::invalid_argument);
    // without a counted face there is no depth
    CHECK(pair.measure(of_a.view, of_b.view, 0.0).energy == 0.0);
    CHECK(pair.forces().empty());
}

TEST_CASE("a slab of one cell has the overlap of the plane", "[overlap]")
{
    Random random(19);
    PlaneOverlap in_plane;
    SpaceOverlap in_space;
    const double thickness = 0.2;
    for (int k = 0; k < 100; ++k) {
        RandomPair<InPlane> sampled(in_plane, random, between(random, 0.0005, 0.08));
        if (k % 2 == 1)
            for (std::size_t f = 0; f < sampled.a.faces.size(); ++f)
                sampled.a.counted[f] = random.next() < 0.6;
        const BodyOverlap plane = overlap_of(in_plane, sampled.a, sampled.b);
        const Body<InSpace> a = prism_of(sampled.a, thickness), b = prism_of(sampled.b, thickness);
        const BodyOverlap slab = overlap_of(in_space, a, b);
        CHECK(slab.energy == Approx(thickness * plane.energy).epsilon(1e-9));
        CHECK(slab.depth == Approx(plane.depth).epsilon(1e-9));
        CHECK(slab.area == Approx(thickness * plane.area).epsilon(1e-9));
        const int sides = static_cast<int>(sampled.a.faces.size());
        double most = 0.0;
        for (const FaceForce& on : in_plane.forces())
            most = std::max(most, norm(on.force));
        for (const FaceForce& on : in_plane.forces()) {
            const int face = on.face < sides ? on.face : on.face + 2;
            const auto same = std::find_if(in_space.forces().begin(), in_space.forces().end(),
                [&](const FaceForce& other) { return other.face == face; });
            REQUIRE(same != in_space.forces().end());
            CHECK(norm(same->force - thickness * on.force) <= 1e-9 * thickness * most);
            // the point of a small force has few digits
            CHECK(norm(same->point - on.point) * norm(on.force) <= 1e-9 * most);
        }
    }
}

TEMPLATE_TEST_CASE("a remembered plane changes no bit", "[overlap]", InPlane, InSpace)
{
    Random random(23);
    PairOverlap<TestType> pair;
    for (int k = 0; k < 100; ++k) {
        RandomPair<TestType> sampled(pair, random, between(random, 0.0005, 0.08));
        const Vector apart = sampled.b.centre - sampled.a.centre;
        if (k % 2 == 1) sampled.b.centre = sampled.b.centre + 0.1 * apart;
        const Planes<TestType> one(sampled.a), two(sampled.b);
        const BodyOverlap first = pair.measure(one.view, two.view, 0.0);
        const std::vector<FaceForce> forces = pair.forces();
        const int all = one.view.faces + two.view.faces;
        int separating = static_cast<int>(all * random.next());
        for (int again = 0; again < 2; ++again) {
            const BodyOverlap second = pair.measure(one.view, two.view, 0.0, &separating);
            CHECK((separating >= 0 && separating < all));
            CHECK(second.energy == first.energy);
            CHECK(second.depth == first.depth);
            CHECK(second.area == first.area);
            REQUIRE(pair.forces().size() == forces.size());
            for (std::size_t i = 0; i < forces.size(); ++i) {
                CHECK(pair.forces()[i].force.x == forces[i].force.x);
                CHECK(pair.forces()[i].point.y == forces[i].point.y);
            }
        }
    }
}

TEMPLATE_TEST_CASE("an impact without friction returns its energy", "[overlap]", InPlane, InSpace)
{
    std::array<double, 3> worst {}, worst_in_touch {};
    for (std::uint64_t seed = 1; seed <= 7; ++seed) {
        const double trial = 1e-4;
        const double time = trial * Impact<TestType>(seed).run(trial);
        REQUIRE(time > 0.0);
        const std::array<double, 3> steps { 24.0, 95.0, 190.0 };
        for (std::size_t k = 0; k < steps.size(); ++k) {
            Impact<TestType> impact(seed);
            const int touched = impact.run(time / steps[k]);
            CHECK(touched == Approx(steps[k]).margin(2.0));
            worst[k] = std::max(worst[k], impact.lost);
            worst_in_touch[k] = std::max(worst_in_touch[k], impact.lost_in_touch);
        }
    }
    CAPTURE(worst[0], worst[1], worst[2], worst_in_touch[0], worst_in_touch[1], worst_in_touch[2]);
    CHECK(worst[2] < 1e-6);
    // at least as dt^2, after separation and in touch
    CHECK(worst[1] < worst[0] / 12.0);
    CHECK(worst_in_touch[2] < worst_in_touch[1] / 3.0);
}
