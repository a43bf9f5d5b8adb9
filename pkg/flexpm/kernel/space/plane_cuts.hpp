// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Convex cells cut in two along parts of planes: joints, notches and holes of solids.
#pragma once

#include <flexpm/kernel/space/cell_complex.hpp>

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace flexpm {

/// Points p with dot(normal, p) <= offset.
struct HalfSpace {
    Vector normal;
    double offset = 0.0;
};

/// Plane across cells, and the region of it that is cut.
struct PlaneCut {
    Vector normal;  ///< of length 1, from the left to the right side
    double offset = 0.0;
    std::vector<HalfSpace> region = {};  ///< which all hold in the region; empty: the whole plane
    int wall = 0;                        ///< number of the plane among the walls of vertices
    int joint = 0;                       ///< number that the faces between both sides have
    bool open = false;  ///< both sides get flanks on `wall` instead of common faces: a notch
    std::vector<HalfSpace>
        hole = {};  ///< of whose facets the plane has one; the hole is on its left
};

/// Least pieces that a cut leaves.
struct CutLimits {
    double close = 0.0;           ///< vertices no further to the right than this count as left
    double least_depth = 0.0;     ///< of a piece, from the plane
    double least_volume = 0.0;    ///< of a piece
    double largest_cosine = 1.0;  ///< of the angle between a joint and a face of the cell
};

/// Areas of a cut, as seen along its normal.
struct CutAreas {
    double cut = 0.0;      ///< faces that have become faces of the joint
    double taken = 0.0;    ///< faces that are of an earlier joint
    double bridged = 0.0;  ///< of the region, within cells that stay whole across it
    double beyond = 0.0;   ///< sections of cut cells outside of the region
    double detour = 0.0;   ///< true area of the joint's faces off the plane
    double bend = 0.0;     ///< largest distance of a corner of a face of the joint from the plane
};

/// Cuts cells by one plane after the other. Only cells near a plane are looked at.
class CellCutter {
public:
    CellCutter(CellComplex& complex, const CutLimits& limits);

    /// A cell whose section with the plane has at least half of its area in the region is cut in
    /// two. If a piece would be too small or too sharp, or if round-off leaves no closed section,
    /// the cell stays whole on the side of its larger part, and the cut follows faces around the
    /// smaller one. Other cells bridge the plane. Faces between both sides become faces of the
    /// joint, unless they are of an earlier one, or flanks. Pieces are cells for the next plane.
    /// Deviations D99 and D107.
    ///
    /// A facet of a hole cuts a cell if any part of the section is in the region. A left piece may be
    /// below the limits if it is within the hole.
    CutAreas cut_by_plane(const PlaneCut& cut);

    /// Take cells out. Faces that they share with other cells lie on `wall` from now on.
    void take_out(const std::vector<int>& cells, int wall);

    /// Faces of a cell; none of one that was taken out.
    const std::vector<int>& faces_of(int cell) const { return faces_of_[cell]; }
    /// For each cell that has been added, a right piece, the cell of the complex as it was given
    /// that it is a part of.
    const std::vector<int>& sources() const { return sources_; }

private:
    using EdgeKey = std::uint64_t;  ///< the smaller vertex and the larger one

    /// A cell near the plane.
    struct Near {
        int cell = -1;
        int right = -1;                     ///< number of its right piece, -1: it is not cut
        int side = 0;                       ///< -1 left, 1 right, 0: it bridges the plane
        bool passed = false;                ///< at least half of its section is in the region
        std::vector<EdgeKey> section = {};  ///< edges that the plane crosses, around the section
    };
    struct Box {
        Vector low, high;
    };

    CellComplex& complex_;
    CutLimits limits_;
    int given_;                               ///< cells at the beginning
    std::vector<std::vector<int>> faces_of_;  ///< per cell
    std::vector<Box> boxes_;                  ///< per cell
    double longest_ = 0.0;                    ///< diagonal of a box
    std::vector<int> sources_;

    // of the present plane
    const PlaneCut* plane_ = nullptr;
    std::vector<double> beyond_;  ///< per vertex of a near cell, distance to the right of the plane
    std::vector<Near> near_;
    std::vector<int> near_of_cell_;  ///< place in `near_`, -1: none
    std::vector<int> touched_;       ///< faces of near cells, in order
    std::unordered_map<EdgeKey, int> crossings_;

    static EdgeKey key(int u, int v);
    bool is_right(int v) const { return beyond_[v] > limits_.close; }
    bool is_cut(int cell) const;
    bool is_in_region(Vector p) const;
    int side_of(int cell) const;
    Box box_of(int cell) const;
    void find_near();
    void choose(Near& near, CutAreas& areas);
    bool has_section(Near& near) const;
    bool is_sharp(const Near& near, bool right) const;
    bool is_large(double depth, double volume) const;
    bool is_left_in_hole(const Near& near) const;
    Vector place_of(EdgeKey edge) const;
    int crossing(EdgeKey edge);
    void put_on_plane(int vertex);
    std::vector<Vector> clipped(const std::vector<int>& corners, bool right) const;
    void split_faces();
    void insert_crossings();
    void join_sides(CutAreas& areas);
    void add_sections(CutAreas& areas);
    void count(const CellFace& face, double sign, CutAreas& areas);
    void list_faces();
};

/// Region of a plane between the edges of a convex polygon.
/// @param corners  counter-clockwise as seen from the tip of the normal
std::vector<HalfSpace> region_between(const std::vector<Vector>& corners, Vector normal);

/// Part of a convex polygon where all half-spaces hold.
std::vector<Vector> part_within(std::vector<Vector> polygon, const std::vector<HalfSpace>& region);

/// Six times the volume between a convex polygon and an origin on its left side.
double six_volumes_below(const std::vector<Vector>& polygon, Vector origin);

/// Area of a convex polygon.
double area_of_polygon(const std::vector<Vector>& polygon);

}  // namespace flexpm
