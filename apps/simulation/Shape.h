// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/math/TPoint3D.h>
#include <mrpt/math/TPose3D.h>

#include <memory>
#include <vector>

namespace akimap::app {

/** A point [m] of a surface, with the unit normal of the side that can be seen. */
struct SurfacePoint {
    mrpt::math::TPoint3D position;
    mrpt::math::TVector3D normal;
};

/** Encloses a shape: most rays miss most shapes, and this tells so soonest. */
struct Ball {
    mrpt::math::TPoint3D centre;
    double radius;  ///< [m]
};

/** A solid (or the room's shell) that rays meet exactly: no meshes, no rendering. */
class Shape {
 public:
    virtual ~Shape() = default;

    /** Distance [m] from a point outside to where the ray enters; infinity if it misses.
     * \param direction  of unit length */
    [[nodiscard]] virtual double rayDistance(const mrpt::math::TPoint3D& origin,
                                             const mrpt::math::TVector3D& direction) const = 0;
    /** Distance [m] from the point to the surface, never negative. */
    [[nodiscard]] virtual double distanceTo(const mrpt::math::TPoint3D& point) const = 0;
    [[nodiscard]] virtual Ball ball() const = 0;
    /** Points all over the surface, at most `spacing` [m] from one to the next. */
    [[nodiscard]] virtual std::vector<SurfacePoint> surface(double spacing) const = 0;
};

using ShapePtr = std::shared_ptr<const Shape>;

/** Floor and four walls of a room without a ceiling, seen from inside; opposite corners [m]. */
ShapePtr makeRoom(const mrpt::math::TPoint3D& low, const mrpt::math::TPoint3D& high);
/** \param centre  pose of the middle [m, rad]  \param size  side lengths [m] */
ShapePtr makeBox(const mrpt::math::TPose3D& centre, const mrpt::math::TVector3D& size);
/** An upright cylinder from z = bottom to top. [m] */
ShapePtr makePillar(double x, double y, double radius, double bottom, double top);
ShapePtr makeSphere(const mrpt::math::TPoint3D& centre, double radius);  ///< [m]

[[nodiscard]] inline double dot(const mrpt::math::TVector3D& a, const mrpt::math::TVector3D& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

}  // namespace akimap::app
