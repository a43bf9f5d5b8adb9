// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Loss, its derivatives over the labels that share a voxel, and Newton's method.
#include <flexpm/kernel/labels/label_fit.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <string>

namespace flexpm {
namespace {

using Four = Eigen::Vector4d;
using Fours = std::vector<Four>;

/// Share of a voxel below which a label does not take part in the derivatives.
constexpr double least_share = 1e-8;
/// Conjugate gradients end at this part of the gradient, or after so many products.
constexpr double enough = 1e-2;
constexpr int most_products = 80;
/// Relative fall of the loss below which the fit ends.
constexpr double flat = 1e-5;
constexpr int most_halvings = 20;
/// Stiffness of a step over the loss and the part of the voxels that a label has.
constexpr double damping_rate = 1e-3;

double dotted(const Fours& a, const Fours& b)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i].dot(b[i]);
    return sum;
}

void require(bool fits, const std::string& quantity, const std::string& rule)
{
    if (!fits) refuse("fit_labels: " + quantity, "of another size or range", rule);
}

void require_sound(const LabelSamples& s, const LabelScores& start, const LabelFitOptions& options)
{
    const auto labels = static_cast<std::size_t>(start.labels());
    const auto in_range = [&](int label) { return label >= 0 && label < start.labels(); };
    require(start.centres.size() == labels && start.slopes.size() == labels && labels > 0, "start",
        "must be a centre, a slope and a level for each label");
    require(s.labels.size() == s.points.size() && s.weights.size() == s.points.size()
            && !s.points.empty(),
        "samples", "must be a point, a label and a weight for each voxel");
    require(std::all_of(s.labels.begin(), s.labels.end(), in_range), "labels",
        "must be indices of the start");
    require(s.rival_offsets.size() == labels + 1 && s.rival_offsets.front() == 0
            && std::is_sorted(s.rival_offsets.begin(), s.rival_offsets.end())
            && s.rival_offsets.back() == static_cast<int>(s.rivals.size())
            && std::all_of(s.rivals.begin(), s.rivals.end(), in_range),
        "rivals", "must be indices of the start, with offsets that rise");
    for (std::size_t label = 0; label < labels; ++label) {
        const auto first = s.rivals.begin() + s.rival_offsets[label];
        const auto last = s.rivals.begin() + s.rival_offsets[label + 1];
        require(std::find(first, last, static_cast<int>(label)) != last,
            "rivals of label " + std::to_string(label), "must have the label itself");
    }
    check_positive("fit_labels: temperature", options.temperature, "");
    check_positive("fit_labels: size", options.size, "");
    check_positive("fit_labels: tie", options.tie, "");
}

/// The problem in scaled unknowns: a label's four are its slope's times 2 size / T, and level / T.
class LabelFit {
public:
    LabelFit(const LabelSamples& s, const LabelScores& start, const LabelFitOptions& o) :
        samples(s),
        centres(start.centres),
        options(o),
        slope_scale(2.0 * o.size / o.temperature)
    {
        for (double weight : s.weights)
            total += weight;
        parts.assign(start.labels(), 0.0);
        for (std::size_t k = 0; k < s.labels.size(); ++k)
            parts[s.labels[k]] += s.weights[k] / total;
        for (int i = 0; i < start.labels(); ++i) {
            const Vector a = start.slopes[i];
            now.emplace_back(slope_scale * a.x, slope_scale * a.y, slope_scale * a.z,
                start.levels[i] / o.temperature);
            const Vector c = centres[i];
            tied.emplace_back(slope_scale * c.x, slope_scale * c.y, slope_scale * c.z, 0.0);
        }
        // |a - centre|^2 / size^2 in the scaled unknowns, for a mean over the labels
        stiffness =
            2.0 * o.tie / (static_cast<double>(now.size()) * square(o.size) * square(slope_scale));
    }

    LabelScores run()
    {
        double before = linearize();
        for (int step = 0; step < options.steps; ++step) {
            damp(before);
            const Fours way = newton_way();
            const double slope = dotted(gradient, way);
            if (!(slope < 0.0)) break;
            const Fours from = now;
            double part = 1.0, after = before;
            for (int halving = 0; halving < most_halvings; ++halving, part *= 0.5) {
                for (std::size_t i = 0; i < now.size(); ++i)
                    now[i] = from[i] + part * way[i];
                after = loss();
                if (after <= before + 1e-4 * part * slope) break;
            }
            if (!(std::isfinite(after) && after < before)) {
                now = from;
                break;
            }
            const bool is_flat = before - after <= flat * before;
            before = after;
            if (is_flat || step + 1 == options.steps) break;
            linearize();
        }
        LabelScores found { centres, {}, {} };
        for (const Four& four : now) {
            const double scale = 1.0 / slope_scale;
            found.slopes.push_back({ scale * four[0], scale * four[1], scale * four[2] });
            found.levels.push_back(options.temperature * four[3]);
        }
        return found;
    }

private:
    /// Share of a voxel that the softmax gives to a label, and the voxel as seen from the label.
    struct Share {
        int label;
        double share;
        Four features;
    };

    const LabelSamples& samples;
    const std::vector<Vector>& centres;
    LabelFitOptions options;
    double slope_scale, stiffness = 0.0, total = 0.0;
    std::vector<double> parts;  ///< of the voxels' weights that each label has
    std::vector<double> damping;
    Fours now, tied, gradient;
    std::vector<Share> shares;
    std::vector<std::size_t> ends;  ///< of each voxel in `shares`
    std::vector<Eigen::Matrix4d> blocks, inverses;

    static double square(double x) { return x * x; }

    /// @param x  at most 0; below -40 it is not worth its time
    static double exponential(double x) { return x > -40.0 ? std::exp(x) : 0.0; }

    Four features(int label, Vector x) const
    {
        const Vector d = (1.0 / options.size) * (x - centres[label]);
        return { d.x, d.y, d.z, 1.0 };
    }

    double tie_loss() const
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < now.size(); ++i)
            sum += (now[i] - tied[i]).head<3>().squaredNorm();
        return 0.5 * stiffness * sum;
    }

    /// Visit each voxel with its rivals' scores and the sum of their exponentials.
    /// @return  the mean of the loss over the voxels
    template <class Visitor> double visit(Visitor&& visitor) const
    {
        std::vector<double> scores;
        double sum = 0.0;
        for (std::size_t k = 0; k < samples.points.size(); ++k) {
            const int label = samples.labels[k];
            const int first = samples.rival_offsets[label];
            const int rivals = samples.rival_offsets[label + 1] - first;
            scores.resize(rivals);
            double most = -1e300, own = 0.0;
            for (int r = 0; r < rivals; ++r) {
                const int rival = samples.rivals[first + r];
                scores[r] = now[rival].dot(features(rival, samples.points[k]));
                most = std::max(most, scores[r]);
                if (rival == label) own = scores[r];
            }
            double exponentials = 0.0;
            for (double& score : scores)
                exponentials += exponential(score - most);
            sum += samples.weights[k] * (most + std::log(exponentials) - own);
            visitor(k, first, scores, most, exponentials);
        }
        return sum / total;
    }

    double loss() const
    {
        return visit([](auto&&...) {}) + tie_loss();
    }

    /// Shares, gradient and the blocks of the preconditioner at the present unknowns.
    double linearize()
    {
        shares.clear();
        ends.clear();
        gradient.assign(now.size(), Four::Zero());
        blocks.assign(now.size(), Eigen::Matrix4d::Zero());
        const double fit = visit([&](std::size_t k, int first, const std::vector<double>& scores,
                                     double most, double exponentials) {
            const double weight = samples.weights[k] / total;
            for (std::size_t r = 0; r < scores.size(); ++r) {
                const int rival = samples.rivals[first + static_cast<int>(r)];
                const double share = exponential(scores[r] - most) / exponentials;
                const bool is_own = rival == samples.labels[k];
                if (share < least_share && !is_own) continue;
                const Four f = features(rival, samples.points[k]);
                gradient[rival] += weight * (share - (is_own ? 1.0 : 0.0)) * f;
                blocks[rival] += weight * share * (1.0 - share) * f * f.transpose();
                if (share >= least_share) shares.push_back({ rival, share, f });
            }
            ends.push_back(shares.size());
        });
        for (std::size_t i = 0; i < now.size(); ++i) {
            const Four off = stiffness * (now[i] - tied[i]);
            gradient[i].head<3>() += off.head<3>();
        }
        return fit + tie_loss();
    }

    /// Bound the step of labels whose shares are 0 or 1 in all voxels, which have a slope and no
    /// curvature: by a stiffness that falls with the loss, so that the end converges as before.
    void damp(double loss_now)
    {
        damping.clear();
        inverses.clear();
        for (std::size_t i = 0; i < now.size(); ++i) {
            damping.push_back(stiffness + damping_rate * loss_now * parts[i]);
            Eigen::Matrix4d block = blocks[i];
            block.diagonal().array() += damping[i];
            inverses.push_back(block.llt().solve(Eigen::Matrix4d::Identity()));
        }
    }

    Fours product(const Fours& way) const
    {
        Fours result(now.size());
        for (std::size_t i = 0; i < now.size(); ++i) {
            result[i] = damping[i] * way[i];
        }
        std::size_t first = 0;
        for (std::size_t k = 0; k < ends.size(); ++k) {
            const double weight = samples.weights[k] / total;
            double mean = 0.0;
            for (std::size_t n = first; n < ends[k]; ++n)
                mean += shares[n].share * shares[n].features.dot(way[shares[n].label]);
            for (std::size_t n = first; n < ends[k]; ++n) {
                const Share& s = shares[n];
                const double rise = s.features.dot(way[s.label]) - mean;
                result[s.label] += weight * s.share * rise * s.features;
            }
            first = ends[k];
        }
        return result;
    }

    Fours preconditioned(const Fours& residual) const
    {
        Fours result;
        for (std::size_t i = 0; i < residual.size(); ++i)
            result.emplace_back(inverses[i] * residual[i]);
        return result;
    }

    /// Newton's step, by conjugate gradients from 0.
    Fours newton_way() const
    {
        Fours way(now.size(), Four::Zero()), residual;
        for (const Four& g : gradient)
            residual.push_back(-g);
        Fours to = preconditioned(residual), along = to;
        double size = dotted(residual, to);
        const double end = square(enough) * size;
        for (int n = 0; n < most_products && size > end; ++n) {
            const Fours image = product(along);
            const double bend = dotted(along, image);
            if (!(bend > 0.0)) break;
            const double length = size / bend;
            for (std::size_t i = 0; i < way.size(); ++i) {
                way[i] += length * along[i];
                residual[i] -= length * image[i];
            }
            to = preconditioned(residual);
            const double next = dotted(residual, to), factor = next / size;
            for (std::size_t i = 0; i < along.size(); ++i)
                along[i] = to[i] + factor * along[i];
            size = next;
        }
        return way;
    }
};

}  // namespace

LabelScores fit_labels(
    const LabelSamples& samples, const LabelScores& start, const LabelFitOptions& options)
{
    require_sound(samples, start, options);
    return LabelFit(samples, start, options).run();
}

}  // namespace flexpm
