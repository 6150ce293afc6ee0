// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>

#include <deque>
#include <string>

#include "input/ObjectReader.h"

namespace akimap::app {

/** Exactly one of them is there. */
struct RawlogEntry {
    mrpt::obs::CActionCollection::Ptr actions;
    mrpt::obs::CObservation::Ptr observation;
};

/** Streams a rawlog: sensory frames or bare observations, one by one or in one CRawlog. */
class RawlogReader {
 public:
    /** \param partial take a cut file's end for a clean one
     * \exception std::runtime_error naming the file */
    RawlogReader(const CheckedLog& log, bool partial);
    /** Reads the file's bytes, unchecked, from `source`, and takes its end for a clean one. */
    RawlogReader(const std::string& file, std::unique_ptr<ByteSource> source);

    /** False at the end.
     * \exception std::runtime_error naming the file and the object: damaged, cut, no rawlog */
    bool next(RawlogEntry& entry);

    /** Says where the file is cut, once next() has got there; empty if it isn't. */
    [[nodiscard]] const std::string& cut() const { return cut_; }

 private:
    void unpack(const mrpt::serialization::CSerializable::Ptr& object);
    mrpt::serialization::CSerializable::Ptr nextObject();

    std::string file_;
    bool partial_;
    ObjectReader objects_;
    std::deque<RawlogEntry> pending_;
    bool is_rawlog_ = false;   // something that belongs into a rawlog has been seen
    std::string other_class_;  // the last object that does not
    std::string cut_;
};

}  // namespace akimap::app
