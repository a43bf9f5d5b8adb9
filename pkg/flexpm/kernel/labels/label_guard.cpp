// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Raises of single levels, and the scores of the rivals of each voxel.
#include <flexpm/kernel/labels/label_guard.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <string>

namespace flexpm {
namespace {

/// Lead of a label in a voxel, in the square of the smallest side of a voxel: well above the
/// round-off of scores, so that the cells made of them have the voxel.
constexpr double lead = 1e-6;

void require(bool fits, const std::string& quantity, const std::string& rule)
{
    if (!fits) refuse("raise_levels: " + quantity, "of another size or range", rule);
}

void require_sound(
    const LabelledGrid& voxels, const LabelScores& start, const std::vector<int>& least)
{
    const auto labels = static_cast<std::size_t>(start.labels());
    const auto in_range = [&](int label) { return label >= 0 && label < start.labels(); };
    std::size_t size = 1;
    for (int count : voxels.grid.counts) {
        require(count > 0, "counts", "must be 1 or more along each axis");
        size *= static_cast<std::size_t>(count);
    }
    require(voxels.labels.size() == size
            && std::all_of(voxels.labels.begin(), voxels.labels.end(), in_range),
        "labels", "must be an index of the start for each voxel");
    require(
        start.centres.size() == labels && start.slopes.size() == labels && least.size() == labels,
        "start", "must be a centre, a slope, a level and a number of voxels for each label");
    require(voxels.rival_offsets.size() == labels + 1 && voxels.rival_offsets.front() == 0
            && std::is_sorted(voxels.rival_offsets.begin(), voxels.rival_offsets.end())
            && voxels.rival_offsets.back() == static_cast<int>(voxels.rivals.size())
            && std::all_of(voxels.rivals.begin(), voxels.rivals.end(), in_range),
        "rivals", "must be indices of the start, with offsets that rise");
}

class LevelRaise {
public:
    LevelRaise(const LabelledGrid& v, const LabelScores& start, const std::vector<int>& l) :
        voxels(v),
        scores(start),
        least(l),
        gap(lead * std::pow(std::min({ v.grid.size.x, v.grid.size.y, v.grid.size.z }), 2))
    {
        sort_by_label();
        highest.assign(voxels.labels.size(), -1e300);
        for (int label = 0; label < scores.labels(); ++label)
            for (int rival : rivals_of(label))
                if (is_rival(rival, label)) meet(rival, label);
    }

    RaisedLevels run(int most)
    {
        std::deque<int> queue;
        std::vector<char> is_queued(scores.labels(), 1);
        for (int label = 0; label < scores.labels(); ++label)
            queue.push_back(label);
        std::int64_t left = static_cast<std::int64_t>(most) * scores.labels();
        while (!queue.empty()) {
            const int label = queue.front();
            queue.pop_front();
            is_queued[label] = 0;
            const double rise = missing(label);
            if (rise <= 0.0) continue;
            if (left-- == 0) return { scores.levels, false };
            scores.levels[label] += rise;
            for (int other : rivals_of(label))
                if (is_rival(label, other) && meet(label, other) && !is_queued[other]) {
                    is_queued[other] = 1;
                    queue.push_back(other);
                }
        }
        return { scores.levels, true };
    }

private:
    struct Range {
        const int* first;
        const int* last;
        const int* begin() const { return first; }
        const int* end() const { return last; }
    };

    const LabelledGrid& voxels;
    LabelScores scores;
    const std::vector<int>& least;
    double gap;
    std::vector<int> order;            ///< voxels by their labels
    std::vector<std::size_t> offsets;  ///< of each label in `order`, and the end
    std::vector<double> highest;       ///< score of the rivals of each entry of `order`
    std::vector<double> lacks;

    Range rivals_of(int label) const
    {
        const int* first = voxels.rivals.data();
        return { first + voxels.rival_offsets[label], first + voxels.rival_offsets[label + 1] };
    }

    bool is_shared(int label) const { return label >= voxels.separate; }

    bool is_rival(int rival, int label) const
    {
        return rival != label && !(is_shared(rival) && is_shared(label));
    }

    void sort_by_label()
    {
        offsets.assign(scores.labels() + 1, 0);
        for (int label : voxels.labels)
            ++offsets[label + 1];
        for (std::size_t i = 1; i < offsets.size(); ++i)
            offsets[i] += offsets[i - 1];
        std::vector<std::size_t> next(offsets.begin(), offsets.end() - 1);
        order.resize(voxels.labels.size());
        for (std::size_t v = 0; v < voxels.labels.size(); ++v)
            order[next[voxels.labels[v]]++] = static_cast<int>(v);
    }

    double score(int label, int voxel) const
    {
        const VoxelGrid& g = voxels.grid;
        const int row = voxel / g.counts[0];
        const int i = voxel % g.counts[0], j = row % g.counts[1], k = row / g.counts[1];
        return scores.at(label,
            g.corner + Vector { (i + 0.5) * g.size.x, (j + 0.5) * g.size.y, (k + 0.5) * g.size.z });
    }

    /// Let a rival compete for the voxels of a label.
    /// @return  whether its score is the highest one of the rivals in a voxel
    bool meet(int rival, int label)
    {
        bool is_highest = false;
        for (std::size_t n = offsets[label]; n < offsets[label + 1]; ++n) {
            const double here = score(rival, order[n]);
            if (here <= highest[n]) continue;
            highest[n] = here;
            is_highest = true;
        }
        return is_highest;
    }

    /// Score of a label, or of the best label that shares its voxels.
    double own_score(int label, int voxel) const
    {
        double best = score(label, voxel);
        if (is_shared(label))
            for (int other : rivals_of(label))
                if (is_shared(other)) best = std::max(best, score(other, voxel));
        return best;
    }

    /// Rise of a label's level with which it has enough voxels; 0: it has them.
    double missing(int label)
    {
        lacks.clear();
        std::size_t won = 0;
        for (std::size_t n = offsets[label]; n < offsets[label + 1]; ++n) {
            if (own_score(label, order[n]) - highest[n] >= 0.5 * gap)
                ++won;
            else
                lacks.push_back(highest[n] - score(label, order[n]) + gap);
        }
        const auto wanted = static_cast<std::size_t>(std::max(least[label], 0));
        if (won >= wanted || lacks.empty()) return 0.0;
        const auto last =
            lacks.begin() + static_cast<std::ptrdiff_t>(std::min(wanted - won, lacks.size()) - 1);
        std::nth_element(lacks.begin(), last, lacks.end());
        return *last;
    }
};

}  // namespace

RaisedLevels raise_levels(
    const LabelledGrid& voxels, const LabelScores& start, const std::vector<int>& least, int most)
{
    require_sound(voxels, start, least);
    return LevelRaise(voxels, start, least).run(most);
}

}  // namespace flexpm
