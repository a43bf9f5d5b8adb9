// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/assembly/serialization.hpp>
#include <flexpm/kernel/assembly/state_check.hpp>
#include <flexpm/kernel/step/step_plan.hpp>

#include "fuzz/bytes.hpp"
#include "fuzz/targets.hpp"
#include "fuzz/use_state.hpp"
#include "support/sample_runs.hpp"

#include <array>
#include <map>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace fuzz {

namespace {

using flexpm::Assembly;

template <class T> struct IsList : std::false_type {
};
template <class T, class A> struct IsList<std::vector<T, A>> : std::true_type {
};

/// Changes one number of a part, or the length of one of its lists.
class Change {
public:
    explicit Change(Bytes& source) : bytes(source) { }

    template <class Part> void operator()(const char* /*name*/, Part& part) { change(part); }

    template <class Part> void change_member(Part& part)
    {
        int members = 0;
        flexpm::visit_members(part, [&](const char*, const auto&) { ++members; });
        const int chosen = bytes.byte() % members;
        int member = 0;
        flexpm::visit_members(part, [&](const char*, auto& value) {
            if (member++ == chosen) change(value);
        });
    }

private:
    void change(bool& value) { value = !value; }
    void change(double& value)
    {
        value = bytes.flag() ? bytes.wild(value) : value * (2.0 * bytes.share() - 1.0);
    }
    void change(std::uint8_t& value) { value = bytes.raw<std::uint8_t>(); }
    void change(flexpm::Plane& value) { value = static_cast<flexpm::Plane>(bytes.whole(-1, 2)); }
    void change(flexpm::GrainPair& pair) { change(pair[bytes.byte() % 2]); }
    void change(std::array<double, 3>& values) { change(values[bytes.byte() % 3]); }
    void change(std::map<flexpm::GrainPair, double>& pairs)
    {
        const int first = bytes.whole(-1, 40);
        pairs[{ first, bytes.whole(-1, 40) }] = bytes.wild(1e-3);
    }
    /// By little, or to any value: neighbours and wrong orders, or what is far away.
    template <class Whole> std::enable_if_t<std::is_integral<Whole>::value> change(Whole& value)
    {
        using Unsigned = std::make_unsigned_t<Whole>;  // it may go around
        value = bytes.flag() ? bytes.raw<Whole>()
                             : static_cast<Whole>(static_cast<Unsigned>(value)
                                 + static_cast<Unsigned>(bytes.whole(-40, 40)));
    }
    template <class Part> std::enable_if_t<std::is_class<Part>::value> change(Part& part)
    {
        if constexpr (IsList<Part>::value) {
            const int kind = bytes.byte();
            if (kind < 8)
                part.clear();
            else if (kind < 32)
                part.resize(part.size() + kind % 9);
            else if (kind < 56)
                part.resize(part.size() - std::min<std::size_t>(part.size(), kind % 9));
            else if (!part.empty())
                change(part[bytes.raw<std::uint16_t>() % part.size()]);
        } else {
            change_member(part);
        }
    }

    Bytes& bytes;
};

/// States in which no part is empty: deformable and rigid grains between plates, rigid ones that
/// have come to touch.
const std::vector<Assembly>& saved_states()
{
    static const std::vector<Assembly> states = { sample_runs::squeezed(false),
        sample_runs::squeezed(true), sample_runs::thrown() };
    return states;
}

}  // namespace

void state(const std::uint8_t* data, std::size_t size)
{
    Bytes bytes(data, size);
    const std::vector<Assembly>& states = saved_states();
    Assembly a = same_bits::copy_of_members(states[bytes.byte() % states.size()]);
    for (int i = bytes.byte() % 8; i >= 0; --i)
        Change(bytes).change_member(a);
    try {
        flexpm::check_state(a);
        flexpm::prepare_step(a);
        use_state(a);
    } catch (const std::invalid_argument&) {
    } catch (const std::runtime_error&) {
    }
}

}  // namespace fuzz
