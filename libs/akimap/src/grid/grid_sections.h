// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "grid/BlockGrid.h"

#include <memory>
#include <vector>

#include "grid/sections.h"

namespace akimap {

constexpr Tag kBlocksTag = tag("BLKS");    ///< the places of the blocks
constexpr Tag kCellsTag = tag("CELL");     ///< their cells' sums
constexpr Tag kSurfacesTag = tag("SURF");  ///< what these follow from, where surfaces are near

/** Writes the sections of a grid's cells; its resolution stands elsewhere. */
void writeGrid(const WriteBytes& out, const BlockGrid& grid);

/** Reads the section's places of blocks, in their order. \exception CorruptMap */
[[nodiscard]] std::vector<BlockGrid::BlockIndex> readBlocks(SectionReader& section);
/** Reads the section's cells of these blocks into an empty grid. \exception CorruptMap */
void readCells(SectionReader& section, const std::vector<BlockGrid::BlockIndex>& blocks,
               BlockGrid& grid);
/** Reads the section's surface sums into the blocks of a grid that nobody else holds.
 * \exception CorruptMap */
void readSurfaces(SectionReader& section, const std::vector<BlockGrid::BlockIndex>& blocks,
                  BlockGrid& grid);

// What formats 1 and 2 share with the sections:

/** \exception CorruptMap unless a block can be there, behind the previous one's place (null: none)
 */
void checkPlace(const BlockGrid::BlockIndex* previous, const BlockGrid::BlockIndex& b);
/** Reads a block. \exception CorruptMap unless its sums are finite, >= 0 and not all 0 */
[[nodiscard]] std::shared_ptr<Block> readBlock(const ReadBytes& read);

}  // namespace akimap
