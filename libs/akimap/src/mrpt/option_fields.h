// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Options.h>

#include <type_traits>

// Each option's name, unit and meaning, said once: reading, writing, streaming and --help all go
// through these lists. visitFields(parameters, visit) calls visit(name, field, comment).

namespace akimap {

/** Reads one option as strictly as all are read; a missing key leaves the value.
 * \exception std::invalid_argument naming the key */
void readOption(const mrpt::config::CConfigFileBase& c, const std::string& section,
                const char* name, double& value);

/** void where P is the given parameters, const or not, or options made of them. */
template <class Wanted, class P>
using IfFieldsOf = std::enable_if_t<std::is_base_of_v<Wanted, std::remove_const_t<P>>>;

template <class Parameters, class Visitor>
IfFieldsOf<InsertionParameters, Parameters> visitFields(Parameters& o, Visitor&& visit) {
    visit("min_range", o.min_range, "[m] >= 0. Returns nearer to their ray's origin are dropped");
    visit("max_range", o.max_range, "[m] > min_range. Returns farther away are dropped");
    visit("beyond_max_range", o.beyond_max_range,
          "ignore | free: what beams say that met nothing up to max_range");
    visit("estimator", o.estimator,
          "surface (fitted to hits, free space around rays) | paper (sampling_distance to "
          "scale_max)");
    visit("surface_range", o.surface_range,
          "[m] > 0. estimator = surface: neighbours of a hit are sought no farther");
    visit("free_radius", o.free_radius,
          "[m] > 0. estimator = surface: how far free space reaches from a ray; 1.5 to 8 cells");
    visit("max_evidence", o.max_evidence,
          "[-] 0 or >= 1. estimator = surface: bound of alpha + beta, so that old scans fade; 0: "
          "none");
    visit("sampling_distance", o.sampling_distance,
          "[m] > 0. One free sample in each such stretch of a ray");
    visit("search_range_origin", o.search_range_origin,
          "[m] >= 0. Neighbour search range at the sensor; 0: one cell");
    visit("search_range_max", o.search_range_max,
          "[m] > 0. Neighbour search range at max_range; linear in between");
    visit("search_region", o.search_region,
          "box (the paper, and measured better) | ball (the authors' code)");
    visit("covariance_center", o.covariance_center,
          "sample (divided by M - 2) | mean (by M - 1): what the covariance is about");
    visit("covariance_floor", o.covariance_floor,
          "[m^2] >= 0. Added to the covariance's diagonal; 0: 0.4 of a cell's face");
    visit("bandwidth", o.bandwidth, "adaptive (the paper) | covariance (no Eq. 7) | isotropic");
    visit("isotropic_length", o.isotropic_length,
          "[m] > 0. Support radius of the kernels if bandwidth = isotropic");
    visit("scale_search", o.scale_search,
          "exact | descent (the authors' code): minimiser of Eq. 7");
    visit("scale_min_length", o.scale_min_length,
          "[m] >= 0. Eq. 7 leaves the longest semi-axis at least this; 0: one cell");
    visit("scale_max", o.scale_max, "[-] > 0. Upper bound of the length scale of Eq. 7");
    visit("prior_alpha", o.prior_alpha, "[-] > 0. Beta prior of each cell: occupied");
    visit("prior_beta", o.prior_beta, "[-] > 0. Beta prior of each cell: free");
    visit("seed", o.seed, "Seed of the free samples' random places");
    visit("threads", o.threads, "0: all cores. The map does not depend on it");
}

template <class Parameters, class Visitor>
IfFieldsOf<LikelihoodParameters, Parameters> visitFields(Parameters& o, Visitor&& visit) {
    visit("decimation", o.decimation, ">= 1. Use one return in so many");
    visit("sigma_hit", o.sigma_hit,
          "[m] >= 0. Standard deviation of a return's end along its ray: sensor, map and pose");
    visit("p_unknown", o.p_unknown,
          "[-] in (0,1). Weight of a return that ends in the unknown; 1: on a surface, 0: in free");
    visit("p_outlier", o.p_outlier, "[-] in (0,1). Share of returns that no map explains");
    visit("independent_returns", o.independent_returns,
          "[-] > 0. An observation counts as at most so many independent returns");
}

template <class Parameters, class Visitor>
IfFieldsOf<RenderingParameters, Parameters> visitFields(Parameters& o, Visitor&& visit) {
    visit("threshold", o.threshold, "[-] in (0,1). Cells of a higher occupancy are occupied");
    visit("show_free", o.show_free, "Draw free cells too, translucent");
    visit("max_voxels", o.max_voxels, "More cells than this are drawn as points, not voxels");
}

}  // namespace akimap
