// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Cell.h>
#include <akimap/InsertionStats.h>
#include <akimap/Options.h>
#include <akimap/Ray.h>
#include <akimap/rays.h>
#include <mrpt/maps/CMetricMap.h>
#include <mrpt/math/TBoundingBox.h>
#include <mrpt/math/TPoint3D.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/version.h>
#if MRPT_VERSION >= 0x020b03
#include <mrpt/maps/NearestNeighborsCapable.h>
#endif

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace akimap {

class BlockGrid;
class SurfacePoints;
struct AkiMapImpl;

#if MRPT_VERSION >= 0x020b03
using NearestNeighborsInterface = mrpt::maps::NearestNeighborsCapable;
#else
struct NearestNeighborsInterface {};  // AkiMap's nn_ functions are there all the same
#endif

/** Dense and sharp 3D occupancy map: a Beta distribution for each cell, learnt from scans.
 *
 * Each scan adds evidence to the cells: `insertionOptions.estimator` says how. By default
 * (`surface`, doc/design.md) a surface is fitted around each return, which makes the cells near it
 * occupied, and the space around its ray free. `paper` is adaptive kernel inference (Kwon, Moon and
 * Yoon, AKIMap): each return adds an occupied sample and free samples along its ray, and each
 * sample spreads its evidence over an ellipsoid shaped by its neighbours. A cell *has evidence*
 * once a scan has reached its centre; all others are unknown.
 *
 * Frames: rays are in the map frame; observations are placed by robotPose (+) sensorPose.
 * Threads: concurrent const calls are safe; insertions, clear(), loading, assignment and changes of
 * options must be alone, but for snapshot(). For a given seed the map's bits do not depend on the
 * number of threads. */
class AkiMap : public mrpt::maps::CMetricMap, public NearestNeighborsInterface {
    DEFINE_SERIALIZABLE(AkiMap, akimap)
 public:
    /** \param resolution side of a cell [m] \exception std::invalid_argument unless > 0 */
    explicit AkiMap(double resolution = 0.05);
    ~AkiMap() override;
    AkiMap(const AkiMap& o);
    AkiMap& operator=(const AkiMap& o);

    TInsertionOptions insertionOptions;
    TLikelihoodOptions likelihoodOptions;
    TRenderingOptions renderingOptions;

    MAP_DEFINITION_START(AkiMap)
    double resolution = 0.05;  ///< [m] > 0. Side of a cell
    akimap::TInsertionOptions insertionOpts;
    akimap::TLikelihoodOptions likelihoodOpts;
    akimap::TRenderingOptions renderingOpts;
    MAP_DEFINITION_END(AkiMap)

    /** Inserts one scan given as rays [m], map frame. Unusable rays are skipped and counted. Scans
     * with a usable ray are numbered; the next number is part of the map. \return whether the map
     * changed \exception std::invalid_argument if insertionOptions are invalid, std::bad_alloc; the
     * map is unchanged then */
    bool insertRays(const std::vector<Ray>& rays);

    using RobotPoseAt = akimap::RobotPoseAt;
    /** Like insertObservation(), for a robot that moved during the scan: each Velodyne packet is
     * placed, and its rays begin, where the sensor was when it was taken; packets at times of
     * unknown pose are skipped. Other observations are placed by the pose at their timestamp.
     * \return whether the map changed */
    bool insertMovingObservation(const mrpt::obs::CObservation& obs,
                                 const RobotPoseAt& robot_pose_at);
    [[nodiscard]] const InsertionStats& stats() const;
    /** The insertion options as they are used at this cell size: with what 0 stands for filled in,
     * and clamped values clamped. */
    [[nodiscard]] InsertionParameters optionsInForce() const;

    /** The map between two scans, which never changes: for threads that read while another inserts.
     * May be called at the same time as an insertion, whose end it waits for. Its cells are shared
     * until the next scans change them; what is asked for again before the map or its options
     * change is the same object, search trees and all. */
    [[nodiscard]] std::shared_ptr<const AkiMap> snapshot() const;

    /** Removes all cells and takes a new cell size [m]. */
    void setResolution(double resolution);
    [[nodiscard]] double resolution() const;  ///< [m]

    /** The cell that holds the point [m]; empty where nothing is known. */
    [[nodiscard]] std::optional<CellState> cell(double x, double y, double z) const;
    /** Probability that the cell that holds the point [m] is occupied, Eq. (4). */
    [[nodiscard]] std::optional<double> occupancy(double x, double y, double z) const;

    /** Calls visit(const Cell&) for each cell with evidence, in a fixed order. */
    template <class Visitor>
    void forEachCell(Visitor&& visit) const {
        visitCells([&](const Cell* cells, std::size_t n) {
            for (std::size_t i = 0; i < n; i++) visit(cells[i]);
        });
    }
    /** Centres [m] of the cells whose occupancy is above the threshold. */
    [[nodiscard]] std::vector<mrpt::math::TPoint3Df> occupiedCells(double threshold = 0.5) const;
    /** Where the surfaces are [m]: a point for each occupied cell, off its centre where the
     * evidence in and around it is. What matching and the nearest-neighbour search see. */
    [[nodiscard]] std::vector<mrpt::math::TPoint3Df> surfacePoints() const;
    [[nodiscard]] std::size_t cellCount() const;    ///< cells with evidence; visits all
    [[nodiscard]] std::size_t blockCount() const;   ///< blocks of 8^3 cells
    [[nodiscard]] std::size_t memoryBytes() const;  ///< of blocks, index and slack
    /** The cells' sums; an internal class, for what is built with the library. */
    [[nodiscard]] const BlockGrid& grid() const;

    /** Box [m] around the cells with evidence; all zeros when empty. */
    [[nodiscard]] mrpt::math::TBoundingBoxf boundingBox() const;

    // The MRPT interface ------------------------------------------------------------------
    [[nodiscard]] bool isEmpty() const override;
    [[nodiscard]] std::string asString() const override;
    void getVisualizationInto(mrpt::opengl::CSetOfObjects& out) const override;
    /** Writes `<prefix>_3D.3Dscene` and `<prefix>.akimap`. */
    void saveMetricMapRepresentationToFile(const std::string& prefix) const override;

    /** Pairs the points of otherMap, a points map or an AkiMap placed at otherMapPose, with the
     * surface points: for ICP. All of params is honoured; from the nearest surface point in 3D if
     * onlyKeepTheClosest, else from all within the allowed distance. globalIdx counts the surface
     * points. extraResults: the share of the points looked at that found a partner, and the mean
     * (as MRPT's points maps have it) of the pairs' squared distances [m^2].
     * In 2D the points keep their heights, which tell floor from wall, and distances are measured
     * from above. Two empty maps give no pairs.
     * \exception std::invalid_argument if otherMap is of another class or the decimation is 0 */
    void determineMatching2D(const mrpt::maps::CMetricMap* otherMap,
                             const mrpt::poses::CPose2D& otherMapPose,
                             mrpt::tfest::TMatchingPairList& correspondences,
                             const mrpt::maps::TMatchingParams& params,
                             mrpt::maps::TMatchingExtraResults& extraResults) const override;
    void determineMatching3D(const mrpt::maps::CMetricMap* otherMap,
                             const mrpt::poses::CPose3D& otherMapPose,
                             mrpt::tfest::TMatchingPairList& correspondences,
                             const mrpt::maps::TMatchingParams& params,
                             mrpt::maps::TMatchingExtraResults& extraResults) const override;
    /** Share of the points of otherMap (or of the one points map in it) that have a surface point
     * within maxDistForCorr; 0 if it has no points. */
    [[nodiscard]] float compute3DMatchingRatio(
        const mrpt::maps::CMetricMap* otherMap, const mrpt::poses::CPose3D& otherMapPose,
        const mrpt::maps::TMatchingRatioParams& params) const override;
    /** [m^2] to the nearest surface point as seen from above; the largest float if there is none,
     * or if the point is not finite. */
    [[nodiscard]] float squareDistanceToClosestCorrespondence(float x0, float y0) const override;
    /** Frees what can be made again from the cells. */
    void auxParticleFilterCleanUp() override;

    // mrpt::maps::NearestNeighborsCapable (from MRPT 2.11.3 on), over the surface points: indices
    // are theirs, 2D searches see them from above, radii are exclusive, results come nearest first.
    [[nodiscard]] bool nn_has_indices_or_ids() const;
    void nn_prepare_for_2d_queries() const;
    void nn_prepare_for_3d_queries() const;
    [[nodiscard]] std::size_t nn_index_count() const;
    [[nodiscard]] bool nn_single_search(const mrpt::math::TPoint3Df& query,
                                        mrpt::math::TPoint3Df& result, float& out_dist_sqr,
                                        uint64_t& resultIndexOrID) const;
    [[nodiscard]] bool nn_single_search(const mrpt::math::TPoint2Df& query,
                                        mrpt::math::TPoint2Df& result, float& out_dist_sqr,
                                        uint64_t& resultIndexOrID) const;
    void nn_multiple_search(const mrpt::math::TPoint3Df& query, std::size_t N,
                            std::vector<mrpt::math::TPoint3Df>& results,
                            std::vector<float>& out_dists_sqr,
                            std::vector<uint64_t>& resultIndicesOrIDs) const;
    void nn_multiple_search(const mrpt::math::TPoint2Df& query, std::size_t N,
                            std::vector<mrpt::math::TPoint2Df>& results,
                            std::vector<float>& out_dists_sqr,
                            std::vector<uint64_t>& resultIndicesOrIDs) const;
    void nn_radius_search(const mrpt::math::TPoint3Df& query, float search_radius_sqr,
                          std::vector<mrpt::math::TPoint3Df>& results,
                          std::vector<float>& out_dists_sqr,
                          std::vector<uint64_t>& resultIndicesOrIDs,
                          std::size_t maxPoints = 0) const;
    void nn_radius_search(const mrpt::math::TPoint2Df& query, float search_radius_sqr,
                          std::vector<mrpt::math::TPoint2Df>& results,
                          std::vector<float>& out_dists_sqr,
                          std::vector<uint64_t>& resultIndicesOrIDs,
                          std::size_t maxPoints = 0) const;

    /** Writes the map (doc/format.md), whole or not at all: a file that is there already is
     * replaced when the new one is on the disk. \exception std::runtime_error naming the file and
     * the system's reason */
    void saveToFile(const std::string& file) const;
    /** \exception std::runtime_error naming the file if it is missing, damaged or no AkiMap */
    static AkiMap::Ptr loadFromFile(const std::string& file);

 private:
    void internal_clear() override;
    bool internal_insertObservation(
        const mrpt::obs::CObservation& obs,
        const std::optional<const mrpt::poses::CPose3D>& robotPose) override;
    double internal_computeObservationLikelihood(
        const mrpt::obs::CObservation& obs, const mrpt::poses::CPose3D& takenFrom) const override;
    [[nodiscard]] bool internal_canComputeObservationLikelihood(
        const mrpt::obs::CObservation& obs) const override;

    void readHead(const std::string& text);
    void readSections(mrpt::serialization::CArchive& in);
    void readFormat1Or2(mrpt::serialization::CArchive& in, uint8_t version);

    [[nodiscard]] const SurfacePoints& surface() const;
    void visitCells(const std::function<void(const Cell*, std::size_t)>& visit) const;

    std::unique_ptr<AkiMapImpl> impl_;
};

/** Registers the classes with MRPT. Loading the library does it too, but a linker that drops
 * unused libraries (--as-needed) may never load it: C++ programs call this once. */
void registerClasses();

}  // namespace akimap
