// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

// Takes the place of oneTBB's header in builds under ThreadSanitizer, and only there. The system's
// libtbb is not instrumented: ThreadSanitizer does not see that it hands a loop to its threads and
// waits for them, and would report every loop. A suppression would hide the races between the
// loops' bodies with those reports. Here threads are started and joined, which it understands.

#include <tbb/blocked_range.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <thread>
#include <vector>

namespace tbb {
namespace akimap_tsan {

/** Runs task(0) to task(n - 1) on as many threads as the arena allows, in turns, so that any two of
 * them that follow each other are on two threads; throws one of what they throw. */
template <class Task>
void run(std::size_t n, const Task& task) {
    const auto allowed = static_cast<std::size_t>(this_task_arena::max_concurrency());
    std::vector<std::exception_ptr> thrown(std::min(n, allowed));
    const auto work = [&](std::size_t thread) {
        try {
            for (std::size_t i = thread; i < n; i += thrown.size()) task(i);
        } catch (...) {
            thrown[thread] = std::current_exception();
        }
    };
    std::vector<std::thread> threads;
    for (std::size_t t = 1; t < thrown.size(); t++) threads.emplace_back(work, t);
    if (n > 0) work(0);
    for (std::thread& t : threads) t.join();
    for (const std::exception_ptr& error : thrown)
        if (error) std::rethrow_exception(error);
}

template <class Range>
void divide(Range range, std::vector<Range>& parts) {
    while (range.is_divisible()) {
        Range half(range, split());
        divide(half, parts);
    }
    parts.push_back(range);
}

}  // namespace akimap_tsan

template <class Range, class Body>
void parallel_for(const Range& range, const Body& body) {
    if (range.empty()) return;
    std::vector<Range> parts;
    akimap_tsan::divide(range, parts);
    akimap_tsan::run(parts.size(), [&](std::size_t i) { body(parts[i]); });
}

template <class Index, class Function>
void parallel_for(Index first, Index last, const Function& function) {
    parallel_for(blocked_range<Index>(first, last), [&](const blocked_range<Index>& r) {
        for (Index i = r.begin(); i != r.end(); ++i) function(i);
    });
}

}  // namespace tbb
