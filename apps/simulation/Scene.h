// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/math/TBoundingBox.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "simulation/Shape.h"

namespace akimap::app {

enum class SceneKind : uint8_t {
    structured,    ///< walls, boxes, a table, shelves and pillars at fixed places
    unstructured,  ///< pillars, spheres and leaning slabs at random places
    furnished      ///< two rooms with doors, a window, thin legs, poles, stairs and a slope
};

/** How well sensors see a thing: see RangeErrors. In the truth all things are surfaces. */
enum class Material : uint8_t { matte, dark, glass };

/** Where a ray meets the scene. */
struct Hit {
    double distance;    ///< [m]
    std::size_t shape;  ///< its index
};

/** A robot's place on the floor: position [m] and the first of its headings [rad]. */
struct ScanPlace {
    double x, y, heading;
};

/** A room of 10 x 7 x 2 m with things in it. Its upright and level faces lie in the middle of
 * 5 cm cells and a quarter into 10 cm cells, so that range noise rarely carries a return into
 * the next cell. Const calls are thread-safe. */
class Scene {
 public:
    /** Distance [m] from the origin, inside the room, to the first surface along the ray.
     * \param direction  of unit length */
    [[nodiscard]] std::optional<double> castRay(
        const mrpt::math::TPoint3D& origin, const mrpt::math::TVector3D& direction,
        double max_distance = std::numeric_limits<double>::infinity()) const;
    /** The same with what it meets. \param through_glass  as if there were none */
    [[nodiscard]] std::optional<Hit> firstHit(const mrpt::math::TPoint3D& origin,
                                              const mrpt::math::TVector3D& direction,
                                              bool through_glass) const;
    /** Unit normal of the surface just before the hit, on the ray's side. */
    [[nodiscard]] mrpt::math::TVector3D normalBefore(const Hit& hit,
                                                     const mrpt::math::TPoint3D& origin,
                                                     const mrpt::math::TVector3D& direction) const;
    /** Distance [m] from the point to the nearest surface, never negative. */
    [[nodiscard]] double distanceToSurface(const mrpt::math::TPoint3D& point) const;

    [[nodiscard]] const std::vector<ShapePtr>& shapes() const { return shapes_; }
    [[nodiscard]] Material material(std::size_t shape) const { return materials_[shape]; }
    /** Where scans are taken: clear of obstacles, together they see most of the room. */
    [[nodiscard]] const std::vector<ScanPlace>& places() const { return places_; }
    [[nodiscard]] static double floorHeight();  ///< [m]

    void add(ShapePtr shape, Material material = Material::matte);
    void addPlace(const ScanPlace& place) { places_.push_back(place); }

 private:
    std::vector<ShapePtr> shapes_;
    std::vector<Material> materials_;  // one for each shape
    std::vector<Ball> balls_;          // one for each shape, a hair larger
    std::vector<ScanPlace> places_;
};

/** \param seed  places the things of the unstructured scene; the others are fixed */
Scene makeScene(SceneKind kind, uint64_t seed);

/** The box [m] to score maps in: room, walls and floor, on the faces of 5 and 10 cm cells. */
mrpt::math::TBoundingBox scoringBox();

}  // namespace akimap::app
