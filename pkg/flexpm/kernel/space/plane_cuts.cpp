// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Sides of vertices are decided once, and an edge that crosses has one new vertex, so that
/// neighbours cannot disagree.
#include <flexpm/kernel/space/plane_cuts.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace flexpm {
namespace {

/// Share of a section below which a part of it is round-off.
constexpr double nothing = 1e-9;

/// The lower number first, as numbered cells have it.
void order(CellFace& face)
{
    if (face.second < 0 || face.first < face.second) return;
    std::swap(face.first, face.second);
    std::reverse(face.corners.begin(), face.corners.end());
}

Vector least(Vector a, Vector b)
{
    return { std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z) };
}
Vector most(Vector a, Vector b)
{
    return { std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z) };
}

/// Half of the extent of a box along a direction.
double reach(Vector size, Vector n)
{
    return 0.5 * (std::fabs(n.x) * size.x + std::fabs(n.y) * size.y + std::fabs(n.z) * size.z);
}

/// Make a closed line of directed pieces, each (from, to); empty if they do not close to one.
template <class End> std::vector<End> chained(std::vector<std::pair<End, End>> pieces)
{
    std::vector<End> found;
    if (pieces.size() < 3) return found;
    std::sort(pieces.begin(), pieces.end());
    const End start = pieces.front().first;
    End at = start;
    do {
        found.push_back(at);
        const auto next = std::lower_bound(
            pieces.begin(), pieces.end(), at, [](const auto& p, End end) { return p.first < end; });
        if (next == pieces.end() || next->first != at || found.size() > pieces.size()) return {};
        at = next->second;
    } while (at != start);
    if (found.size() != pieces.size()) found.clear();
    return found;
}

}  // namespace

std::vector<HalfSpace> region_between(const std::vector<Vector>& corners, Vector normal)
{
    std::vector<HalfSpace> region;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vector from = corners[k], to = corners[(k + 1) % corners.size()];
        Vector out = cross(to - from, normal);
        out = (1.0 / norm(out)) * out;
        region.push_back({ out, dot(out, from) });
    }
    return region;
}

std::vector<Vector> part_within(std::vector<Vector> polygon, const std::vector<HalfSpace>& region)
{
    for (const HalfSpace& half : region) {
        std::vector<Vector> kept;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Vector from = polygon[k], to = polygon[(k + 1) % polygon.size()];
            const double a = dot(half.normal, from) - half.offset;
            const double b = dot(half.normal, to) - half.offset;
            if (a <= 0.0) kept.push_back(from);
            if ((a <= 0.0) != (b <= 0.0)) kept.push_back(from + (a / (a - b)) * (to - from));
        }
        polygon = std::move(kept);
    }
    return polygon;
}

double six_volumes_below(const std::vector<Vector>& polygon, Vector origin)
{
    double sum = 0.0;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
        sum += triple(polygon[0] - origin, polygon[k] - origin, polygon[k + 1] - origin);
    return sum;
}

double area_of_polygon(const std::vector<Vector>& polygon)
{
    Vector twice;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
        twice = twice + cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
    return 0.5 * norm(twice);
}

CellCutter::CellCutter(CellComplex& complex, const CutLimits& limits) :
    complex_(complex),
    limits_(limits),
    given_(complex.cells),
    faces_of_(complex.cells),
    near_of_cell_(complex.cells, -1)
{
    for (std::size_t f = 0; f < complex.faces.size(); ++f) {
        faces_of_[complex.faces[f].first].push_back(static_cast<int>(f));
        if (complex.faces[f].second >= 0)
            faces_of_[complex.faces[f].second].push_back(static_cast<int>(f));
    }
    for (int cell = 0; cell < complex.cells; ++cell) {
        boxes_.push_back(box_of(cell));
        if (!faces_of_[cell].empty())
            longest_ = std::max(longest_, norm(boxes_[cell].high - boxes_[cell].low));
    }
}

CutAreas CellCutter::cut_by_plane(const PlaneCut& cut)
{
    plane_ = &cut;
    CutAreas areas;
    find_near();
    for (Near& near : near_)
        choose(near, areas);
    for (Near& near : near_) {
        if (near.right < 0) continue;
        near.right = complex_.cells++;
        sources_.push_back(near.cell < given_ ? near.cell : sources_[near.cell - given_]);
    }
    split_faces();
    insert_crossings();
    join_sides(areas);
    add_sections(areas);
    list_faces();
    for (const Near& near : near_)
        near_of_cell_[near.cell] = -1;
    return areas;
}

CellCutter::EdgeKey CellCutter::key(int u, int v)
{
    const int a = std::min(u, v), b = std::max(u, v);
    return (static_cast<EdgeKey>(a) << 32) | static_cast<unsigned>(b);
}

bool CellCutter::is_cut(int cell) const
{
    return cell >= 0 && cell < static_cast<int>(near_of_cell_.size()) && near_of_cell_[cell] >= 0
        && near_[near_of_cell_[cell]].right >= 0;
}

bool CellCutter::is_in_region(Vector p) const
{
    return std::all_of(plane_->region.begin(), plane_->region.end(),
        [&](const HalfSpace& half) { return dot(half.normal, p) < half.offset; });
}

CellCutter::Box CellCutter::box_of(int cell) const
{
    constexpr double far = std::numeric_limits<double>::infinity();
    Box box { { far, far, far }, { -far, -far, -far } };
    for (int f : faces_of_[cell])
        for (int v : complex_.faces[f].corners) {
            box.low = least(box.low, complex_.vertices[v]);
            box.high = most(box.high, complex_.vertices[v]);
        }
    return box;
}

/// Cells that may touch the plane where it is cut, and all around edges that it may cross there:
/// these reach as far as a cell beyond the region.
void CellCutter::find_near()
{
    near_.clear();
    touched_.clear();
    crossings_.clear();
    for (int cell = 0; cell < complex_.cells; ++cell) {
        if (faces_of_[cell].empty()) continue;
        const Box& box = boxes_[cell];
        const Vector middle = 0.5 * (box.low + box.high), size = box.high - box.low;
        const double off = std::fabs(dot(plane_->normal, middle) - plane_->offset);
        if (off > reach(size, plane_->normal) + limits_.close) continue;
        const bool meets =
            std::all_of(plane_->region.begin(), plane_->region.end(), [&](const HalfSpace& half) {
                return dot(half.normal, middle) - half.offset
                    <= reach(size, half.normal) + longest_;
            });
        if (!meets) continue;
        near_of_cell_[cell] = static_cast<int>(near_.size());
        near_.push_back({ cell });
        touched_.insert(touched_.end(), faces_of_[cell].begin(), faces_of_[cell].end());
    }
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    beyond_.resize(complex_.vertices.size());
    for (int f : touched_)
        for (int v : complex_.faces[f].corners)
            beyond_[v] = dot(plane_->normal, complex_.vertices[v]) - plane_->offset;
}

Vector CellCutter::place_of(EdgeKey edge) const
{
    const int a = static_cast<int>(edge >> 32), b = static_cast<int>(edge & 0xffffffffU);
    const double share = std::clamp(beyond_[a] / (beyond_[a] - beyond_[b]), 0.0, 1.0);
    const Vector& from = complex_.vertices[a];
    const Vector p = from + share * (complex_.vertices[b] - from);
    return p + (plane_->offset - dot(plane_->normal, p)) * plane_->normal;
}

int CellCutter::crossing(EdgeKey edge)
{
    const auto [at, added] =
        crossings_.try_emplace(edge, static_cast<int>(complex_.vertices.size()));
    if (!added) return at->second;
    const int a = static_cast<int>(edge >> 32), b = static_cast<int>(edge & 0xffffffffU);
    for (int end : { a, b })  // such an end and the new vertex become one
        if (std::fabs(beyond_[end]) <= limits_.close) put_on_plane(end);
    complex_.vertices.push_back(place_of(edge));
    std::vector<int> common;
    std::set_intersection(complex_.walls[a].begin(), complex_.walls[a].end(),
        complex_.walls[b].begin(), complex_.walls[b].end(), std::back_inserter(common));
    complex_.walls.push_back(std::move(common));
    put_on_plane(static_cast<int>(complex_.walls.size()) - 1);
    beyond_.push_back(0.0);
    return at->second;
}

/// Note that a vertex lies on the plane.
void CellCutter::put_on_plane(int vertex)
{
    auto& walls = complex_.walls[vertex];
    const auto at = std::lower_bound(walls.begin(), walls.end(), plane_->wall);
    if (at == walls.end() || *at != plane_->wall) walls.insert(at, plane_->wall);
}

/// Part of a polygon on one side.
std::vector<Vector> CellCutter::clipped(const std::vector<int>& corners, bool right) const
{
    std::vector<Vector> part;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const int u = corners[k], v = corners[(k + 1) % corners.size()];
        if (is_right(u) == right) part.push_back(complex_.vertices[u]);
        if (is_right(u) != is_right(v)) part.push_back(place_of(key(u, v)));
    }
    return part;
}

/// Find the section of a cell; false if round-off leaves none that is closed.
bool CellCutter::has_section(Near& near) const
{
    std::vector<std::pair<EdgeKey, EdgeKey>> rim;
    for (int f : faces_of_[near.cell]) {
        const CellFace& face = complex_.faces[f];
        EdgeKey enter = 0, leave = 0;
        int found = 0;
        for (std::size_t k = 0; k < face.corners.size(); ++k) {
            const int u = face.corners[k], v = face.corners[(k + 1) % face.corners.size()];
            if (is_right(u) == is_right(v)) continue;
            (is_right(u) ? enter : leave) = key(u, v);
            ++found;
        }
        if (found == 0) continue;
        if (found != 2) return false;
        if (face.first == near.cell)
            rim.emplace_back(enter, leave);
        else
            rim.emplace_back(leave, enter);
    }
    near.section = chained(std::move(rim));
    return !near.section.empty();
}

/// Whether the plane leaves a sharp edge of the left or right piece, between itself and a face that
/// it cuts.
bool CellCutter::is_sharp(const Near& near, bool right) const
{
    for (int f : faces_of_[near.cell]) {
        const auto& corners = complex_.faces[f].corners;
        const auto rights =
            std::count_if(corners.begin(), corners.end(), [&](int v) { return is_right(v); });
        if (rights == 0 || rights == static_cast<std::ptrdiff_t>(corners.size())) continue;
        const Vector area = area_vector(complex_, corners);
        const double sign = (complex_.faces[f].first == near.cell) == right ? 1.0 : -1.0;
        if (sign * dot(area, plane_->normal) > limits_.largest_cosine * norm(area)) return true;
    }
    return false;
}

bool CellCutter::is_large(double depth, double volume) const
{
    return depth >= limits_.least_depth && volume >= limits_.least_volume;
}

/// Whether the left piece of a cell leaves with a hole.
bool CellCutter::is_left_in_hole(const Near& near) const
{
    if (plane_->hole.empty()) return false;
    const auto is_inside = [&](Vector p) {
        return std::all_of(plane_->hole.begin(), plane_->hole.end(), [&](const HalfSpace& half) {
            return dot(half.normal, p) - half.offset <= limits_.close;
        });
    };
    for (int f : faces_of_[near.cell]) {
        const auto part = clipped(complex_.faces[f].corners, false);
        if (!std::all_of(part.begin(), part.end(), is_inside)) return false;
    }
    return true;
}

/// Decide what becomes of a cell.
void CellCutter::choose(Near& near, CutAreas& areas)
{
    double left_depth = 0.0, right_depth = 0.0, left = 0.0, right = 0.0;
    for (int f : faces_of_[near.cell])
        for (int v : complex_.faces[f].corners) {
            double& depth = is_right(v) ? right_depth : left_depth;
            depth = std::max(depth, std::fabs(beyond_[v]));
        }
    if (!(left_depth > limits_.close && right_depth > limits_.close)) {
        near.side = right_depth > left_depth ? 1 : -1;
        return;
    }
    const bool closed = has_section(near);
    std::vector<Vector> section;
    for (EdgeKey edge : near.section)
        section.push_back(place_of(edge));
    const double all = area_of_polygon(section);
    const double part = area_of_polygon(part_within(section, plane_->region));
    const Box& box = boxes_[near.cell];
    const bool is_within = closed
        ? all > 0.0 && part >= (plane_->hole.empty() ? 0.5 : nothing) * all
        : is_in_region(0.5 * (box.low + box.high));
    if (!is_within) {
        if (closed) areas.bridged += part;
        return;
    }
    near.passed = true;
    const Vector origin = closed
        ? section.front()
        : complex_.vertices[complex_.faces[faces_of_[near.cell].front()].corners.front()];
    for (int f : faces_of_[near.cell]) {
        const double sign = complex_.faces[f].second == near.cell ? -1.0 : 1.0;
        const auto& corners = complex_.faces[f].corners;
        left += sign / 6.0 * six_volumes_below(clipped(corners, false), origin);
        right += sign / 6.0 * six_volumes_below(clipped(corners, true), origin);
    }
    const bool left_stays =
        is_large(left_depth, left) && (plane_->open || (closed && !is_sharp(near, false)));
    const bool right_stays =
        is_large(right_depth, right) && (plane_->open || (closed && !is_sharp(near, true)));
    const bool sound = closed && right_stays && (left_stays || is_left_in_hole(near));
    near.side = sound || left >= right ? -1 : 1;
    if (!sound) return;
    near.right = near.cell;  // numbered once all are known
    areas.beyond += all - part;
}

/// Side of a cell, of those far from the region by their vertices.
int CellCutter::side_of(int cell) const
{
    if (cell >= static_cast<int>(near_of_cell_.size())) return 1;  // a right piece
    if (near_of_cell_[cell] >= 0) return near_[near_of_cell_[cell]].side;
    double low = 0.0, high = 0.0;
    for (int f : faces_of_[cell])
        for (int v : complex_.faces[f].corners) {
            const double off = dot(plane_->normal, complex_.vertices[v]) - plane_->offset;
            low = std::min(low, off);
            high = std::max(high, off);
        }
    if (-low > limits_.close && high > limits_.close) return 0;
    return high > -low ? 1 : -1;
}

/// Faces of cells that are cut belong to a piece, or are cut themselves.
void CellCutter::split_faces()
{
    const auto piece_of = [&](int cell) {
        return is_cut(cell) ? near_[near_of_cell_[cell]].right : cell;
    };
    std::vector<CellFace> added;
    for (int f : touched_) {
        CellFace& face = complex_.faces[f];
        if (!is_cut(face.first) && !is_cut(face.second)) continue;
        const auto rights = std::count_if(
            face.corners.begin(), face.corners.end(), [&](int v) { return is_right(v); });
        const bool whole =
            rights == 0 || rights == static_cast<std::ptrdiff_t>(face.corners.size());
        CellFace other { piece_of(face.first), piece_of(face.second), face.wall, {}, face.joint };
        if (whole) {
            if (rights > 0) {
                face.first = other.first;
                face.second = other.second;
            }
            order(face);
            continue;
        }
        std::vector<int> corners;
        for (std::size_t k = 0; k < face.corners.size(); ++k) {
            const int u = face.corners[k], v = face.corners[(k + 1) % face.corners.size()];
            (is_right(u) ? other.corners : corners).push_back(u);
            if (is_right(u) == is_right(v)) continue;
            const int end = crossing(key(u, v));
            corners.push_back(end);
            other.corners.push_back(end);
        }
        face.corners = std::move(corners);
        order(face);
        order(other);
        added.push_back(std::move(other));
    }
    for (CellFace& face : added) {
        touched_.push_back(static_cast<int>(complex_.faces.size()));
        complex_.faces.push_back(std::move(face));
    }
}

/// Edges that are divided have their new vertex in all faces.
void CellCutter::insert_crossings()
{
    for (int f : touched_) {
        CellFace& face = complex_.faces[f];
        std::vector<int> corners;
        for (std::size_t k = 0; k < face.corners.size(); ++k) {
            const int u = face.corners[k], v = face.corners[(k + 1) % face.corners.size()];
            corners.push_back(u);
            const auto found = crossings_.find(key(u, v));
            if (found != crossings_.end()) corners.push_back(found->second);
        }
        face.corners = std::move(corners);
    }
}

/// Add a face of the joint, from left to right, to the areas.
void CellCutter::count(const CellFace& face, double sign, CutAreas& areas)
{
    const Vector area = area_vector(complex_, face.corners);
    const double seen = sign * dot(area, plane_->normal);
    if (face.joint != plane_->joint) {
        areas.taken += seen;
        return;
    }
    areas.cut += seen;
    double bend = 0.0;
    for (int v : face.corners) {
        const double off = std::fabs(beyond_[v]);
        bend = std::max(bend, off);
        // corners of cells that lie on the plane stay there, too, when edges are collapsed
        if (off <= limits_.close) put_on_plane(v);
    }
    areas.bend = std::max(areas.bend, bend);
    if (bend > limits_.close) areas.detour += norm(area);
}

/// Faces between a cell on the left and one on the right become faces of the joint, or flanks.
void CellCutter::join_sides(CutAreas& areas)
{
    std::vector<CellFace> opened;
    std::vector<int> replaced;  // faces that belonged to the cells of the opened ones
    const auto passed = [&](int cell) {
        if (cell >= static_cast<int>(near_of_cell_.size())) return true;
        return near_of_cell_[cell] >= 0 && near_[near_of_cell_[cell]].passed;
    };
    for (int f : touched_) {
        CellFace& face = complex_.faces[f];
        if (face.second < 0) continue;
        const int side = side_of(face.first);
        if (side * side_of(face.second) != -1) continue;
        if (!passed(face.first) && !passed(face.second)) {
            Vector middle;
            for (int v : face.corners)
                middle = middle + complex_.vertices[v];
            if (!is_in_region((1.0 / static_cast<double>(face.corners.size())) * middle)) continue;
        }
        if (!plane_->open) {
            if (face.joint < 0) face.joint = plane_->joint;
            count(face, -side, areas);
            continue;
        }
        CellFace other { face.second, -1, plane_->wall, face.corners };
        std::reverse(other.corners.begin(), other.corners.end());
        opened.push_back(std::move(other));
        replaced.push_back(f);
        face.second = -1;
        face.wall = plane_->wall;
    }
    for (std::size_t k = 0; k < opened.size(); ++k) {
        const int cell = opened[k].first, number = static_cast<int>(complex_.faces.size());
        const bool is_far =
            cell < static_cast<int>(near_of_cell_.size()) && near_of_cell_[cell] < 0;
        if (is_far)
            std::replace(faces_of_[cell].begin(), faces_of_[cell].end(), replaced[k], number);
        touched_.push_back(number);
        complex_.faces.push_back(std::move(opened[k]));
    }
}

/// Section of each cell that is cut, as a face between its pieces or as two flanks.
void CellCutter::add_sections(CutAreas& areas)
{
    for (const Near& near : near_) {
        if (near.right < 0) continue;
        CellFace left { near.cell, -1, plane_->wall, {} };
        for (EdgeKey edge : near.section)
            left.corners.push_back(crossings_.at(edge));
        // from the smallest vertex
        std::rotate(left.corners.begin(),
            std::min_element(left.corners.begin(), left.corners.end()), left.corners.end());
        if (plane_->open) {
            CellFace right { near.right, -1, plane_->wall, left.corners };
            std::reverse(right.corners.begin(), right.corners.end());
            touched_.push_back(static_cast<int>(complex_.faces.size()));
            complex_.faces.push_back(std::move(left));
            touched_.push_back(static_cast<int>(complex_.faces.size()));
            complex_.faces.push_back(std::move(right));
            continue;
        }
        left.second = near.right;
        left.wall = -1;
        left.joint = plane_->joint;
        count(left, 1.0, areas);
        touched_.push_back(static_cast<int>(complex_.faces.size()));
        complex_.faces.push_back(std::move(left));
    }
}

void CellCutter::take_out(const std::vector<int>& cells, int wall)
{
    std::vector<bool> is_gone(complex_.cells);
    for (int cell : cells)
        is_gone[cell] = true;
    for (int cell : cells) {
        for (int f : faces_of_[cell]) {
            CellFace& face = complex_.faces[f];
            if (is_gone[face.first] && (face.second < 0 || is_gone[face.second])) {
                face.corners.clear();
                continue;
            }
            if (is_gone[face.first]) {
                std::swap(face.first, face.second);
                std::reverse(face.corners.begin(), face.corners.end());
            }
            face.second = -1;
            face.wall = wall;
        }
        faces_of_[cell].clear();
    }
}

/// Bring the lists of faces and the boxes of near cells and of pieces up to date.
void CellCutter::list_faces()
{
    const auto before = near_of_cell_.size();
    faces_of_.resize(complex_.cells);
    for (const Near& near : near_)
        faces_of_[near.cell].clear();
    const auto is_near = [&](int cell) {
        return cell >= static_cast<int>(before) || (cell >= 0 && near_of_cell_[cell] >= 0);
    };
    for (int f : touched_) {
        const CellFace& face = complex_.faces[f];
        if (is_near(face.first)) faces_of_[face.first].push_back(f);
        if (is_near(face.second)) faces_of_[face.second].push_back(f);
    }
    near_of_cell_.resize(complex_.cells, -1);
    boxes_.resize(complex_.cells);
    for (const Near& near : near_) {
        if (near.right < 0) continue;
        boxes_[near.cell] = box_of(near.cell);
        boxes_[near.right] = box_of(near.right);
    }
}

}  // namespace flexpm
