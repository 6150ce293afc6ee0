// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>
#include <csignal>
#include <functional>
#include <thread>

namespace akimap::app {

/** While one lives, the first SIGINT (^C), SIGTERM or SIGHUP (its terminal closes) only asks the
 * program to finish; the second ends it as usual. At most one at a time. */
class StopSignal {
 public:
    /** \param before_end called, in a thread of its own, before the second signal ends the program:
     * there destructors don't run */
    explicit StopSignal(std::function<void()> before_end = {});
    ~StopSignal();
    StopSignal(const StopSignal&) = delete;
    StopSignal& operator=(const StopSignal&) = delete;

    /** Whether it has been asked; cheap, from any thread. */
    [[nodiscard]] static bool requested();

 private:
    std::thread ending_;  // waits for the second signal
    std::array<struct sigaction, 3> old_actions_{};
};

}  // namespace akimap::app
