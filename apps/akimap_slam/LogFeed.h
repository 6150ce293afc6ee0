// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose2D.h>

#include <deque>
#include <exception>
#include <memory>
#include <optional>
#include <string>

#include "input/ObjectReader.h"

namespace akimap::app {

/** Gives MRPT's applications the entries of a rawlog, and unlike their own reader tells a damaged
 * log from a finished one. A stop signal ends the log. */
class LogFeed {
 public:
    enum class Form {
        as_recorded,
        pairs  ///< bare observations become frames of one, behind an action made of the odometry
    };

    /** \exception std::runtime_error naming the file */
    LogFeed(const CheckedLog& log, Form form, uint64_t first_object);

    /** False at the end, from where it starts over: pf-localization runs through a log for each
     * of its particle counts. Never throws, as it is called in threads of MRPT's. */
    bool next(mrpt::obs::CActionCollection::Ptr& actions, mrpt::obs::CSensoryFrame::Ptr& frame,
              mrpt::obs::CObservation::Ptr& observation);

    /** Rethrows what went wrong in next(), if anything. */
    void rethrowFailure() const;
    /** The same, and says if nothing in the log could be given. */
    void requireSuccess() const;

 private:
    void restart();
    mrpt::serialization::CSerializable::Ptr nextObject();
    bool makePair(mrpt::obs::CActionCollection::Ptr& actions, mrpt::obs::CSensoryFrame::Ptr& frame,
                  mrpt::obs::CObservation::Ptr& observation);

    CheckedLog log_;
    Form form_;
    uint64_t first_object_, entries_ = 0;
    std::unique_ptr<ObjectReader> reader_;
    std::deque<mrpt::serialization::CSerializable::Ptr> pending_;  // of a CRawlog in one piece
    std::optional<mrpt::poses::CPose2D> newest_odometry_, used_odometry_;
    std::exception_ptr failure_;
};

}  // namespace akimap::app
