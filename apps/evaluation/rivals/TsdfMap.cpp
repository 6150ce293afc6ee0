// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/rivals/TsdfMap.h"

#include <algorithm>

#include "evaluation/contest/beam.h"

namespace akimap::app {

namespace {

constexpr double kTruncation = 4;  // [cells]

}  // namespace

void TsdfMap::insert(const std::vector<Ray>& rays) {
    const double h = resolution(), truncation = kTruncation * h;
    for (const Ray& ray : rays) {
        const Beam beam(ray);
        walkCells(beam, beam.length + truncation, h, [&](const CellIndex& c, double, double) {
            const double along = ((c.x + 0.5) * h - beam.origin[0]) * beam.direction[0] +
                                 ((c.y + 0.5) * h - beam.origin[1]) * beam.direction[1] +
                                 ((c.z + 0.5) * h - beam.origin[2]) * beam.direction[2];
            const double distance = beam.length - along;
            if (distance <= -truncation) return false;
            const double weight = distance < 0 ? 1 + distance / truncation : 1;
            Cell& cell = cells_[c];
            cell.sum += static_cast<float>(weight * std::min(distance, truncation));
            cell.weight += static_cast<float>(weight);
            return true;
        });
    }
}

std::optional<double> TsdfMap::distance(const CellIndex& cell) const {
    const Cell found = SparseCells<Cell>::Reader(cells_)[cell];
    if (!(found.weight > 0)) return std::nullopt;
    return static_cast<double>(found.sum) / static_cast<double>(found.weight);
}

}  // namespace akimap::app
