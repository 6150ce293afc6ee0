// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cstdint>
#include <limits>

namespace akimap::app {

/** Which scans a robot's mapper would get, by a virtual clock: its update with a scan starts at the
 * scan's stamp, and a scan whose stamp lies before the end of an update is lost. No scan waits.
 *
 * Stamps that go back are not put in order: such a scan is lost too if it lies before that end, and
 * counted apart if it lies before the last used scan. */
class RealtimeGate {
 public:
    /** Whether the mapper gets the scan of that stamp [s]. If so, say how long its update took
     * with used() before the next is offered. */
    [[nodiscard]] bool offer(double stamp) {
        offered_++;
        if (stamp < idle_from_) {
            lost_++;
            lost_out_of_order_ += stamp < start_;
            return false;
        }
        start_ = idle_from_ = stamp;
        return true;
    }
    /** \param update_seconds what the update with the scan just offered took */
    void used(double update_seconds) { idle_from_ = start_ + update_seconds; }

    [[nodiscard]] uint64_t offered() const { return offered_; }
    [[nodiscard]] uint64_t used() const { return offered_ - lost_; }
    [[nodiscard]] uint64_t lost() const { return lost_; }
    /** Those of the lost whose stamp lies before that of the last used scan. */
    [[nodiscard]] uint64_t lostOutOfOrder() const { return lost_out_of_order_; }

 private:
    static constexpr double kNever = -std::numeric_limits<double>::infinity();
    double start_ = kNever, idle_from_ = kNever;  // [s] of the last update
    uint64_t offered_ = 0, lost_ = 0, lost_out_of_order_ = 0;
};

}  // namespace akimap::app
