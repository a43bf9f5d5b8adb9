// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Threads that share one piece of work and wait for each other without keeping a core that
/// others need.
///
/// A step takes a few tenths of a millisecond and its threads meet several times in it, so a thread
/// that waits looks again and again for a while: to sleep and to be woken takes longer than most
/// waits. The while is bounded: where other programs use the cores, the thread waited for may have
/// none, and gets one when the waiting thread sleeps.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace flexpm {

class ThreadTeam {
public:
    /// Work of one thread, given its number; it must not throw.
    using Work = std::function<void(int thread)>;

    /// @param size  threads, the caller of run() being one of them
    /// @throws std::invalid_argument  if size < 1 or the system has no more threads
    explicit ThreadTeam(int size);
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    int size() const { return members; }

    /// Let each thread do its part of the work, and return when all have done it. The caller is
    /// thread 0.
    void run(const Work& work);

    /// Wait within run() until all threads have come here.
    void meet();

private:
    void serve(int thread);
    void end();

    std::atomic<int> members;
    std::atomic<int> arrived { 0 };
    std::atomic<unsigned> meeting { 0 };
    std::mutex mutex;
    std::condition_variable met;
    const Work* work = nullptr;  ///< of the threads at the next meeting; none ends them
    std::vector<std::thread> threads;
};

/// The team of the calling thread, made at the first call and made again for another size. A
/// process that was forked makes its own, since it has no thread but the one that forked it.
ThreadTeam& team_of(int size);

}  // namespace flexpm
