// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// SLAM by a particle filter with 3D scans, as rbpf-slam does it: what a particle with a map of its
// own costs, AkiMap against COctoMap. Each filter runs in a process of its own, whose peak memory
// and CPU time, of all cores, are measured. Quote the ratios of the times: they are from one run.

#include <akimap/AkiMap.h>
#include <fcntl.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/random/RandomGenerators.h>
#include <mrpt/slam/CMetricMapBuilderRBPF.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulation/simulate.h"

using namespace akimap;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

namespace {

struct Map {
    const char *name, *ini;
};
const Map kMaps[] = {{"COctoMap", "octoMap"}, {"AkiMap", "akimap"}};

struct Step {
    mrpt::obs::CActionCollection action;
    mrpt::obs::CSensoryFrame frame;
};

/** One round through the simulated room, 12 scans. The robot is the sensor, moving in a plane:
 * COctoMap ignores sensorPose. */
std::vector<Step> drive() {
    std::vector<Step> steps;
    CPose2D last;
    for (const auto& scan : app::simulate({}).scans) {
        const auto& o = scan.rays.at(0).origin;
        const CPose3D robot(o[0], o[1], o[2], scan.robot_pose.yaw(), 0, 0);
        auto cloud = mrpt::obs::CObservationPointCloud::Create();
        cloud->timestamp = mrpt::Clock::fromDouble(scan.time);
        cloud->pointcloud = mrpt::maps::CSimplePointsMap::Create();
        for (const Ray& r : scan.rays) {
            const auto p = robot.inverseComposePoint({r.end[0], r.end[1], r.end[2]}).cast<float>();
            cloud->pointcloud->insertPointFast(p.x, p.y, p.z);
        }
        const CPose2D here(robot);
        mrpt::obs::CActionRobotMovement2D::TMotionModelOptions noise;
        noise.modelSelection = mrpt::obs::CActionRobotMovement2D::mmGaussian;
        mrpt::obs::CActionRobotMovement2D movement;
        movement.timestamp = cloud->timestamp;
        movement.computeFromOdometry(steps.empty() ? CPose2D() : here - last, noise);
        Step step;
        step.action.insert(movement);
        step.frame.insert(cloud);
        steps.push_back(step);
        last = here;
    }
    return steps;
}

mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions options(const Map& map,
                                                                unsigned particles) {
    mrpt::config::CConfigFileMemory ini;
    const std::string name = map.ini;
    ini.setContent("[map]\n" + name + "_count = 1\n[map_" + name +
                   "_00_creationOpts]\nresolution = 0.1\n");
    mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions o;
    o.insertionLinDistance = o.insertionAngDistance = 0;
    o.localizeLinDistance = o.localizeAngDistance = 0;
    o.PF_options.PF_algorithm = mrpt::bayes::CParticleFilter::pfStandardProposal;
    o.PF_options.adaptiveSampleSize = false;
    o.PF_options.sampleSize = particles;
    o.PF_options.BETA = 0.5;
    o.mapsInitializers.loadFromConfigFile(ini, "map");
    o.verbosity_level = mrpt::system::LVL_ERROR;
    return o;
}

/** Each step moves, weighs and inserts. */
void run(const std::vector<Step>& steps, const Map& map, unsigned particles) {
    mrpt::random::getRandomGenerator().randomize(1);
    mrpt::slam::CMetricMapBuilderRBPF filter(options(map, particles));
    filter.initialize();
    for (Step step : steps) filter.processActionObservation(step.action, step.frame);
}

[[noreturn]] void child(const std::vector<Step>& steps, const Map& map, unsigned particles) {
    const int nowhere = open("/dev/null", O_WRONLY);  // OctoMap's library tells of each copy
    dup2(nowhere, STDERR_FILENO), dup2(nowhere, STDOUT_FILENO);
    try {
        run(steps, map, particles);
        _exit(0);
    } catch (const std::exception&) {
        _exit(1);
    }
}

struct Cost {
    double seconds = 0;    ///< of all cores, a step
    double megabytes = 0;  ///< peak resident memory
};

double seconds(const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

Cost measured(const std::vector<Step>& steps, const Map& map, unsigned particles) {
    const pid_t process = fork();
    if (process < 0) throw std::runtime_error("no process to be had");
    if (process == 0) child(steps, map, particles);
    int status = 0;
    struct rusage usage {};
    wait4(process, &status, 0, &usage);
    if (status != 0)
        throw std::runtime_error(std::string("the filter with ") + map.name + " failed");
    const double all = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    return {all / static_cast<double>(steps.size()), 1e-3 * static_cast<double>(usage.ru_maxrss)};
}

Cost median(const std::vector<Step>& steps, const Map& map, unsigned particles) {
    std::vector<double> seconds, megabytes;
    for (int i = 0; i < 3; i++) {
        const Cost c = measured(steps, map, particles);
        seconds.push_back(c.seconds), megabytes.push_back(c.megabytes);
    }
    std::sort(seconds.begin(), seconds.end()), std::sort(megabytes.begin(), megabytes.end());
    return {seconds[1], megabytes[1]};
}

}  // namespace

int main() try {
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
    registerClasses();
    const auto steps = drive();
    std::printf("RBPF SLAM, %zu steps of one 3D scan each, cells of 0.1 m, medians of 3 runs\n",
                steps.size());
    std::printf("%-9s %9s %15s %22s %26s\n", "map", "particles", "peak memory", "memory a particle",
                "CPU a step and particle");
    for (const Map& map : kMaps) {
        Cost one;
        for (const unsigned particles : {1u, 5u, 20u, 50u}) {
            const Cost c = median(steps, map, particles);
            if (particles == 1) one = c;
            const std::string memory =
                particles == 1 ? "-"
                               : std::to_string((c.megabytes - one.megabytes) / (particles - 1));
            std::printf("%-9s %9u %12.1f MB %19.5s MB %23.2f ms\n", map.name, particles,
                        c.megabytes, memory.c_str(), 1e3 * c.seconds / particles);
        }
    }
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_particles: %s\n", e.what());
    return 1;
}
