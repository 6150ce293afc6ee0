// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <array>
#include <cmath>
#include <cstring>

#include "simulation/sensors.h"

namespace akimap::app {

using mrpt::math::TVector3D;
using mrpt::obs::CObservationVelodyneScan;
using mrpt::poses::CPose3D;

namespace {

// VLP-16, from its manual: a block holds two firings of all lasers, a packet 12 blocks.
constexpr int kLasers = 16, kFirings = 2;
constexpr int kBlocks = CObservationVelodyneScan::BLOCKS_PER_PACKET;
constexpr double kBlockMicroseconds = 110.592, kFiringMicroseconds = 55.296;
constexpr double kLaserMicroseconds = 2.304;
constexpr int kTurnUnits = CObservationVelodyneScan::ROTATION_MAX_UNITS;  // 0.01 deg each
constexpr double kDistanceUnit = 0.002;                                   // [m]

constexpr int kPackets = 75;  // one turn in 99.5 ms
constexpr int kBlockTurn = kTurnUnits / (kPackets * kBlocks);
// While driving, the truth is seen from one place for each few packets (16 mm of travel).
constexpr int kSectors = 25;

constexpr double kUnitAngle = 2 * M_PI / kTurnUnits;

/** The payload of a data packet, as it comes from the network. */
class PacketWriter {
 public:
    void setBlock(int block, int azimuth) {
        put16(blockAt(block), CObservationVelodyneScan::UPPER_BANK);
        put16(blockAt(block) + 2, azimuth);
    }
    void setReturn(int block, int index, long distance) {
        constexpr uint8_t kIntensity = 100;
        const std::size_t at = blockAt(block) + 4 + 3 * static_cast<std::size_t>(index);
        put16(at, static_cast<int>(distance));
        bytes_[at + 2] = kIntensity;
    }
    void setTail(uint32_t microseconds_of_hour) {
        constexpr uint8_t kModelVlp16 = 0x22;
        const std::size_t tail = blockAt(kBlocks);
        put16(tail, static_cast<int>(microseconds_of_hour & 0xffff));
        put16(tail + 2, static_cast<int>(microseconds_of_hour >> 16));
        bytes_[tail + 4] = CObservationVelodyneScan::RETMODE_STRONGEST;
        bytes_[tail + 5] = kModelVlp16;
    }
    [[nodiscard]] CObservationVelodyneScan::TVelodyneRawPacket packet() const {
        CObservationVelodyneScan::TVelodyneRawPacket packet;
        static_assert(sizeof(packet) == CObservationVelodyneScan::PACKET_SIZE);
        std::memcpy(static_cast<void*>(&packet), bytes_.data(), bytes_.size());
        return packet;
    }

 private:
    static std::size_t blockAt(int block) {
        return static_cast<std::size_t>(block * CObservationVelodyneScan::SIZE_BLOCK);
    }
    void put16(std::size_t at, int value) {  // little-endian
        bytes_[at] = static_cast<uint8_t>(value & 0xff);
        bytes_[at + 1] = static_cast<uint8_t>(value >> 8 & 0xff);
    }

    std::array<uint8_t, CObservationVelodyneScan::PACKET_SIZE> bytes_{};
};

/** Where one laser points: the head turns on from the block's azimuth until it fires. Azimuths
 * count clockwise as seen from above. */
TVector3D laserDirection(int block_azimuth, int firing, int laser,
                         const mrpt::obs::VelodyneCalibration::PerLaserCalib& calibration) {
    const double wait = laser * kLaserMicroseconds + firing * kFiringMicroseconds;
    const double angle = -kUnitAngle * (block_azimuth + kBlockTurn * wait / kBlockMicroseconds);
    const double cosine = calibration.cosVertCorrection, sine = calibration.sinVertCorrection;
    return {cosine * std::cos(angle), cosine * std::sin(angle), sine};
}

CObservationVelodyneScan::Ptr makeObservation(const SensorModel& lidar, const World& world,
                                              double time) {
    auto obs = CObservationVelodyneScan::Create();
    obs->sensorLabel = "VELODYNE";
    obs->timestamp = obs->originalReceivedTimestamp = mrpt::Clock::fromDouble(time);
    constexpr double kDegree = M_PI / 180;
    obs->sensorPose = {0.2, 0.05, 0.7, 3 * kDegree, 2 * kDegree, -1 * kDegree};
    obs->calibration = mrpt::obs::VelodyneCalibration::LoadDefaultCalibration("VLP16");
    obs->minRange = lidar.min_range;
    obs->maxRange = world.max_range;
    return obs;
}

/** Fills one block; MRPT decodes only its first firing, so only that one gives rays. */
void fireBlock(const World& world, const CObservationVelodyneScan& obs, const CPose3D& sensor,
               int block, int azimuth, PacketWriter& packet, std::vector<Ray>& rays,
               Random& random) {
    for (int firing = 0; firing < kFirings; firing++)
        for (int laser = 0; laser < kLasers; laser++) {
            const TVector3D direction =
                laserDirection(azimuth, firing, laser,
                               obs.calibration.laser_corrections[static_cast<std::size_t>(laser)]);
            const auto range =
                measureRange(world, sensor.translation(), sensor.rotateVector(direction),
                             obs.minRange, random, 1, static_cast<std::size_t>(laser));
            if (!range) continue;
            const long units = std::lround(*range / kDistanceUnit);
            packet.setReturn(block, firing * kLasers + laser, units);
            if (firing == 0)
                rays.push_back(
                    rayTo(sensor, direction * (static_cast<double>(units) * kDistanceUnit)));
        }
}

void addViews(const World& world, const CObservationVelodyneScan& obs, double time,
              int first_azimuth, SimulatedScan& scan) {
    constexpr double kTop = 15 * M_PI / 180;  // [rad] of the highest laser, and the lowest below
    const int sectors = world.moving ? kSectors : 1;
    const double revolution = 1e-6 * kPackets * kBlocks * kBlockMicroseconds;
    for (int i = 0; i < sectors; i++) {
        const double turned = (i + 0.5) / sectors;
        const double azimuth = -(first_azimuth * kUnitAngle + 2 * M_PI * turned);
        const double seen_at = world.moving ? time + turned * revolution : time;
        scan.views.push_back({world.trajectory.at(seen_at) + obs.sensorPose,
                              FieldOfView::band(azimuth, M_PI / sectors, -kTop, kTop), obs.minRange,
                              world.max_range});
    }
}

}  // namespace

SimulatedScan takeVelodyneScan(const SensorModel& lidar, const World& world, double time,
                               Random& random) {
    const auto obs = makeObservation(lidar, world, time);
    SimulatedScan scan{obs, time, world.trajectory.at(time), {}, {}};
    const int first_azimuth = static_cast<int>(random.uniform(0, kTurnUnits));
    const auto time_of_hour = static_cast<uint32_t>(std::lround(std::fmod(time, 3600) * 1e6));
    for (int i = 0; i < kPackets; i++) {
        // MRPT gives all points of a packet the time of its first firing.
        const auto passed = static_cast<uint32_t>(std::lround(i * kBlocks * kBlockMicroseconds));
        const CPose3D sensor = world.trajectory.at(time + 1e-6 * passed) + obs->sensorPose;
        PacketWriter packet;
        packet.setTail(static_cast<uint32_t>((time_of_hour + passed) % 3'600'000'000ULL));
        for (int block = 0; block < kBlocks; block++) {
            const int azimuth = (first_azimuth + (i * kBlocks + block) * kBlockTurn) % kTurnUnits;
            packet.setBlock(block, azimuth);
            if (block % lidar.filled_every == 0)
                fireBlock(world, *obs, sensor, block, azimuth, packet, scan.rays, random);
        }
        obs->scan_packets.push_back(packet.packet());
    }
    addViews(world, *obs, time, first_azimuth, scan);
    return scan;
}

}  // namespace akimap::app
