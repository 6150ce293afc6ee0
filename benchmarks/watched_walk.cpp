// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "watched_walk.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "simulation/Walk.h"

namespace akimap::bench {
namespace {

std::set<CellPlace> cellsOf(const std::vector<app::ShapePtr>& shapes, double resolution) {
    std::set<CellPlace> cells;
    for (const app::ShapePtr& shape : shapes)
        for (const app::SurfacePoint& p : shape->surface(resolution / 4)) {
            const auto index = [&](double v) {
                return static_cast<int>(std::floor(v / resolution));
            };
            cells.insert({index(p.position.x), index(p.position.y), index(p.position.z)});
        }
    return cells;
}

std::vector<CellPlace> without(const std::set<CellPlace>& cells,
                               const std::set<CellPlace>& others) {
    std::vector<CellPlace> rest;
    std::set_difference(cells.begin(), cells.end(), others.begin(), others.end(),
                        std::back_inserter(rest));
    return rest;
}

bool holds(const std::vector<CellPlace>& sorted, const CellPlace& cell) {
    return std::binary_search(sorted.begin(), sorted.end(), cell);
}

/** Follows the cells that someone was in. */
class Watch {
 public:
    Watch(const MapUnderTest& map, double resolution) : map_(map), resolution_(resolution) {}

    /** \param someone  where they are now, this scan inserted */
    void look(const std::vector<CellPlace>& someone) {
        for (auto& [cell, waited] : waiting_) waited++;
        for (const CellPlace& cell : last_)
            if (!holds(someone, cell) && was_occupied_.count(cell)) waiting_[cell] = 1;
        for (const CellPlace& cell : someone) waiting_.erase(cell);
        visited_.insert(someone.begin(), someone.end());
        count(someone);
        last_ = someone;
        was_occupied_.clear();
        std::copy_if(someone.begin(), someone.end(),
                     std::inserter(was_occupied_, was_occupied_.end()),
                     [&](const CellPlace& c) { return isOccupied(c); });
        residue_.present.push_back(was_occupied_.size());
    }
    [[nodiscard]] Residue result() && {
        residue_.never = waiting_.size();
        return std::move(residue_);
    }

 private:
    void count(const std::vector<CellPlace>& someone) {
        std::size_t left = 0;
        for (const CellPlace& cell : visited_)
            left += !holds(someone, cell) && isOccupied(cell) ? 1 : 0;
        residue_.cells.push_back(left);
        for (auto it = waiting_.begin(); it != waiting_.end();) {
            if (isOccupied(it->first)) {
                ++it;
                continue;
            }
            residue_.waits.push_back(it->second);
            it = waiting_.erase(it);
        }
    }
    [[nodiscard]] bool isOccupied(const CellPlace& c) const {
        const auto p = map_.occupancy((c[0] + 0.5) * resolution_, (c[1] + 0.5) * resolution_,
                                      (c[2] + 0.5) * resolution_);
        return p && *p > 0.5;
    }

    const MapUnderTest& map_;
    double resolution_;
    Residue residue_;
    std::set<CellPlace> visited_, was_occupied_;  // the latter after the last scan
    std::vector<CellPlace> last_;
    std::map<CellPlace, std::size_t> waiting_;  // scans since they were left
};

}  // namespace

WatchedWalk simulatedWalk(app::SensorKind sensor, const std::string& name, uint64_t seed,
                          double resolution) {
    constexpr double kPeriod = 0.2, kBefore = 2, kStop = 3, kAfter = 10;  // [s]
    const app::SensorModel model = app::sensorModel(sensor);
    const app::Scene room = app::makeScene(app::SceneKind::structured, seed);
    constexpr double kStart = 1.7e9;  // [s since 1970]
    // There is a wall 3.4 m before the robot: what is left of someone gets looked through.
    const app::Walk walk{8.5, 5.4, 8.5, 0.4, kStart + kBefore, 1.2, kStop};
    const double end = walk.end() + kAfter;
    const mrpt::poses::CPose3D robot(6.6, 2.0, app::Scene::floorHeight(), 0, 0, 0);
    app::Trajectory stand;
    stand.add(kStart, robot), stand.add(end + 1, robot);

    const std::set<CellPlace> stays = cellsOf(room.shapes(), resolution);
    const auto offsets = app::drawBeamOffsets(model, model.errors, seed);
    app::Random random(seed, 6);
    WatchedWalk watched{name, resolution, model.max_range, {}, 0};
    for (int i = 0; kStart + i * kPeriod < end; i++) {
        const double time = kStart + i * kPeriod;
        const app::Scene now = app::sceneAt(room, walk, time);
        const app::World world{now, stand, false, model.errors, model.max_range, offsets};
        watched.scans.push_back({app::takeScan(model, world, time, random).rays,
                                 without(cellsOf(walk.at(time), resolution), stays)});
        if (time < walk.end()) watched.gone = watched.scans.size();
    }
    return watched;
}

Residue watch(MapUnderTest& map, const WatchedWalk& walk) {
    std::vector<std::vector<Ray>> rays;
    for (const WatchedScan& scan : walk.scans) rays.push_back(scan.rays);
    const std::vector<PreparedScan> prepared = prepare(rays, walk.max_range);
    Watch watch(map, walk.resolution);
    for (std::size_t i = 0; i < prepared.size(); i++) {
        map.insert(prepared[i]);
        watch.look(walk.scans[i].someone);
    }
    return std::move(watch).result();
}

}  // namespace akimap::bench
