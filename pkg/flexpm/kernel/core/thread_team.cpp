// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/core/thread_team.hpp>

#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/require.hpp>

#include <memory>
#include <system_error>

#include <unistd.h>

namespace flexpm {

namespace {

/// Looks before a waiting thread sleeps, about 0.1 ms: longer than YADE's other engines take
/// between two steps.
constexpr int looks = 2000;

}  // namespace

ThreadTeam::ThreadTeam(int size) : members(size)
{
    if (size < 1) refuse("threads", size, "", "must be >= 1; give a larger number");
    try {
        for (int thread = 1; thread < size; ++thread)
            threads.emplace_back(&ThreadTeam::serve, this, thread);
    } catch (const std::system_error&) {
        members = static_cast<int>(threads.size()) + 1;
        end();
        refuse("threads", size, "", "are more than the system has left; use fewer");
    }
}

ThreadTeam::~ThreadTeam() { end(); }

void ThreadTeam::end()
{
    work = nullptr;
    meet();
    for (std::thread& thread : threads)
        thread.join();
}

void ThreadTeam::run(const Work& shared)
{
    work = &shared;
    meet();
    shared(0);
    meet();
}

void ThreadTeam::serve(int thread)
{
    for (meet(); work; meet()) {
        (*work)(thread);
        meet();
    }
}

void ThreadTeam::meet()
{
    if (members == 1) return;
    const unsigned present = meeting;
    if (++arrived == members) {
        arrived = 0;
        {
            const std::lock_guard<std::mutex> lock(mutex);
            ++meeting;
        }
        met.notify_all();
        return;
    }
    for (int i = 0; i < looks; ++i) {
        if (meeting != present) return;
        FLEXPM_PAUSE();
    }
    std::unique_lock<std::mutex> lock(mutex);
    met.wait(lock, [this, present] { return meeting != present; });
}

ThreadTeam& team_of(int size)
{
    thread_local std::unique_ptr<ThreadTeam> team;
    thread_local pid_t process = 0;
    if (process != getpid()) {
        // the threads of the parent cannot be joined here
        static_cast<void>(team.release());
        process = getpid();
    }
    if (!team || team->size() != size) {
        team.reset();
        team = std::make_unique<ThreadTeam>(size);
    }
    return *team;
}

}  // namespace flexpm
