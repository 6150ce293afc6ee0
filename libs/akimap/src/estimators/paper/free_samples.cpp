// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/paper/free_samples.h"

namespace akimap {
namespace {

/** The finalizer of SplitMix64: one well-mixed step. */
uint64_t mix(uint64_t v) {
    v += 0x9e3779b97f4a7c15u;
    v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
    v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
    return v ^ (v >> 31);
}
/** Uniform in [0, 1), a function of its place alone: no state to copy or to share. */
double uniform(uint64_t ray_key, uint64_t stretch) {
    return static_cast<double>(mix(ray_key + stretch) >> 11) * 0x1p-53;
}

void addFreeAlong(const KeptRay& kept, uint64_t scan_key, double stretch, Sampler& sampler) {
    const double length = lengthOf(*kept.ray);
    const uint64_t ray_key = mix(scan_key + kept.number);
    sampler.add(kept.ray->origin, 0);
    for (uint64_t k = 0; static_cast<double>(k) * stretch < length; k++) {
        const double t = (static_cast<double>(k) + uniform(ray_key, k)) * stretch;
        if (t < length) sampler.add(placeAlong(*kept.ray, t / length), t);
    }
}

}  // namespace

void takeSamples(const std::vector<Ray>& rays, const InsertionParameters& parameters,
                 const BlockGrid& grid, uint64_t scan_number, KeyTable& taken, Samples& samples,
                 InsertionStats& stats) {
    const auto kept = takeHits(rays, parameters, grid, taken, samples, stats);

    Sampler sampler(grid, taken, samples);
    const uint64_t scan_key = mix(mix(parameters.seed) + scan_number);
    for (const KeptRay& k : kept.hits)
        addFreeAlong(k, scan_key, parameters.sampling_distance, sampler);
    uint64_t number = rays.size();
    for (const Ray& r : kept.free)
        addFreeAlong({&r, number++}, scan_key, parameters.sampling_distance, sampler);

    stats.samples_free += samples.size() - samples.occupied;
}

}  // namespace akimap
