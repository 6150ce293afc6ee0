// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/RawlogReader.h"

#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>

namespace akimap::app {

using mrpt::obs::CActionCollection;
using mrpt::obs::CObservation;
using mrpt::obs::CRawlog;
using mrpt::obs::CSensoryFrame;
using mrpt::serialization::CSerializable;

RawlogReader::RawlogReader(const CheckedLog& log, bool partial)
    : file_(log.file()), partial_(partial), objects_(log) {}

RawlogReader::RawlogReader(const std::string& file, std::unique_ptr<ByteSource> source)
    : file_(file), partial_(true), objects_(file, std::move(source)) {}

bool RawlogReader::next(RawlogEntry& entry) {
    while (pending_.empty()) {
        const CSerializable::Ptr object = nextObject();
        if (!object) {
            if (is_rawlog_ || !cut_.empty()) return false;
            throw std::runtime_error(file_ + ": not a rawlog: it holds " +
                                     (other_class_.empty() ? "nothing" : "a " + other_class_));
        }
        unpack(object);
    }
    entry = std::move(pending_.front());
    pending_.pop_front();
    return true;
}

CSerializable::Ptr RawlogReader::nextObject() {
    if (!cut_.empty()) return nullptr;
    try {
        return objects_.next();
    } catch (const CutFile& e) {
        cut_ = e.what();
        const std::size_t whole = objects_.objectsRead();
        if (!partial_)
            throw std::runtime_error(
                cut_ + (whole == 0 ? "; nothing before that is whole, for --partial to take"
                                   : "; its recorder may have crashed: --partial takes the " +
                                         std::to_string(whole) + " whole objects before it"));
        return nullptr;
    }
}

void RawlogReader::unpack(const CSerializable::Ptr& object) {
    if (!object) return;
    if (const auto rawlog = std::dynamic_pointer_cast<CRawlog>(object)) {
        is_rawlog_ = true;
        for (std::size_t i = 0; i < rawlog->size(); i++) unpack(rawlog->getAsGeneric(i));
    } else if (const auto frame = std::dynamic_pointer_cast<CSensoryFrame>(object)) {
        is_rawlog_ = true;
        for (const CObservation::Ptr& observation : *frame) unpack(observation);
    } else if (const auto actions = std::dynamic_pointer_cast<CActionCollection>(object)) {
        is_rawlog_ = true;
        pending_.push_back({actions, nullptr});
    } else if (const auto observation = std::dynamic_pointer_cast<CObservation>(object)) {
        is_rawlog_ = true;
        pending_.push_back({nullptr, observation});
    } else {
        other_class_ = object->GetRuntimeClass()->className;
    }
}

}  // namespace akimap::app
