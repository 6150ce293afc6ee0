// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

#include "queries/SurfacePoints.h"

namespace akimap {

/** Holds a map's surface points, which const calls from any thread make on demand. Not part of a
 * map's state: copies of a map begin without. Whoever writes to the map drops them. */
class SurfaceCache {
 public:
    /** Those of the map, made now unless they are there. Valid until drop(): others of the same
     * cells, but of another prior, do not replace those that a reader may hold. */
    const SurfacePoints& get(const MapView& map) {
        const Entry* entry = ready_.load(std::memory_order_acquire);
        if (entry && entry->prior == map.prior) return entry->points;
        const std::lock_guard lock(mutex_);
        if (!newest_ || !(newest_->prior == map.prior)) {
            auto made = std::make_unique<Entry>(map);
            made->older = std::move(newest_);
            newest_ = std::move(made);
            ready_.store(newest_.get(), std::memory_order_release);
        }
        return newest_->points;
    }
    /** Frees the memory. Must be alone. */
    void drop() {
        ready_ = nullptr;
        newest_.reset();
    }

 private:
    struct Entry {
        explicit Entry(const MapView& map) : prior(map.prior), points(map) {}
        Prior prior;
        SurfacePoints points;
        std::unique_ptr<const Entry> older;
    };
    std::mutex mutex_;
    std::unique_ptr<const Entry> newest_;
    std::atomic<const Entry*> ready_{nullptr};
};

}  // namespace akimap
