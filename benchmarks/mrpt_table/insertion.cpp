// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <mrpt/maps/CMetricMapEvents.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/system/CObserver.h>

#include "Row.h"
#include "guard.h"

namespace akimap::bench {
namespace {

using mrpt::maps::CMetricMap;
using mrpt::poses::CPose3D;

constexpr double kSome = 0.2;  // share: COccupancyGridMap3D takes one return in 8 x 8 pixels

std::string places(const MapKind& kind, const CMetricMap& map, const Sample& s) {
    const std::string free = shareFree(kind, map, s) > kSome ? ", free space" : ", no free space";
    if (shareOccupied(kind, map, s, s.sensor()) > kSome) return "surface" + free;
    if (shareOccupied(kind, map, s, s.robot) > kSome) return "misplaced: `sensorPose` ignored";
    if (shareOccupied(kind, map, s, s.sensor() - s.robot) > kSome)
        return "misplaced: `robotPose` ignored";
    return "true, but no surface" + free;
}

std::string insert(const MapKind& kind, const Sample& s) {
    const auto map = kind.make();
    const std::string before = bytesOf(*map);
    const bool changed = map->insertObservation(*s.observation, s.robot);
    if (!changed) return bytesOf(*map) == before ? "false" : "false, but the map changed";
    if (!s.hasReturns()) return bytesOf(*map) == before ? "true, but nothing changed" : "true";
    return places(kind, *map, s);
}

bool leaves(const MapKind& kind, const Sample& s) {
    s.observation->load();  // an image in a file: that much may change
    const std::string before = bytesOf(*s.observation);
    try {
        const auto map = kind.make();
        map->insertObservation(*s.observation, s.robot);
        if (map->canComputeObservationLikelihood(*s.observation))
            map->computeObservationLikelihood(*s.observation, s.robot);
    } catch (const std::exception&) {  // has a row of its own
    }
    return bytesOf(*s.observation) == before;
}

/** Which classes of observations are not what they were. */
std::string leavesObservations(const MapKind& kind, const std::vector<Sample>& samples) {
    std::string changed;
    for (const Sample& s : samples) {
        const auto answer = [&] { return std::string(leaves(kind, s) ? "left" : "changed"); };
        // One that gets no answer has a row of its own, too.
        if (guarded(answer) == "changed") changed += (changed.empty() ? "" : "; ") + s.name;
    }
    return changed.empty() ? "yes" : "changes " + changed;
}

class Listener : public mrpt::system::CObserver {
 public:
    int insertions = 0, clearings = 0;

 private:
    void OnEvent(const mrpt::system::mrptEvent& e) override {
        insertions += e.isOfType<mrpt::maps::mrptEventMetricMapInsert>();
        clearings += e.isOfType<mrpt::maps::mrptEventMetricMapClear>();
    }
};

std::string events(const MapKind& kind) {
    const auto map = kind.make();
    Listener listener;
    listener.observeBegin(*map);
    const Sample s = plainSample();
    map->insertObservation(*s.observation, s.robot);
    map->clear();
    return listener.insertions == 1 && listener.clearings == 1
               ? "one each"
               : std::to_string(listener.insertions) + " and " + std::to_string(listener.clearings);
}

std::string fromSimplemap(const MapKind& kind) {
    const Sample s = plainSample();
    const auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(s.observation);
    mrpt::math::CMatrixDouble66 covariance;
    covariance.setDiagonal(6, 1e-8);
    const mrpt::poses::CPose3DPDF::Ptr pose =
        std::make_shared<mrpt::poses::CPose3DPDFGaussian>(s.robot, covariance);
    mrpt::maps::CSimpleMap keyframes;
    keyframes.insert(pose, frame);
    const auto map = kind.make();
    map->loadFromSimpleMap(keyframes);
    return places(kind, *map, s);
}

}  // namespace

Section insertionRows(const std::vector<Sample>& samples) {
    Section section{"Insertion",
                    "`insertObservation(observation, robotPose)` into an empty map: whether the "
                    "surface lies where `robotPose` ⊕ `sensorPose` puts it, with free space before "
                    "it; *false*: not taken, and the map is unchanged.",
                    {}};
    for (const Sample& s : samples)
        section.rows.push_back({s.name, [s](const MapKind& kind) { return insert(kind, s); }});
    section.rows.push_back(
        {"observations, once loaded, are left as they were",
         [samples](const MapKind& kind) { return leavesObservations(kind, samples); }});
    section.rows.push_back({"events: insertions, clearings", events});
    section.rows.push_back({"`loadFromSimpleMap`", fromSimplemap});
    return section;
}

}  // namespace akimap::bench
