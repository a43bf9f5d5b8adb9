// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/assembly/solid_plan.hpp>

#include <flexpm/kernel/assembly/access.hpp>

#include <algorithm>

namespace flexpm {

namespace {

/// First places in a list of so many, and the end, from the number of values of each.
std::vector<int> ends_of(const std::vector<int>& counts)
{
    std::vector<int> ends { 0 };
    for (int count : counts)
        ends.push_back(ends.back() + count);
    return ends;
}

int tile_of_grain(const SolidState& s, int grain) { return s.grains.block_of(grain) / tile_grains; }

void find_tiles(SolidState& s)
{
    const FaceContacts& c = s.contacts;
    SolidPlan& plan = s.plan;
    const int tiles = (s.grains.blocks() + tile_grains - 1) / tile_grains;
    plan.tile_contacts.assign(tiles + 1, 0);
    plan.first_tile.resize(s.grains.blocks());
    for (int block = 0; block < s.grains.blocks(); ++block)
        plan.first_tile[block] = block / tile_grains;
    for (int contact = 0; contact < c.count; ++contact) {
        const int tile = tile_of(s, contact);
        int& end = plan.tile_contacts[tile + 1];
        end = std::max(end, c.block_of(contact) + 1);
        for (int grain : c.pairs[contact]) {
            int& first = plan.first_tile[s.grains.block_of(grain)];
            first = std::min(first, tile);
        }
    }
    // a tile without contacts ends where the one before does
    for (int tile = 0; tile < tiles; ++tile)
        plan.tile_contacts[tile + 1] =
            std::max(plan.tile_contacts[tile + 1], plan.tile_contacts[tile]);
}

/// When grains move: before the first tile that has a contact of theirs.
void find_moves(SolidState& s)
{
    SolidPlan& plan = s.plan;
    std::vector<int> counts(plan.tiles(), 0);
    for (int tile : plan.first_tile)
        ++counts[tile];
    plan.tile_moves = ends_of(counts);
    std::vector<int> next = plan.tile_moves;
    plan.moves.resize(plan.first_tile.size());
    for (std::size_t block = 0; block < plan.moves.size(); ++block)
        plan.moves[next[plan.first_tile[block]]++] = static_cast<int>(block);
}

/// Block of contacts by block: room for its parcels, if it has any, and which nodes they are for.
void find_parcels(SolidState& s)
{
    const FaceContacts& c = s.contacts;
    SolidPlan& plan = s.plan;
    std::vector<std::vector<Parcel>> of_grain(s.grains.blocks());
    plan.first_parcel.assign(c.blocks(), -1);
    int values = 0;
    for (int block = 0; block < c.blocks(); ++block) {
        if (!reaches_out(s, c.in_slot[block * lanes])) continue;
        plan.first_parcel[block] = values;
        if (s.is_rigid()) {
            for (int i = 0; i < 2 * lanes; ++i) {
                const int contact = c.in_slot[block * lanes + i % lanes];
                if (contact >= 0) {
                    of_grain[s.grains.block_of(c.pairs[contact][i / lanes])].push_back(
                        { 0, values + i * WrenchRow::count });
                }
            }
            values += 2 * lanes * WrenchRow::count;
            continue;
        }
        const int first = c.block_nodes[block];
        for (int i = first; i < c.block_nodes[block + 1]; ++i) {
            const int offset = i - first, side = offset / lanes % 2;
            const int contact = c.in_slot[block * lanes + offset % lanes];
            if (contact < 0) continue;
            const int grains = s.grains.block_of(c.pairs[contact][side]);
            of_grain[grains].push_back({ c.nodes[i] - s.grains.block_nodes[grains],
                values + offset * s.grains.layout.node_stride });
        }
        values += (c.block_nodes[block + 1] - first) * s.grains.layout.node_stride;
    }
    plan.parcels.assign(values, 0.0);
    plan.block_sums = { 0 };
    plan.sums.clear();
    for (const auto& sums : of_grain) {
        plan.sums.insert(plan.sums.end(), sums.begin(), sums.end());
        plan.block_sums.push_back(static_cast<int>(plan.sums.size()));
    }
}

/// Corner of a contact at the reference.
Vector place_of(const FaceContacts& c, int contact, int corner)
{
    const int row = c.block_nodes[c.block_of(contact)] / 2 * 3 + corner * 3 * lanes;
    const double* x = c.places.data() + row + c.lane_of(contact);
    return { x[0], x[lanes], x[2 * lanes] };
}

/// Places of the points of a contact at the reference.
std::vector<Vector> point_places(const FaceContacts& c, int contact)
{
    std::vector<Vector> places(c.points_of(contact));
    for (std::size_t p = 0; p < places.size(); ++p)
        for (int k = 0; k < c.corners_of(contact); ++k)
            places[p] =
                places[p] + c.share(contact, static_cast<int>(p), k) * place_of(c, contact, k);
    return places;
}

/// Write a vector to a lane of three rows.
void write_vector(double* rows, int row, Vector v)
{
    rows[row * lanes] = v.x;
    rows[(row + 1) * lanes] = v.y;
    rows[(row + 2) * lanes] = v.z;
}

/// Write a contact of rigid grains to its lane of RigidFaceRow and RigidPlaceRow.
void write_rigid_face(const SolidState& s, int contact, double* rows, double* place_rows)
{
    const FaceContacts& c = s.contacts;
    const auto write = [&](int row, Vector v) { write_vector(rows, row, v); };
    std::vector<Vector> places = point_places(c, contact);
    const double sum = contact_area(c, contact);
    Vector middle;
    for (std::size_t p = 0; p < places.size(); ++p)
        middle = middle + (c.area(contact, static_cast<int>(p)) / sum) * places[p];
    Vector xx_yy_zz, yz_xz_xy;
    double radius = 0.0;
    for (std::size_t p = 0; p < places.size(); ++p) {
        const Vector r = places[p] - middle;
        const double area = c.area(contact, static_cast<int>(p));
        xx_yy_zz = xx_yy_zz + area * Vector { r.x * r.x, r.y * r.y, r.z * r.z };
        yz_xz_xy = yz_xz_xy + area * Vector { r.y * r.z, r.x * r.z, r.x * r.y };
        radius = std::max(radius, norm(r));
        write_vector(place_rows, RigidPlaceRow::points + 3 * static_cast<int>(p), r);
    }
    Vector twice_area;
    const Vector first = place_of(c, contact, 0);
    for (int k = 1; k + 1 < c.corners_of(contact); ++k) {
        twice_area = twice_area
            + cross(place_of(c, contact, k) - first, place_of(c, contact, k + 1) - first);
    }
    const auto arm = [&](int side) {
        const int centre = s.grains.centre(c.pairs[contact][side]);
        return middle - space_vector(s.grains.reference, centre);
    };
    write(RigidFaceRow::arm_a, arm(0));
    write(RigidFaceRow::arm_b, arm(1));
    write(RigidFaceRow::area, twice_area);
    rows[RigidFaceRow::sum * lanes] = sum;
    write(RigidFaceRow::second, xx_yy_zz);
    write(RigidFaceRow::second + 3, yz_xz_xy);
    rows[RigidFaceRow::radius * lanes] = radius;
    const int end = c.line[c.block_of(contact) * lanes + c.lane_of(contact)];
    write_vector(place_rows, RigidPlaceRow::line, place_of(c, contact, end) - first);
}

/// Faces of rigid grains as a step reads them.
void find_rigid_faces(SolidState& s)
{
    const FaceContacts& c = s.contacts;
    SolidPlan& plan = s.plan;
    plan.motions.assign(s.grains.blocks() * RigidMotionRow::count, 0.0);
    plan.wrenches.assign(s.grains.blocks() * WrenchRow::count, 0.0);
    plan.body_places.clear();
    for (int block = 0; block < s.grains.blocks(); ++block) {
        const int grain = s.grains.in_slot[block * lanes];
        plan.body_places.push_back({ grain, s.grains.centre(grain) });
    }
    plan.face_grains.resize(static_cast<std::size_t>(2) * lanes * c.blocks());
    plan.faces.assign(SolidPlan::first_face(c.blocks()), 0.0);
    plan.face_places.assign(SolidPlan::first_place(c, c.blocks()), 0.0);
    for (int slot = 0; slot < lanes * c.blocks(); ++slot) {
        const int block = slot / lanes, lane = slot % lanes;
        double* rows = plan.faces.data() + SolidPlan::first_face(block) + lane;
        double* place_rows = plan.face_places.data() + SolidPlan::first_place(c, block) + lane;
        // padded lanes follow the first one, but bear nothing
        const bool padded = c.in_slot[slot] < 0;
        const int contact = c.in_slot[padded ? block * lanes : slot];
        write_rigid_face(s, contact, rows, place_rows);
        for (int row = RigidFaceRow::sum; padded && row < RigidFaceRow::radius; ++row)
            rows[row * lanes] = 0.0;
        for (int side = 0; side < 2; ++side) {
            plan.face_grains[(2 * block + side) * lanes + lane] =
                s.grains.block_of(c.pairs[contact][side]);
        }
    }
}

/// Contacts of plates on each block of grains.
void find_presses(SolidState& s)
{
    std::vector<std::vector<PlateTouch>> of_block(s.grains.blocks());
    for (std::size_t p = 0; p < s.plates.size(); ++p) {
        for (std::size_t i = 0; i < s.plates[p].points.size(); ++i) {
            const int grain = s.surface.grain[s.plates[p].points[i].facet];
            of_block[s.grains.block_of(grain)].push_back(
                { static_cast<int>(p), static_cast<int>(i) });
        }
    }
    s.plan.first_press.clear();
    s.plan.presses.clear();
    if (s.plates.empty()) return;
    for (const auto& touches : of_block) {
        s.plan.first_press.push_back(static_cast<int>(s.plan.presses.size()));
        s.plan.presses.insert(s.plan.presses.end(), touches.begin(), touches.end());
    }
    s.plan.first_press.push_back(static_cast<int>(s.plan.presses.size()));
}

/// Surface triangles of each block of grains, if pressures act on them.
void find_pressed(SolidState& s)
{
    SolidPlan& plan = s.plan;
    plan.first_pressed.clear();
    plan.pressed.clear();
    plan.pressure_works.assign(s.surface.pressure.size(), 0.0);
    if (s.surface.pressure.empty()) return;
    std::vector<std::vector<int>> of_block(s.grains.blocks());
    for (std::size_t t = 0; t < s.surface.pressure.size(); ++t)
        of_block[s.grains.block_of(s.surface.grain[t])].push_back(static_cast<int>(t));
    for (const auto& triangles : of_block) {
        plan.first_pressed.push_back(static_cast<int>(plan.pressed.size()));
        plan.pressed.insert(plan.pressed.end(), triangles.begin(), triangles.end());
    }
    plan.first_pressed.push_back(static_cast<int>(plan.pressed.size()));
}

/// Whether a list has values of a block.
bool has_any(const std::vector<int>& first, int block)
{
    return !first.empty() && first[block] < first[block + 1];
}

void find_node_loads(SolidState& s)
{
    SolidPlan& plan = s.plan;
    plan.node_loads.clear();
    for (int block = 0; block < s.grains.blocks(); ++block)
        plan.node_loads.push_back(
            has_any(plan.first_press, block) || has_any(plan.first_pressed, block));
}

}  // namespace

int tile_of(const SolidState& s, int contact)
{
    const auto [a, b] = s.contacts.pairs[contact];
    return std::min(tile_of_grain(s, a), tile_of_grain(s, b));
}

bool reaches_out(const SolidState& s, int contact)
{
    const auto [a, b] = s.contacts.pairs[contact];
    return tile_of_grain(s, a) != tile_of_grain(s, b);
}

void prepare_step(SolidState& s)
{
    find_tiles(s);
    find_moves(s);
    find_parcels(s);
    find_presses(s);
    find_pressed(s);
    if (!s.is_rigid()) return;
    find_rigid_faces(s);
    find_node_loads(s);
    s.plan.forces_behind = true;  // a saved state has none
}

}  // namespace flexpm
