// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "StopSignal.h"

#include <atomic>

#include "support/pending_files.h"

namespace akimap::app {

namespace {

// All that a signal handler may touch.
std::atomic<bool> is_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

StopSignal::StopSignal() {
    is_requested = false;
    struct sigaction action {};
    action.sa_handler = [](int signal) {
        if (is_requested.exchange(true)) endBySignal(signal);
    };
    // Even where it is ignored, as in a script's background jobs: kill -INT is how to end those.
    sigaction(SIGINT, &action, &old_interrupt_);
    sigaction(SIGTERM, &action, &old_terminate_);
}

StopSignal::~StopSignal() {
    sigaction(SIGINT, &old_interrupt_, nullptr);
    sigaction(SIGTERM, &old_terminate_, nullptr);
}

bool StopSignal::requested() {
    return is_requested;
}

}  // namespace akimap::app
