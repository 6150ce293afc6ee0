// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/SimplemapSource.h"

#include <mrpt/maps/CSimpleMap.h>

#include "input/ObjectReader.h"
#include "input/scan_classes.h"

namespace akimap::app {

namespace {

mrpt::maps::CSimpleMap::Ptr load(const CheckedLog& log) {
    const std::string& file = log.file();
    ObjectReader objects(log);
    const auto object = objects.next();
    const auto map = std::dynamic_pointer_cast<mrpt::maps::CSimpleMap>(object);
    if (!map)
        throw std::runtime_error(file + ": not a simplemap: it holds " +
                                 (object ? "a " + std::string(object->GetRuntimeClass()->className)
                                         : std::string("nothing")));
    if (objects.next()) throw std::runtime_error(file + ": more than one object in it");
    return map;
}

}  // namespace

SimplemapSource::SimplemapSource(const std::string& file, const InputOptions& options)
    : ScanSource(file), log_(file, options.external_files), only_label_(options.only_label) {
    const auto map = load(log_);
    for (const auto& keyframe : *map) {
        if (!keyframe.pose || !keyframe.sf) continue;
        for (const mrpt::obs::CObservation::Ptr& observation : *keyframe.sf) {
            if (!observation || !isScan(*observation)) continue;
            labels_.insert(observation->sensorLabel);
            if (only_label_.empty() || observation->sensorLabel == only_label_) scan_count_++;
        }
    }
}

void SimplemapSource::forEachScan(const TakeScan& take, SkippedScans& skipped) {
    findExternalFiles(file());
    const auto map = load(log_);
    for (const auto& keyframe : *map) {
        if (!keyframe.pose || !keyframe.sf) continue;
        const mrpt::poses::CPose3D pose = keyframe.pose->getMeanVal();
        for (const mrpt::obs::CObservation::Ptr& observation : *keyframe.sf) {
            if (!observation || !isWantedScan(*observation, only_label_, skipped)) continue;
            Scan scan{observation, pose, nullptr, {}};
            if (!take(scan)) return;
        }
    }
}

}  // namespace akimap::app
