// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Cell.h>

#include <cstdint>

// The options of a map as plain data: no MRPT here. Options.h makes them loadable. Each struct's
// validate() throws std::invalid_argument naming the option and its value.

namespace akimap {

/** How a scan becomes evidence. */
enum class Estimator : uint8_t {
    paper = 0,   ///< samples with kernels of both labels: the paper's method
    surface = 1  ///< surfaces fitted to the hits, free space around the rays
};

/** How beams without a return within max_range are used. */
enum class BeyondMaxRange : uint8_t {
    ignore = 0,  ///< not at all
    free = 1     ///< as free space up to max_range; see raysOf() for who knows such beams
};

/** How the kernel of a sample gets its bandwidth matrix H (paper, Sec. IV-C). */
enum class Bandwidth : uint8_t {
    adaptive = 0,    ///< H = s^2 * covariance, the scale s by Eq. (7): the paper's method
    covariance = 1,  ///< H = covariance of the neighbours of the same label
    isotropic = 2    ///< H = isotropic_length^2 * I, no neighbours: the paper's rivals
};

/** The region around a sample in which its neighbours are sought. */
enum class SearchRegion : uint8_t {
    ball = 0,  ///< radius = the search range (the authors' code)
    box = 1    ///< half side = the search range (the paper's drawing)
};

/** How Eq. (7) is minimised. */
enum class ScaleSearch : uint8_t {
    exact = 0,   ///< the global minimum within the bounds
    descent = 1  ///< the authors' gradient descent, which mostly jumps to a bound; for comparison
};

/** What the second moments of the neighbours are taken about. */
enum class CovarianceCenter : uint8_t {
    sample = 0,  ///< about the sample itself, divided by M - 2 (the authors' code)
    mean = 1     ///< about the neighbours' mean, divided by M - 1
};

/** What every estimator heeds. */
struct ScanParameters {
    double min_range = 0;    ///< [m] >= 0. Returns nearer to their own ray origin are dropped
    double max_range = 8.0;  ///< [m] > min_range. Returns farther away are dropped
    BeyondMaxRange beyond_max_range = BeyondMaxRange::ignore;
    double prior_alpha = 1e-3;  ///< [-] > 0. Beta prior of every cell, occupied (Eq. 2)
    double prior_beta = 1e-3;   ///< [-] > 0. Beta prior of every cell, free (Eq. 3)
    uint32_t threads = 0;       ///< 0: all cores. The map does not depend on it

    /** The range rule: whether a return of this length [m] of its ray is used. Poses are applied in
     * floating point: what equals a limit must stay equal. */
    [[nodiscard]] bool takesLength(double length) const {
        constexpr double kRounding = 1e-6;
        return length > 0 && length <= max_range * (1 + kRounding) &&
               length >= min_range * (1 - kRounding);
    }
    void validate() const;
};

/** Of estimator = surface. */
struct SurfaceParameters {
    double surface_range = 0.5;  ///< [m] > 0. Neighbours of a hit are sought no farther
    double free_radius = 0.2;    ///< [m] > 0. Free space reaches so far from a ray, 1.5 to 8 cells
    double max_evidence = 100;   ///< [-] 0 or >= 1. alpha + beta of a cell is scaled down to it, so
                                 ///< that old scans fade; 0: never
    void validate() const;
};

/** Of estimator = paper. The defaults are the paper's, and where it is silent its authors' code's.
 */
struct PaperParameters {
    double sampling_distance = 0.5;  ///< [m] > 0. One free sample in each such stretch of a ray
    double search_range_origin = 0;  ///< [m] >= 0. Search range at the sensor; 0: one cell
    double search_range_max = 0.5;   ///< [m] > 0. Search range at max_range; linear in between
    SearchRegion search_region = SearchRegion::box;
    CovarianceCenter covariance_center = CovarianceCenter::sample;
    double covariance_floor = 0;  ///< [m^2] >= 0. Added to the covariance's diagonal; 0: 0.4 of a
                                  ///< cell's face, the authors' 0.001 m^2 at 5 cm
    Bandwidth bandwidth = Bandwidth::adaptive;
    double isotropic_length = 0.2;  ///< [m] > 0. Support radius for bandwidth = isotropic
    ScaleSearch scale_search = ScaleSearch::exact;
    double scale_min_length = 0;  ///< [m] >= 0. Eq. (7) leaves the longest semi-axis at least this
                                  ///< long; 0: one cell
    double scale_max = 1.0;       ///< [-] > 0. Upper bound of the length scale in Eq. (7)
    uint64_t seed = 1;            ///< Seed of the free samples' random places

    void validate() const;
};

/** How scans are inserted: the common part, and each estimator's own. */
struct InsertionParameters : ScanParameters, SurfaceParameters, PaperParameters {
    Estimator estimator = Estimator::surface;

    [[nodiscard]] Prior prior() const { return {prior_alpha, prior_beta}; }
    void validate() const;
};

/** How well an observation fits the map: see AkiMap::computeObservationLikelihood. */
struct LikelihoodParameters {
    uint32_t decimation = 1;  ///< >= 1. Use one return in every `decimation`
    double sigma_hit = 0.1;   ///< [m] >= 0. Standard deviation of a return's end along its ray:
                              ///< the sensor's, the map's and half the spacing of the poses tried:
                              ///< more to localize globally (0.15 m at 200 particles a m^2)
    double p_unknown = 0.1;   ///< [-] in (0,1). Weight of a return that ends where nothing is
                              ///< known; 1 is a return on a certain surface, 0 one in free space
    double p_outlier = 0.05;  ///< [-] in (0,1). Share of returns that no map explains
    double independent_returns = 8;  ///< [-] > 0. An observation counts as at most this many
                                     ///< independent returns: their errors are shared

    void validate() const;
};

/** How the map is drawn. */
struct RenderingParameters {
    double threshold = 0.5;        ///< [-] in (0,1). Cells of a higher occupancy are occupied
    bool show_free = false;        ///< Draw free cells too, translucent
    uint32_t max_voxels = 250000;  ///< More cells are drawn as points (a voxel costs about 3 kB)

    void validate() const;
};

}  // namespace akimap
