// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/clouds/PointFields.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <stdexcept>

namespace akimap::app {

namespace {

std::string lowerCase(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/** The first field with one of these names, in the names' order. */
std::optional<std::size_t> find(const std::vector<PointField>& fields,
                                const std::vector<std::string>& names) {
    for (const std::string& name : names)
        for (std::size_t i = 0; i < fields.size(); i++)
            if (lowerCase(fields[i].name) == name && fields[i].count == 1) return i;
    return std::nullopt;
}

template <class T>
double load(const std::array<uint8_t, 8>& bytes) {
    T value{};
    std::memcpy(&value, bytes.data(), sizeof value);
    return static_cast<double>(value);
}

}  // namespace

FieldRoles rolesOf(const std::vector<PointField>& fields) {
    FieldRoles roles;
    const std::array<std::string, 3> axes{"x", "y", "z"};
    for (std::size_t axis = 0; axis < 3; axis++) {
        std::size_t i = 0;
        while (i < fields.size() && lowerCase(fields[i].name) != axes[axis]) i++;
        if (i == fields.size()) throw std::runtime_error("no field '" + axes[axis] + "'");
        if (fields[i].type != 'F' || fields[i].size < 4 || fields[i].count != 1)
            throw std::runtime_error("field '" + axes[axis] + "' must be one F of 4 or 8 bytes");
        roles.xyz[axis] = i;
    }
    roles.intensity = find(fields, {"intensity", "i", "reflectivity", "scalar_intensity"});
    roles.time = find(fields, {"t", "time", "offset_time", "timestamp", "time_stamp"});
    return roles;
}

CloudFiller::CloudFiller(const std::vector<PointField>& fields, std::size_t points)
    : fields_(fields), roles_(rolesOf(fields)) {
    // A damaged header may claim any number.
    cloud_.points.reserve(std::min<std::size_t>(points, 1u << 20));
    // Drivers that write whole numbers (Ouster's t, Livox's offset_time) count nanoseconds.
    if (roles_.time && fields[*roles_.time].type != 'F') time_unit_ = 1e-9;
}

double numberAt(const uint8_t* bytes, const PointField& field, bool big_endian) {
    std::array<uint8_t, 8> raw{};
    std::memcpy(raw.data(), bytes, field.size);
    if (big_endian)
        std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(field.size));
    switch (field.type) {
        case 'F':
            return field.size == 8 ? load<double>(raw) : load<float>(raw);
        case 'U':
            return load<uint64_t>(raw);  // the bytes above are zero
        default:
            break;
    }
    switch (field.size) {
        case 1:
            return load<int8_t>(raw);
        case 2:
            return load<int16_t>(raw);
        case 4:
            return load<int32_t>(raw);
        default:
            return load<int64_t>(raw);
    }
}

}  // namespace akimap::app
