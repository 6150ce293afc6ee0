// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "StopSignal.h"

#include <semaphore.h>

#include <atomic>
#include <utility>

namespace akimap::app {

namespace {

// All that a signal handler may touch.
std::atomic<bool> is_requested{false};
std::atomic<int> second_signal{0};
sem_t wake;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void handle(int signal) {
    if (!is_requested.exchange(true)) return;
    second_signal = signal;
    sem_post(&wake);
}

/** Returns only if it is woken without a second signal. */
void endAtSecondSignal(const std::function<void()>& before_end) {
    while (sem_wait(&wake) != 0) {  // interrupted
    }
    if (second_signal == 0) return;
    if (before_end) before_end();
    std::signal(second_signal, SIG_DFL);
    std::raise(second_signal);
}

}  // namespace

StopSignal::StopSignal(std::function<void()> before_end) {
    is_requested = false;
    second_signal = 0;
    sem_init(&wake, 0, 0);
    ending_ = std::thread([before_end = std::move(before_end)] { endAtSecondSignal(before_end); });
    struct sigaction action {};
    action.sa_handler = handle;
    // Even where it is ignored, as in a script's background jobs: kill -INT is how to end those.
    sigaction(SIGINT, &action, &old_interrupt_);
    sigaction(SIGTERM, &action, &old_terminate_);
}

StopSignal::~StopSignal() {
    sigaction(SIGINT, &old_interrupt_, nullptr);
    sigaction(SIGTERM, &old_terminate_, nullptr);
    sem_post(&wake);
    ending_.join();
    sem_destroy(&wake);
}

bool StopSignal::requested() {
    return is_requested;
}

}  // namespace akimap::app
