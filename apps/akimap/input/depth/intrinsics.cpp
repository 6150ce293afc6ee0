// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/depth/intrinsics.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "input/ini.h"
#include "input/numbers.h"

namespace akimap::app {

namespace {

/** Open3D writes the matrix column by column. */
std::vector<double> numbersOfJson(const std::string& text) {
    const auto m = nlohmann::json::parse(text).at("intrinsic_matrix").get<std::vector<double>>();
    if (m.size() != 9) throw std::runtime_error("intrinsic_matrix must have 9 numbers");
    return {m[0], m[4], m[6], m[7]};
}

Intrinsics fromNumbers(const std::vector<double>& v) {
    Intrinsics camera;
    if (v.size() == 4)
        camera = {v[0], v[1], v[2], v[3]};
    else if (v.size() == 9 && v[6] == 0 && v[7] == 0 && v[8] == 1)
        camera = {v[0], v[4], v[2], v[5]};
    else
        throw std::runtime_error("expected fx,fy,cx,cy [pixels] or a 3 x 3 matrix, and found " +
                                 std::to_string(v.size()) + " numbers");
    if (camera.fx < 1 || camera.fy < 1 || camera.cx <= 0 || camera.cy <= 0)
        throw std::runtime_error("fx, fy, cx and cy must be in pixels, and positive");
    return camera;
}

}  // namespace

Intrinsics readIntrinsics(const std::string& text) {
    const bool is_text = text.find_first_not_of("0123456789+-.eE, ") == std::string::npos &&
                         !std::filesystem::exists(text);
    try {
        if (is_text) return fromNumbers(finiteNumbersOf(text));
        const std::string content = textOf(text);
        const bool is_json = std::filesystem::path(text).extension() == ".json";
        return fromNumbers(is_json ? numbersOfJson(content) : finiteNumbersOf(content));
    } catch (const std::exception& e) {
        const std::string what = e.what();
        throw std::runtime_error("--intrinsics: " +
                                 (is_text || what.find(text) == 0 ? what : text + ": " + what));
    }
}

}  // namespace akimap::app
