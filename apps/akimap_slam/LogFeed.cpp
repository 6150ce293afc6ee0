// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "LogFeed.h"

#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>

#include <iostream>

#include "StopSignal.h"

namespace akimap::app {

using namespace mrpt::obs;
using mrpt::serialization::CSerializable;

LogFeed::LogFeed(const CheckedLog& log, Form form, uint64_t first_object)
    : log_(log), form_(form), first_object_(first_object) {
    findExternalFiles(log.file());
    restart();
}

void LogFeed::restart() {
    reader_ = std::make_unique<ObjectReader>(log_);
    pending_.clear();
    newest_odometry_.reset();
    used_odometry_.reset();
}

CSerializable::Ptr LogFeed::nextObject() {
    while (pending_.empty() && !StopSignal::requested()) {
        CSerializable::Ptr object;
        try {
            object = reader_->next();
        } catch (const CutFile& e) {  // all that is whole has been given
            std::cerr << "akimap: warning: " << e.what() << "\n";
        }
        if (!object) break;
        if (const auto log = std::dynamic_pointer_cast<CRawlog>(object))
            for (std::size_t i = 0; i < log->size(); i++) pending_.push_back(log->getAsGeneric(i));
        else if (reader_->objectsRead() > first_object_)
            pending_.push_back(object);
    }
    if (pending_.empty() || StopSignal::requested()) return nullptr;
    const auto object = pending_.front();
    pending_.pop_front();
    return object;
}

bool LogFeed::next(CActionCollection::Ptr& actions, CSensoryFrame::Ptr& frame,
                   CObservation::Ptr& observation) try {
    actions.reset();
    frame.reset();
    observation.reset();
    while (const auto object = nextObject()) {
        if (const auto some_actions = std::dynamic_pointer_cast<CActionCollection>(object)) {
            actions = some_actions;
        } else if ((frame = std::dynamic_pointer_cast<CSensoryFrame>(object))) {
            if (!actions) continue;  // as MRPT does: some logs begin with a frame
            entries_++;
            return true;
        } else if ((observation = std::dynamic_pointer_cast<CObservation>(object))) {
            if (form_ == Form::pairs && !makePair(actions, frame, observation)) continue;
            entries_++;
            return true;
        }
    }
    restart();
    return false;
} catch (...) {
    failure_ = std::current_exception();
    return false;
}

/** False for odometry, which waits for the next observation. */
bool LogFeed::makePair(CActionCollection::Ptr& actions, CSensoryFrame::Ptr& frame,
                       CObservation::Ptr& observation) {
    if (const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(observation)) {
        newest_odometry_ = odometry->odometry;
        if (!used_odometry_) used_odometry_ = newest_odometry_;
        return false;
    }
    CActionRobotMovement2D movement;
    movement.timestamp = observation->timestamp;
    movement.computeFromOdometry(
        newest_odometry_ ? *newest_odometry_ - *used_odometry_ : mrpt::poses::CPose2D(), {});
    used_odometry_ = newest_odometry_;
    actions = CActionCollection::Create();
    actions->insert(movement);
    frame = CSensoryFrame::Create();
    frame->insert(observation);
    observation.reset();
    return true;
}

void LogFeed::rethrowFailure() const {
    if (failure_) std::rethrow_exception(failure_);
}

void LogFeed::requireSuccess() const {
    rethrowFailure();
    if (entries_ == 0 && !StopSignal::requested())
        throw std::runtime_error(log_.file() +
                                 ": no actions with sensory frames and no observations");
}

}  // namespace akimap::app
