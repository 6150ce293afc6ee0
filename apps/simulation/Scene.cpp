// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "simulation/Scene.h"

#include <algorithm>
#include <cmath>

#include "simulation/Random.h"
#include "simulation/furniture.h"

namespace akimap::app {

using mrpt::math::TPoint3D;
using mrpt::math::TVector3D;

namespace {

void addTable(Scene& scene, double x, double y, double length, double width) {
    constexpr double kLeg = 0.1, kUnderside = 0.7, kTop = 0.75;
    for (const double left : {x, x + length - kLeg})
        for (const double front : {y, y + width - kLeg})
            addCrate(scene, {left, front, 0}, {left + kLeg, front + kLeg, kUnderside});
    addCrate(scene, {x, y, kUnderside}, {x + length, y + width, kTop});
}

void addShelves(Scene& scene, const TPoint3D& low, const TPoint3D& high) {
    constexpr double kBoard = 0.05, kStep = 0.55;
    addCrate(scene, low, {high.x, low.y + kBoard, high.z});
    addCrate(scene, {low.x, high.y - kBoard, low.z}, high);
    for (double z = low.z + 0.1; z < high.z; z += kStep)
        addCrate(scene, {low.x, low.y, z}, {high.x, high.y, z + kBoard});
}

Scene makeStructured() {
    Scene scene;
    addRoom(scene);
    addCrate(scene, {4.0, 0, 0}, {4.15, 2.6, kHeight});  // two walls that jut into the room
    addCrate(scene, {6.2, 4.4, 0}, {6.35, kWidth, kHeight});
    addTable(scene, 1.2, 5.4, 1.5, 0.8);
    addShelves(scene, {9.6, 1.4, 0}, {kLength, 3.4, 1.8});
    addCrate(scene, {7.6, 5.9, 0}, {8.7, 6.7, 0.5});  // a stack
    addCrate(scene, {7.9, 6.1, 0.5}, {8.5, 6.6, 0.95});
    addCrate(scene, {4.8, 0.2, 0}, {5.9, 0.55, 0.4});  // a bench
    addCrate(scene, {2.3, 3.4, 0}, {2.6, 3.7, kHeight});
    const double floor = Scene::floorHeight();
    scene.add(makeBox({2.8, 0.8, floor + 0.3, 25 * M_PI / 180, 0, 0}, {0.8, 0.6, 0.6}));
    scene.add(makeBox({5.3, 6.2, floor + 0.45, -35 * M_PI / 180, 0, 0}, {0.5, 0.5, 0.9}));
    scene.add(makePillar(5.1, 3.7, 0.20, floor, floor + kHeight));
    scene.add(makePillar(7.4, 3.0, 0.15, floor, floor + kHeight));
    scene.add(makePillar(7.6, 0.9, 0.25, floor, floor + 1.1));
    scene.addPlace({1.5, 2.0, 0.3});
    scene.addPlace({3.7, 4.6, 1.9});
    scene.addPlace({5.6, 1.9, 1.2});
    scene.addPlace({8.2, 4.4, 2.8});
    return scene;
}

/** Draws places for round footprints that keep clear of each other, the walls and the robot. */
class FreeFloor {
 public:
    FreeFloor(const std::vector<ScanPlace>& places, Random& random) : random_(random) {
        for (const ScanPlace& p : places) taken_.push_back({p.x, p.y, kRobotClearance});
    }
    TPoint3D take(double radius) {
        constexpr int kTries = 1000;  // the floor is far from full: a few do
        TPoint3D p;
        for (int i = 0; i < kTries; i++) {
            p = {random_.uniform(radius + kGap, kLength - radius - kGap),
                 random_.uniform(radius + kGap, kWidth - radius - kGap), Scene::floorHeight()};
            if (isFree(p, radius)) break;
        }
        taken_.push_back({p.x, p.y, radius});
        return p;
    }

 private:
    static constexpr double kRobotClearance = 0.8, kGap = 0.2;  // [m]
    struct Disc {
        double x, y, radius;
    };
    [[nodiscard]] bool isFree(const TPoint3D& p, double radius) const {
        return std::none_of(taken_.begin(), taken_.end(), [&](const Disc& d) {
            return std::hypot(p.x - d.x, p.y - d.y) < radius + d.radius + kGap;
        });
    }

    Random& random_;
    std::vector<Disc> taken_;
};

void addSlab(Scene& scene, FreeFloor& floor, Random& random) {
    const double length = random.uniform(0.6, 1.4), thickness = random.uniform(0.06, 0.2);
    const double height = random.uniform(0.5, 1.5), yaw = random.uniform(-M_PI, M_PI);
    const double lean = random.uniform(-0.35, 0.35);
    const TPoint3D foot = floor.take(0.5 * length);
    // Somewhat sunk, so that no edge of a leaning slab hovers over the floor.
    const double z = foot.z + 0.5 * height - 0.05;
    scene.add(makeBox({foot.x, foot.y, z, yaw, 0, lean}, {length, thickness, height}));
}

Scene makeUnstructured(uint64_t seed) {
    Scene scene;
    addRoom(scene);
    scene.addPlace({2.0, 1.8, 0.5});
    scene.addPlace({3.0, 5.2, 2.4});
    scene.addPlace({6.6, 1.9, 1.0});
    scene.addPlace({7.6, 5.0, 0.1});
    Random random(seed, 1);
    FreeFloor floor(scene.places(), random);
    for (int i = 0; i < 7; i++) addSlab(scene, floor, random);
    for (int i = 0; i < 6; i++) {
        const double radius = random.uniform(0.15, 0.45), lift = random.uniform(0, 1.2);
        const TPoint3D foot = floor.take(radius);
        // Half of them lie on the floor, the others hang.
        scene.add(makeSphere({foot.x, foot.y, foot.z + radius + (i % 2 ? lift : 0)}, radius));
    }
    for (int i = 0; i < 8; i++) {
        const double radius = random.uniform(0.08, 0.28);
        const double height = i % 3 ? kHeight : random.uniform(0.5, 1.5);
        const TPoint3D foot = floor.take(radius);
        scene.add(makePillar(foot.x, foot.y, radius, foot.z, foot.z + height));
    }
    return scene;
}

}  // namespace

void Scene::add(ShapePtr shape, Material material) {
    constexpr double kRounding = 1e-9;  // [m]
    balls_.push_back(shape->ball());
    balls_.back().radius += kRounding;
    shapes_.push_back(std::move(shape));
    materials_.push_back(material);
}

std::optional<double> Scene::castRay(const TPoint3D& origin, const TVector3D& direction,
                                     double max_distance) const {
    const auto hit = firstHit(origin, direction, false);
    if (!hit || hit->distance > max_distance) return std::nullopt;
    return hit->distance;
}

std::optional<Hit> Scene::firstHit(const TPoint3D& origin, const TVector3D& direction,
                                   bool through_glass) const {
    Hit first{std::numeric_limits<double>::infinity(), 0};
    for (std::size_t i = 0; i < shapes_.size(); i++) {
        if (through_glass && materials_[i] == Material::glass) continue;
        const TVector3D to_ball = balls_[i].centre - origin;
        const double along = dot(to_ball, direction), radius = balls_[i].radius;
        if (to_ball.sqrNorm() - along * along > radius * radius) continue;
        const double distance = shapes_[i]->rayDistance(origin, direction);
        if (distance < first.distance) first = {distance, i};
    }
    return std::isfinite(first.distance) ? std::optional(first) : std::nullopt;
}

TVector3D Scene::normalBefore(const Hit& hit, const TPoint3D& origin,
                              const TVector3D& direction) const {
    constexpr double kBefore = 1e-4, kStep = 1e-6;  // [m]
    const TPoint3D at = origin + direction * (hit.distance - kBefore);
    TVector3D gradient;
    for (std::size_t i = 0; i < 3; i++) {
        TPoint3D low = at, high = at;
        low[i] -= kStep, high[i] += kStep;
        gradient[i] = shapes_[hit.shape]->distanceTo(high) - shapes_[hit.shape]->distanceTo(low);
    }
    return gradient.unitarize();
}

double Scene::distanceToSurface(const TPoint3D& point) const {
    double distance = std::numeric_limits<double>::infinity();
    for (const ShapePtr& shape : shapes_) distance = std::min(distance, shape->distanceTo(point));
    return distance;
}

double Scene::floorHeight() {
    return kCellMiddle;
}

Scene makeScene(SceneKind kind, uint64_t seed) {
    switch (kind) {
        case SceneKind::structured:
            return makeStructured();
        case SceneKind::unstructured:
            return makeUnstructured(seed);
        default:
            return makeFurnished();
    }
}

void addRoom(Scene& scene) {
    const TPoint3D low(kCellMiddle, kCellMiddle, kCellMiddle);
    scene.add(makeRoom(low, low + TVector3D(kLength, kWidth, kHeight)));
}

void addCrate(Scene& scene, const TPoint3D& low, const TPoint3D& high, Material material) {
    const TPoint3D centre = (low + high) * 0.5 + TVector3D(kCellMiddle, kCellMiddle, kCellMiddle);
    scene.add(makeBox({centre.x, centre.y, centre.z, 0, 0, 0}, high - low), material);
}

mrpt::math::TBoundingBox scoringBox() {
    return {{0, 0, 0}, {kLength + 0.1, kWidth + 0.1, kHeight + 0.1}};
}

}  // namespace akimap::app
