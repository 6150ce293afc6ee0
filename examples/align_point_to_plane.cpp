// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers

// Registers scans against an AkiMap by its surface normals (point-to-plane), and by MRPT's ICP
// (point-to-point), from starts that are off by up to 0.2 m and 5 degrees.
// Usage: align_point_to_plane DRIVE.rawlog, with robot poses (akimap simulate --with-poses --sensor
// velodyne): every fourth scan is registered against the map of the others.
#include <akimap/AkiMap.h>
#include <akimap/queries.h>
#include <akimap/rays.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/poses/CPose3DPDF.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/slam/CICP.h>

#include <Eigen/Dense>
#include <algorithm>
#include <iostream>
#include <random>
#include <unordered_map>

namespace {

using mrpt::poses::CPose3D;

/** A scan and where it was taken from. */
struct Scan {
    mrpt::obs::CObservation::Ptr observation;
    CPose3D truth;
};

/** The observations of a rawlog, each behind its robot pose. */
std::vector<Scan> readDrive(const std::string& rawlog) {
    mrpt::io::CFileGZInputStream file;
    if (!file.open(rawlog)) throw std::runtime_error("can't read " + rawlog);
    auto archive = mrpt::serialization::archiveFrom(file);
    std::vector<Scan> scans;
    CPose3D robot;
    bool has_poses = false;
    mrpt::obs::CActionCollection::Ptr actions;
    mrpt::obs::CSensoryFrame::Ptr frame;
    mrpt::obs::CObservation::Ptr o;
    std::size_t entry = 0;
    while (mrpt::obs::CRawlog::getActionObservationPairOrObservation(archive, actions, frame, o,
                                                                     entry)) {
        if (const auto p = std::dynamic_pointer_cast<mrpt::obs::CObservationRobotPose>(o))
            robot = p->pose.mean, has_poses = true;
        else if (o && akimap::givesRays(*o))
            scans.push_back({o, robot});
    }
    if (!has_poses)
        throw std::runtime_error(rawlog + ": no robot poses in it; akimap convert " + rawlog +
                                 " --poses FILE -o OUT.rawlog writes them");
    return scans;
}

/** What a scan saw, and from where, in the robot's frame [m]. */
struct Cloud {
    Eigen::Vector3d sensor{0, 0, 0};
    std::vector<Eigen::Vector3d> points;
};
Cloud cloudOf(const mrpt::obs::CObservation& scan) {
    const auto rays =
        akimap::raysOf(scan, [](mrpt::Clock::time_point) { return std::optional(CPose3D()); });
    Cloud cloud;
    for (const akimap::Ray& r : *rays) {
        cloud.sensor = {r.origin[0], r.origin[1], r.origin[2]};
        cloud.points.emplace_back(r.end[0], r.end[1], r.end[2]);
    }
    return cloud;
}

/** The surface of a map as planes: each surface point with the normal there, looked up once. */
class Planes {
 public:
    struct Plane {
        Eigen::Vector3d point, normal;
        double confidence;  // 0 where the map has no normal
    };
    explicit Planes(const akimap::AkiMap& map) : map_(map) {}
    /** The plane nearest to a point; null if none is within the reach [m]. */
    const Plane* nearest(const Eigen::Vector3d& p, double reach) {
        mrpt::math::TPoint3Df q;
        float sqr_distance = 0;
        uint64_t id = 0;
        const mrpt::math::TPoint3Df at(static_cast<float>(p[0]), static_cast<float>(p[1]),
                                       static_cast<float>(p[2]));
        if (!map_.nn_single_search(at, q, sqr_distance, id)) return nullptr;
        if (static_cast<double>(sqr_distance) > reach * reach) return nullptr;
        const auto [it, is_new] = known_.try_emplace(id);
        if (is_new) {
            const mrpt::math::TPoint3D d(q);
            const auto n = akimap::surfaceNormal(map_, d.x, d.y, d.z);
            it->second = {{d.x, d.y, d.z}, {0, 0, 0}, n ? n->confidence : 0};
            if (n) it->second.normal = {n->direction.x, n->direction.y, n->direction.z};
        }
        return &it->second;
    }

 private:
    const akimap::AkiMap& map_;
    std::unordered_map<uint64_t, Plane> known_;
};

/** Gauss-Newton on the distances of the scan's points from their nearest planes, weighted by the
 * normals' confidences. The reach shrinks, so that few wrong pairs remain at the end; planes that
 * face away from the sensor are the other sides of things. */
Eigen::Isometry3d alignToPlanes(Planes& planes, const Cloud& scan, Eigen::Isometry3d T) {
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    constexpr double kSmallestReach = 0.05;  // [m]
    constexpr double kFacing = -0.3;         // cosine; planes seen edge-on are rough
    double reach = 0.5;                      // [m]
    for (int i = 0; i < 100; i++) {
        Eigen::Matrix<double, 6, 6> A = 1e-6 * Eigen::Matrix<double, 6, 6>::Identity();
        Vector6 b = Vector6::Zero();
        const Eigen::Vector3d sensor = T * scan.sensor;
        for (const Eigen::Vector3d& p : scan.points) {
            const Eigen::Vector3d turned = T.linear() * p, placed = turned + T.translation();
            const auto* plane = planes.nearest(placed, reach);
            if (!plane || plane->normal.dot((sensor - plane->point).normalized()) <= kFacing)
                continue;
            Vector6 J;
            J << turned.cross(plane->normal), plane->normal;
            A += plane->confidence * J * J.transpose();
            b -= plane->confidence * J * plane->normal.dot(placed - plane->point);
        }
        const Vector6 step = A.ldlt().solve(b);
        const double angle = step.head<3>().norm();
        if (angle > 0) T.linear() = Eigen::AngleAxisd(angle, step.head<3>() / angle) * T.linear();
        T.translation() += step.tail<3>();
        if (step.norm() > 1e-4) continue;
        if (reach <= kSmallestReach) break;
        reach = std::max(kSmallestReach, 0.5 * reach);
    }
    return T;
}

CPose3D alignByIcp(const akimap::AkiMap& map, const Cloud& scan, const CPose3D& start) {
    mrpt::maps::CSimplePointsMap points;
    for (const auto& p : scan.points) points.insertPoint(mrpt::math::TPoint3D(p[0], p[1], p[2]));
    mrpt::slam::CICP icp;
    icp.options.maxIterations = 200;
    icp.options.thresholdDist = 0.5;           // [m]
    icp.options.smallestThresholdDist = 0.05;  // [m]
    mrpt::slam::CICP::TReturnInfo info;
    return icp.Align3D(&map, &points, start, info)->getMeanVal();
}

/** Off by up to 0.2 m and 5 degrees, in any direction. */
CPose3D startNear(const CPose3D& truth, std::mt19937& random) {
    std::normal_distribution<double> direction;
    std::uniform_real_distribution<double> share(0, 1);
    const auto inBall = [&](double radius) {
        const Eigen::Vector3d v(direction(random), direction(random), direction(random));
        return Eigen::Vector3d(v.normalized() * radius * std::cbrt(share(random)));
    };
    const Eigen::Vector3d t = inBall(0.2), turn = inBall(5 * M_PI / 180);
    const Eigen::AngleAxisd R(turn.norm(), turn.normalized());
    return truth + CPose3D(mrpt::math::CMatrixDouble33(R.toRotationMatrix()),
                           mrpt::math::CMatrixDouble31(t));
}

/** How far the found poses are from the truth. */
class Tally {
 public:
    void add(const CPose3D& found, const CPose3D& truth) {
        errors_.push_back((found - truth).norm());
    }
    [[nodiscard]] long converged() const {
        return std::count_if(errors_.begin(), errors_.end(), [](double e) { return e < 0.02; });
    }
    void print(const char* method) {
        std::sort(errors_.begin(), errors_.end());
        std::cout << method << ": " << converged() << " of " << errors_.size()
                  << " starts end within 0.02 m of the truth; median error "
                  << errors_[errors_.size() / 2] << " m, largest " << errors_.back() << " m\n";
    }

 private:
    std::vector<double> errors_;  // [m]
};

int run(const std::string& rawlog) {
    const std::vector<Scan> drive = readDrive(rawlog);
    if (drive.size() < 4) throw std::runtime_error(rawlog + ": fewer than four scans");
    akimap::AkiMap map(0.05);
    for (std::size_t i = 0; i < drive.size(); i++)
        if (i % 4 != 3) map.insertObservation(*drive[i].observation, drive[i].truth);
    Planes planes(map);
    std::mt19937 random(1);
    Tally to_planes, to_points;
    for (std::size_t start = 0; start < 30; start++) {
        const Scan& scan = drive[4 * (start % (drive.size() / 4)) + 3];
        const Cloud cloud = cloudOf(*scan.observation);
        const CPose3D near = startNear(scan.truth, random);
        const Eigen::Isometry3d T(
            near.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen());
        const Eigen::Isometry3d found = alignToPlanes(planes, cloud, T);
        to_planes.add(CPose3D(mrpt::math::CMatrixDouble44(found.matrix())), scan.truth);
        to_points.add(alignByIcp(map, cloud, near), scan.truth);
    }
    to_planes.print("point to plane");
    to_points.print("point to point");
    return to_planes.converged() >= to_points.converged() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: align_point_to_plane DRIVE.rawlog\n";
        return 2;
    }
    try {
        return run(argv[1]);
    } catch (const std::exception& e) {
        std::cerr << "align_point_to_plane: " << e.what() << "\n";
        return 1;
    }
}
