// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

// The default estimator as doc/design.md has it, slow and obviously right: every hit against every
// other, every patch against every cell of its box, every ball against every cell that it reaches,
// in doubles, in the order of the text. Blocks occur only where the method has them: near surfaces
// each cell knows the rays that passed. The library's fast path is held against it.

#include "surface_reference_patches.h"
#include "surface_reference_rays.h"

namespace akimap::reference::surface {

// 5 to 7. The map.

struct State {
    double s0 = 0, s1 = 0, s2 = 0, f = 0;
    double alpha = 0, beta = 0;
};

template <class Map>
typename Map::mapped_type valueAt(const Map& map, const Cell& c) {
    const auto found = map.find(c);
    return found == map.end() ? typename Map::mapped_type() : found->second;
}

class SurfaceMap {
 public:
    SurfaceMap(const InsertionParameters& p, double resolution) : p_(p), resolution_(resolution) {}

    void insert(const std::vector<Ray>& rays);
    [[nodiscard]] const std::map<Cell, State>& cells() const { return cells_; }

 private:
    static bool addFar(double b, bool passed, State& s);
    static bool addNear(const Measured& measured, double b, int passes, State& s);
    void answer(State& s) const;

    InsertionParameters p_;
    double resolution_;
    std::map<Cell, State> cells_;
    std::set<Block> blocks_;  // that surfaces came near
};

/** Far from any surface. \param b of Step 4 \return whether there is more evidence */
inline bool SurfaceMap::addFar(double b, bool passed, State& s) {
    s.f += passed ? 1 : 0.5 * b * b;
    return passed || b > 0;
}

inline bool SurfaceMap::addNear(const Measured& m, double b, int passes, State& s) {
    if (m.weight > 0) {
        const double w = std::min(1.0, m.weight) * (passes > 0 && m.returns == 0 ? 0.2 : 1),
                     d = m.place / m.weight;
        s.s0 += w, s.s1 += w * d, s.s2 += w * d * d;
    }
    if (passes > 0) {
        s.f += passes / static_cast<double>(passes + m.returns);
    } else if (m.weight <= 0) {  // between rays
        const double inferred = 0.3 * b * b, later = std::pow(b, 8);
        if (inferred > s.f)
            s.f = inferred;
        else if (s.s0 > 0 && later > 1e-3)
            s.f += 0.6 * later;
        else
            return false;
    }
    return true;
}

inline void SurfaceMap::answer(State& s) const {
    s.alpha = 0, s.beta = 3 * s.f;
    if (s.s0 > 0) {
        const auto phi = [](double z) { return std::erfc(-z / std::sqrt(2.0)) / 2; };
        const double mean = s.s1 / s.s0, scans = std::clamp(s.s0, 1.0, 4.0),
                     variance = std::max(0.0, s.s2 / s.s0 - mean * mean) + 0.35 * 0.35 / scans,
                     sigma = std::sqrt(variance), not_before = phi((0.45 - mean) / sigma);
        s.alpha = 2 * s.s0 * (not_before - phi((-2.5 - mean) / sigma));
        s.beta += s.s0 * phi((mean - 0.45) / sigma);
    }
    if (p_.max_evidence > 0 && s.alpha + s.beta > p_.max_evidence) {
        const double scale = p_.max_evidence / (s.alpha + s.beta);
        for (double* v : {&s.s0, &s.s1, &s.s2, &s.f, &s.alpha, &s.beta}) *v *= scale;
    }
}

inline void SurfaceMap::insert(const std::vector<Ray>& rays) {
    const Lines lines = linesOf(rays, p_, resolution_);
    const auto patches = patchesOf(lines.hits, p_, resolution_);
    const Surfaces surfaces = surfacesOf(patches);
    const auto isNear = [&](const Block& b) {
        return blocks_.count(b) || surfaces.blocks.count(b);
    };
    const double radius = std::clamp(p_.free_radius / resolution_, 1.5, 8.0);
    const Marks marks = marksOf(lines, patches, radius, {blocks_, surfaces.blocks});
    const auto near = nearnessOf(marks, radius);

    std::set<Cell> touched;
    for (const auto& of : surfaces.cells) touched.insert(of.first);
    for (const auto& of : near) touched.insert(of.first);
    for (const auto& of : marks) touched.insert(of.first);
    for (const auto& of : cells_) touched.insert(of.first);
    for (const Cell& c : touched) {
        const Block block = blockOf(c);
        State& s = cells_[c];
        if (isNear(block) && !blocks_.count(block))
            s.f = std::min(s.f, 1.0);  // none was near before
        const double b = valueAt(near, c);
        const int passes = valueAt(marks, c).passes;
        const bool gained = isNear(block) ? addNear(valueAt(surfaces.cells, c), b, passes, s)
                                          : addFar(b, passes > 0, s);
        if (gained) answer(s);
    }
    for (const auto& [c, s] : cells_)
        if (s.alpha + s.beta > 0 && surfaces.blocks.count(blockOf(c))) blocks_.insert(blockOf(c));
}

}  // namespace akimap::reference::surface
