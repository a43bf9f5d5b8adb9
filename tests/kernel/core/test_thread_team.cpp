// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Threads that share work: each does its part once, all meet, and a waiting thread leaves
/// its core to others.
#include "support/catch.hpp"

#include <flexpm/kernel/core/thread_team.hpp>

#include <chrono>
#include <ctime>
#include <vector>

using flexpm::ThreadTeam;

namespace {

/// Sum over the threads of what each finds, after a meeting, in the place of the next one.
int sum_of_neighbours(ThreadTeam& team)
{
    std::vector<int> written(team.size()), found(team.size());
    team.run([&](int thread) {
        written[thread] = thread + 1;
        team.meet();
        found[thread] = written[(thread + 1) % team.size()];
    });
    int sum = 0;
    for (int value : found)
        sum += value;
    return sum;
}

}  // namespace

TEST_CASE("Each thread of a team does its part once and sees what the others did before they met")
{
    for (int size : { 1, 2, 3, 7 }) {
        ThreadTeam team(size);
        for (int round = 0; round < 300; ++round)
            REQUIRE(sum_of_neighbours(team) == size * (size + 1) / 2);
    }
}

TEST_CASE("A thread that waits long uses no processor time")
{
    ThreadTeam team(2);
    const std::clock_t before = std::clock();  // of all threads
    team.run([](int thread) {
        if (thread == 1) std::this_thread::sleep_for(std::chrono::milliseconds(300));
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    CHECK(double(std::clock() - before) / CLOCKS_PER_SEC < 0.1);
}

TEST_CASE("A team is kept while its size stays")
{
    ThreadTeam& team = flexpm::team_of(2);
    CHECK(&flexpm::team_of(2) == &team);
    CHECK(sum_of_neighbours(team) == 3);
    CHECK(flexpm::team_of(3).size() == 3);
}

TEST_CASE("A team of no thread is refused")
{
    CHECK_THROWS_WITH(ThreadTeam(0), Catch::Contains("threads = 0, must be >= 1"));
}
