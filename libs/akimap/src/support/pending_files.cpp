// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "support/pending_files.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <new>

namespace akimap {
namespace {

/** A place for one path. Places are linked once and never freed, so that a signal handler may walk
 * them at any time; a path belongs to whoever exchanges it for null. */
struct Place {
    std::atomic<char*> path{nullptr};
    Place* next = nullptr;
};
std::atomic<Place*> first{nullptr};
static_assert(std::atomic<char*>::is_always_lock_free);

bool takePlace(Place& place, char* path) {
    char* none = nullptr;
    return place.path.compare_exchange_strong(none, path);
}

}  // namespace

void* rememberPendingFile(const std::string& path) {
    char* const copy = strdup(path.c_str());
    if (!copy) throw std::bad_alloc();
    for (Place* place = first; place; place = place->next)
        if (takePlace(*place, copy)) return place;
    auto* const place = new Place;
    place->path = copy;
    place->next = first;
    while (!first.compare_exchange_weak(place->next, place)) {
    }
    return place;
}

void forgetPendingFile(void* registration) {
    std::free(static_cast<Place*>(registration)->path.exchange(nullptr));
}

void removePendingFiles() noexcept {
    const int error = errno;
    for (Place* place = first; place; place = place->next)
        if (const char* path = place->path.exchange(nullptr)) unlink(path);  // can't be freed here
    errno = error;
}

void endBySignal(int signal) noexcept {
    removePendingFiles();
    struct sigaction usual {};
    usual.sa_handler = SIG_DFL;
    sigaction(signal, &usual, nullptr);
    raise(signal);  // takes effect when the handler returns
}

void removePendingFilesOnSignals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction action {};
        sigaction(signal, nullptr, &action);
        if (action.sa_handler != SIG_DFL) continue;
        action = {};
        action.sa_handler = endBySignal;
        sigaction(signal, &action, nullptr);
    }
}

}  // namespace akimap
