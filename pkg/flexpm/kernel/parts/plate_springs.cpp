// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/parts/plate_springs.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

/// Determinant over the product of the diagonal that is none: round-off [-].
constexpr double singular = 1e-12;
/// Part of the largest gap that a step must change to be one [-].
constexpr double no_change = 1e-14;

/// Gap of a contact after a motion of the plate.
double gap_at(const SoftContact& c, Vector x) { return c.gap + dot(c.opens, x); }

}  // namespace

std::array<Vector, 2> seat_axes(Vector normal)
{
    const Vector near_z = { 0.0, 0.0, 1.0 }, near_x = { 1.0, 0.0, 0.0 };
    const Vector along = std::fabs(normal.z) > 0.5 ? near_x : near_z;
    const Vector across = along - dot(along, normal) * normal;
    const Vector first = (1.0 / norm(across)) * across;
    return { first, cross(normal, first) };
}

void PlateStiffness::add(double stiffness, Vector opens)
{
    xx_ += stiffness * opens.x * opens.x;
    xy_ += stiffness * opens.x * opens.y;
    xz_ += stiffness * opens.x * opens.z;
    yy_ += stiffness * opens.y * opens.y;
    yz_ += stiffness * opens.y * opens.z;
    zz_ += stiffness * opens.z * opens.z;
}

double PlateStiffness::determinant() const
{
    return xx_ * (yy_ * zz_ - yz_ * yz_) - xy_ * (xy_ * zz_ - yz_ * xz_)
        + xz_ * (xy_ * yz_ - yy_ * xz_);
}

/// Motion of a plate whose contacts leave a turn free, as they lie in a line or it has one alone:
/// only the turn rests against which they are less stiff, once the give has taken its part, or
/// both.
Vector PlateStiffness::with_rest(Vector load) const
{
    const double y = xy_ / xx_, z = xz_ / xx_;
    const double yy = yy_ - y * xy_, zz = zz_ - z * xz_;
    const double none = singular * std::max(yy_, zz_);
    Vector motion;
    if (yy > zz && yy > none) motion.y = (load.y - y * load.x) / yy;
    if (zz >= yy && zz > none) motion.z = (load.z - z * load.x) / zz;
    motion.x = (load.x - xy_ * motion.y - xz_ * motion.z) / xx_;
    return motion;
}

Vector PlateStiffness::moved_by(Vector load) const
{
    PlateStiffness k = *this;
    for (double* own : { &k.xx_, &k.yy_, &k.zz_ })
        if (*own == 0.0) *own = 1.0;  // no spring and so no load there
    const double whole = k.determinant();
    if (!(whole > singular * k.xx_ * k.yy_ * k.zz_)) return k.with_rest(load);
    const double xx = k.yy_ * k.zz_ - k.yz_ * k.yz_, xy = k.xz_ * k.yz_ - k.xy_ * k.zz_,
                 xz = k.xy_ * k.yz_ - k.xz_ * k.yy_, yy = k.xx_ * k.zz_ - k.xz_ * k.xz_,
                 yz = k.xy_ * k.xz_ - k.xx_ * k.yz_, zz = k.xx_ * k.yy_ - k.xy_ * k.xy_;
    return { (xx * load.x + xy * load.y + xz * load.z) / whole,
        (xy * load.x + yy * load.y + yz * load.z) / whole,
        (xz * load.x + yz * load.y + zz * load.z) / whole };
}

bool SoftPlate::bears(const SoftContact& c, Vector x) const { return bonded || gap_at(c, x) < 0.0; }

/// By Newton's method. A full step ends on its piece; one beyond the least energy along it would go
/// to and fro, as contacts that it has left do not bear: it ends there.
Vector SoftPlate::least() const
{
    Vector x;
    std::vector<char> bearing, before;
    const int most = 2 * static_cast<int>(contacts.size()) + 30;
    for (int look = 0; look < most; ++look) {
        bearing.clear();
        const Vector step = newton_step(x, bearing);
        if (bearing == before) break;
        const bool whole = !(slope(x + step, step) > 0.0);
        x = x + (whole ? 1.0 : least_along(x, step)) * step;
        if (whole)
            before = bearing;
        else
            before.clear();
        if (largest_change(step) <= no_change * largest_gap(x)) break;
    }
    return x;
}

Vector SoftPlate::newton_step(Vector x, std::vector<char>& bearing) const
{
    PlateStiffness stiffness;
    stiffness.add_machine(machine);
    Vector missing = { machine * (give_before + x.x), 0.0, 0.0 };
    for (const SoftContact& c : contacts) {
        const bool now = bears(c, x);
        bearing.push_back(now);
        if (!now) continue;
        stiffness.add(c.stiffness, c.opens);
        missing = missing + c.stiffness * gap_at(c, x) * c.opens;
    }
    return stiffness.moved_by(-missing);
}

/// Growth of the energy along a step.
double SoftPlate::slope(Vector x, Vector step) const
{
    double sum = machine * (give_before + x.x) * step.x;
    for (const SoftContact& c : contacts)
        if (bears(c, x)) sum += c.stiffness * gap_at(c, x) * dot(c.opens, step);
    return sum;
}

/// Part of a step after which the energy grows along it.
double SoftPlate::least_along(Vector x, Vector step) const
{
    double low = 0.0, high = 1.0;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        (slope(x + middle * step, step) > 0.0 ? high : low) = middle;
    }
    return low;
}

double SoftPlate::largest_change(Vector step) const
{
    double found = 0.0;
    for (const SoftContact& c : contacts)
        found = std::max(found, std::fabs(dot(c.opens, step)));
    return found;
}

double SoftPlate::largest_gap(Vector x) const
{
    double found = 0.0;
    for (const SoftContact& c : contacts)
        found = std::max(found, std::fabs(gap_at(c, x)));
    return found;
}

}  // namespace flexpm
