// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "StopSignal.h"

#include <semaphore.h>

#include <atomic>
#include <utility>

#include "support/pending_files.h"

namespace akimap::app {

namespace {

constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};

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
    endBySignal(second_signal);
}

}  // namespace

StopSignal::StopSignal(std::function<void()> before_end) {
    is_requested = false;
    second_signal = 0;
    sem_init(&wake, 0, 0);
    ending_ = std::thread([before_end = std::move(before_end)] { endAtSecondSignal(before_end); });
    struct sigaction action {};
    action.sa_handler = handle;
    for (std::size_t i = 0; i < kSignals.size(); i++) {
        sigaction(kSignals[i], nullptr, &old_actions_[i]);
        // Ignored as in a script's background jobs: kill -INT is how to end those. But nohup is
        // meant so.
        const bool is_nohup = kSignals[i] == SIGHUP && old_actions_[i].sa_handler == SIG_IGN;
        if (!is_nohup) sigaction(kSignals[i], &action, nullptr);
    }
}

StopSignal::~StopSignal() {
    for (std::size_t i = 0; i < kSignals.size(); i++)
        sigaction(kSignals[i], &old_actions_[i], nullptr);
    sem_post(&wake);
    ending_.join();
    sem_destroy(&wake);
}

bool StopSignal::requested() {
    return is_requested;
}

}  // namespace akimap::app
