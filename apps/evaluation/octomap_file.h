// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <octomap/OcTree.h>

#include <cstdint>
#include <istream>
#include <memory>
#include <string>

namespace akimap::app {

/** Every OctoMap tree is so deep: its cells have indices from -kOctoMapHalf to kOctoMapHalf - 1. */
inline constexpr int kOctoMapDepth = 16;
inline constexpr int32_t kOctoMapHalf = 1 << (kOctoMapDepth - 1);

/** What stands above the nodes of an OctoMap file. */
struct OctoMapHeader {
    std::string id;         ///< kind of tree; empty: this is no such file
    uint64_t size = 0;      ///< nodes
    double resolution = 0;  ///< [m]
};

/** Reads up to the line `data`.
 * \param first_line what the file starts with */
[[nodiscard]] OctoMapHeader readOctoMapHeader(std::istream& in, const std::string& first_line);

/** Whether the file's name ends in .bt or .ot. */
[[nodiscard]] bool isOctoMapFile(const std::string& file);

/** Reads a tree from a .bt (each leaf at OctoMap's clamping probabilities, 0.12 or 0.97) or a .ot.
 * Damage is found before OctoMap's readers, which recurse without bound, see it; those of whole
 * files print to stderr.
 * \exception std::runtime_error naming the file if it is missing, damaged or no such tree */
[[nodiscard]] std::unique_ptr<octomap::OcTree> readOctoMap(const std::string& file);

}  // namespace akimap::app
