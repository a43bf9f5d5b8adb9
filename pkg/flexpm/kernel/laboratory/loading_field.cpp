// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/loading_field.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/laboratory/steady_motion.hpp>

namespace flexpm {

Array<double> loading_field(const Assembly& a)
{
    const Grains& grains = a.grains;
    Array<double> field = velocity_of_loading(a);
    const Array<double>& spins = spin_of_loading(a);
    for (int g = 0; g < grains.count; ++g) {
        if (!grains.is_rigid(g)) {
            for_each_component(grains, g, [&](int i) {
                if (grains.prescribed[i]) field[i] = grains.velocity[i];
            });
            continue;
        }
        const int c = grains.centre(g);
        const Point middle = grains.position(c), velocity = vector_at(field, c);
        const double spin = spins[grains.slot[g]];
        for (int k = 0; k < grains.nodes_of(g); ++k) {
            const int n = grains.node(g, k);
            const Point arm = grains.position(n) - middle;
            set_vector(field, n, velocity + spin * Point { -arm.y, arm.x });
        }
    }
    return field;
}

}  // namespace flexpm
