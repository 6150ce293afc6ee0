// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>

namespace akimap {

class SurfacePoints;

/** The number of the next scan. It also counts its writes: every change of a map's cells writes
 * it, so what was derived from the cells knows by writes() that it is stale. */
class ScanIndex {
 public:
    ScanIndex() = default;
    ScanIndex(const ScanIndex& o) : value_(o.value_) {}
    ScanIndex& operator=(const ScanIndex& o) { return *this = o.value_; }
    ScanIndex& operator=(uint64_t value) {
        value_ = value, ++writes_;
        return *this;
    }
    ScanIndex& operator++() { return *this = value_ + 1; }
    operator uint64_t() const { return value_; }
    [[nodiscard]] uint64_t writes() const { return writes_; }

    template <class Archive>
    friend Archive& operator<<(Archive& out, const ScanIndex& s) {
        return out << s.value_;
    }
    template <class Archive>
    friend Archive& operator>>(Archive& in, ScanIndex& s) {
        ++s.writes_;
        return in >> s.value_;
    }

 private:
    uint64_t value_ = 0, writes_ = 0;
};

/** What a map's surface points were made from. */
struct SurfaceSource {
    uint64_t writes = 0;
    double prior_alpha = 0, prior_beta = 0;
    bool operator==(const SurfaceSource& o) const {
        return writes == o.writes && prior_alpha == o.prior_alpha && prior_beta == o.prior_beta;
    }
};

/** Holds a map's surface points, which const calls from any thread make on demand. Not part of a
 * map's state: copies of a map begin without. */
class SurfaceCache {
 public:
    /** Those made from the source, made now by make() unless they are there. */
    template <class Make>
    const SurfacePoints& get(const SurfaceSource& source, Make&& make) {
        const Entry* entry = ready_.load(std::memory_order_acquire);
        if (entry && entry->source == source) return *entry->points;
        const std::lock_guard lock(mutex_);
        if (!entry_ || !(entry_->source == source)) {
            entry_ = std::make_unique<Entry>(Entry{source, make()});
            ready_.store(entry_.get(), std::memory_order_release);
        }
        return *entry_->points;
    }
    /** Frees the memory. Must be alone. */
    void drop() {
        ready_ = nullptr;
        entry_.reset();
    }

 private:
    struct Entry {
        SurfaceSource source;
        std::shared_ptr<const SurfacePoints> points;
    };
    std::mutex mutex_;
    std::unique_ptr<const Entry> entry_;
    std::atomic<const Entry*> ready_{nullptr};
};

}  // namespace akimap
