// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/bags/bag_messages.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "input/clouds/PointFields.h"
#include "input/depth/depth_observation.h"

namespace akimap::app {

namespace {

std::vector<PointField> fieldsOf(const sensor_msgs::PointCloud2& message) {
    // By ROS's numbers of types, from 1.
    constexpr char kTypes[] = "?IUIUIUFF";
    constexpr std::size_t kSizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
    std::vector<PointField> fields;
    for (const auto& from : message.fields) {
        if (from.datatype < 1 || from.datatype > 8)
            throw std::runtime_error("field '" + from.name + "' is of no known type");
        PointField field;
        field.name = from.name;
        field.type = kTypes[from.datatype];
        field.size = kSizes[from.datatype];
        field.count = std::max(1u, from.count);
        field.offset = from.offset;
        if (field.offset + field.size > message.point_step)
            throw std::runtime_error("field '" + from.name + "' lies outside of its point");
        fields.push_back(field);
    }
    return fields;
}

}  // namespace

mrpt::Clock::time_point timeOf(const ros::Time& stamp) {
    return mrpt::Clock::fromDouble(static_cast<double>(stamp.sec) + 1e-9 * stamp.nsec);
}

Cloud cloudOf(const sensor_msgs::PointCloud2& message) {
    const auto fields = fieldsOf(message);
    const std::size_t width = message.width, height = message.height;
    const std::size_t row = std::max<std::size_t>(message.row_step, width * message.point_step);
    if (height > 0 && (height - 1) * row + width * message.point_step > message.data.size())
        throw std::runtime_error("a cloud of " + std::to_string(width * height) +
                                 " points has too few bytes");
    CloudFiller filler(fields, width * height);
    for (std::size_t v = 0; v < height; v++)
        for (std::size_t u = 0; u < width; u++)
            filler.add([&](const PointField& field) {
                return numberAt(&message.data[v * row + u * message.point_step + field.offset],
                                field, message.is_bigendian != 0);
            });
    return std::move(filler.cloud());
}

mrpt::obs::CObservation2DRangeScan::Ptr laserOf(const sensor_msgs::LaserScan& message) {
    const auto scan = mrpt::obs::CObservation2DRangeScan::Create();
    const std::size_t n = message.ranges.size();
    const double last =
        message.angle_min + message.angle_increment * static_cast<double>(n > 0 ? n - 1 : 0);
    // MRPT's fans are symmetric about the sensor's x axis.
    scan->sensorPose.setFromValues(0, 0, 0, (message.angle_min + last) / 2, 0, 0);
    scan->aperture = static_cast<float>(std::abs(last - message.angle_min));
    scan->rightToLeft = message.angle_increment >= 0;
    scan->maxRange = message.range_max;
    scan->timestamp = timeOf(message.header.stamp);
    scan->resizeScan(n);
    for (std::size_t i = 0; i < n; i++) {
        const float range = message.ranges[i];
        const bool is_return = range >= message.range_min && range <= message.range_max;
        scan->setScanRange(i, is_return ? range : 0);
        scan->setScanRangeValidity(i, is_return);
    }
    return scan;
}

mrpt::obs::CObservation3DRangeScan::Ptr depthOf(const sensor_msgs::Image& message,
                                                const Intrinsics& camera) {
    const bool is_float = message.encoding == "32FC1";
    if (!is_float && message.encoding != "16UC1" && message.encoding != "mono16")
        throw std::runtime_error("a depth image of encoding " + message.encoding +
                                 ", where 16UC1 [mm] and 32FC1 [m] are known");
    const std::size_t size = is_float ? 4 : 2;
    if (message.step < message.width * size ||
        message.data.size() < std::size_t{message.step} * message.height)
        throw std::runtime_error("a depth image has too few bytes");
    const auto millimetres = [&](unsigned x, unsigned y) {
        const uint8_t* at = &message.data[std::size_t{message.step} * y + x * size];
        if (!is_float) {
            uint16_t steps = 0;
            std::memcpy(&steps, at, 2);
            return steps;
        }
        float metres = 0;
        std::memcpy(&metres, at, 4);
        const bool fits = metres > 0 && metres < 65;  // NaN is no depth
        return static_cast<uint16_t>(fits ? std::lround(1000 * metres) : 0);
    };
    const auto depth = depthObservation(message.width, message.height, camera, 1e-3, millimetres);
    depth->timestamp = timeOf(message.header.stamp);
    return depth;
}

}  // namespace akimap::app
