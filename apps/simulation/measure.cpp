// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// One ray's measurement, with all that can be wrong with it.

#include <mrpt/math/geometry.h>

#include <cmath>

#include "simulation/sensors.h"

namespace akimap::app {

using mrpt::math::TPoint3D;
using mrpt::math::TVector3D;

namespace {

/** What chance decides of a ray. */
struct Dice {
    explicit Dice(Random& random)
        : noise(random.normal(1)),
          dark(random.uniform(0, 1)),
          flat(random.uniform(0, 1)),
          glass(random.uniform(0, 1)),
          turn(random.uniform(-M_PI, M_PI)),
          off(std::sqrt(random.uniform(0, 1))),
          mix(random.uniform(0, 1)) {}

    double noise, dark, flat, glass;
    double turn, off;  // a place in the beam: angle, and distance from its middle in half widths
    double mix;
};

/** Is there anything but the constant noise? */
bool isPlain(const RangeErrors& e) {
    return e.linear == 0 && e.disparity == 0 && e.disparity_step == 0 && e.range_step == 0 &&
           e.beam == 0 && e.grazing == 0 && e.dark_loss == 0 && e.glass_pass == 0;
}

/** Another direction within the beam. */
TVector3D within(double beam, const TVector3D& direction, const Dice& dice) {
    const TVector3D other = std::abs(direction.z) < 0.9 ? TVector3D(0, 0, 1) : TVector3D(1, 0, 0);
    const TVector3D u = mrpt::math::crossProduct3D(direction, other).unitarize();
    const TVector3D v = mrpt::math::crossProduct3D(direction, u);
    const double off = std::tan(0.5 * beam * dice.off);
    return (direction + (u * std::cos(dice.turn) + v * std::sin(dice.turn)) * off).unitarize();
}

/** Of a pixel or pulse that sees a second surface beside its own. */
double mixedDistance(const RangeErrors& e, double first, double second, double mix) {
    if (std::abs(second - first) <= e.mixing) return first + mix * (second - first);
    return mix < 0.5 ? first : second;
}

bool isLost(const Scene& scene, const Hit& hit, const TPoint3D& origin, const TVector3D& direction,
            const RangeErrors& e, const Dice& dice) {
    if (scene.material(hit.shape) == Material::dark && dice.dark < e.dark_loss) return true;
    if (e.grazing == 0) return false;
    const double cosine = std::abs(dot(direction, scene.normalBefore(hit, origin, direction)));
    return cosine < dice.flat * e.grazing;
}

/** Rounds to a multiple of the step; 0: as it is. */
double rounded(double value, double step) {
    return step > 0 ? std::round(value / step) * step : value;
}

/** Without a disparity there is no depth: it is infinite. */
double withNoise(const RangeErrors& e, double distance, double forward, const Dice& dice) {
    if (e.disparity > 0 || e.disparity_step > 0) {
        const double disparity = 1 / (distance * forward) + e.disparity * dice.noise;
        distance = 1 / (rounded(disparity, e.disparity_step) * forward);
        return distance > 0 ? distance : INFINITY;
    }
    return rounded(distance + e.linear * distance * dice.noise, e.range_step);
}

std::optional<double> disturbed(const World& world, const TPoint3D& origin,
                                const TVector3D& direction, double forward, const Dice& dice) {
    const RangeErrors& e = world.errors;
    const bool through_glass = dice.glass < e.glass_pass;
    const auto hit = world.scene.firstHit(origin, direction, through_glass);
    if (!hit || isLost(world.scene, *hit, origin, direction, e, dice)) return std::nullopt;
    double distance = hit->distance;
    if (e.beam > 0) {
        const auto beside =
            world.scene.firstHit(origin, within(e.beam, direction, dice), through_glass);
        if (beside && beside->shape != hit->shape)
            distance = mixedDistance(e, distance, beside->distance, dice.mix);
    }
    return withNoise(e, distance, forward, dice);
}

}  // namespace

std::optional<double> measureRange(const World& world, const TPoint3D& origin,
                                   const TVector3D& direction, double min_range, Random& random,
                                   double forward, std::size_t beam) {
    const double noise = random.normal(world.errors.constant);
    const auto distance = isPlain(world.errors)
                              ? world.scene.castRay(origin, direction)
                              : disturbed(world, origin, direction, forward, Dice(random));
    if (!distance) return std::nullopt;
    const double offset = world.beam_offsets.empty() ? 0 : world.beam_offsets.at(beam);
    const double measured = *distance + noise + offset;
    // Written so that a depth of infinity plus noise is out of range too.
    if (!(measured >= min_range && measured <= world.max_range)) return std::nullopt;
    return measured;
}

}  // namespace akimap::app
