// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "input/clouds/Cloud.h"

namespace akimap::app {

/** A number that each point of a file has. */
struct PointField {
    std::string name;
    std::size_t size = 4;    ///< [bytes] of one element: 1, 2, 4 or 8
    char type = 'F';         ///< I, U or F
    std::size_t count = 1;   ///< elements
    std::size_t column = 0;  ///< elements before it in a line of text
    std::size_t offset = 0;  ///< [bytes] before it in a binary point
};

/** Which of a point's fields mean something to a map. */
struct FieldRoles {
    std::array<std::size_t, 3> xyz{};
    std::optional<std::size_t> intensity, time;
};

/** \exception std::runtime_error saying which of x, y and z is missing or no number of 4 or 8 bytes
 */
[[nodiscard]] FieldRoles rolesOf(const std::vector<PointField>& fields);

/** Puts the fields' numbers, point by point, into a cloud. */
class CloudFiller {
 public:
    CloudFiller(const std::vector<PointField>& fields, std::size_t points);

    /** \param valueOf the number of a field: valueOf(const PointField&) */
    template <class ValueOf>
    void add(ValueOf&& valueOf) {
        std::array<double, 3> p{};
        for (std::size_t axis = 0; axis < 3; axis++) p[axis] = valueOf(fields_[roles_.xyz[axis]]);
        cloud_.points.push_back(p);
        if (roles_.intensity)
            cloud_.intensity.push_back(static_cast<float>(valueOf(fields_[*roles_.intensity])));
        if (roles_.time) cloud_.time.push_back(time_unit_ * valueOf(fields_[*roles_.time]));
    }
    [[nodiscard]] Cloud& cloud() { return cloud_; }

 private:
    const std::vector<PointField>& fields_;
    FieldRoles roles_;
    double time_unit_ = 1;
    Cloud cloud_;
};

/** A number of that field at `bytes`. */
[[nodiscard]] double numberAt(const uint8_t* bytes, const PointField& field,
                              bool big_endian = false);

}  // namespace akimap::app
