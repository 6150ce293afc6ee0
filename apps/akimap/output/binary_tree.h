// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <octomap/OcTree.h>

#include <ostream>

namespace akimap::app {

/** Writes an OctoMap binary tree (.bt). OctoMap's own writeBinary() says "done." on stderr.
 * \param tree pruned by the caller, if that is wanted */
inline void writeBinaryTree(const octomap::OcTree& tree, std::ostream& out) {
    out.precision(12);  // six digits of 1/3 m would shift far cells
    out << "# Octomap OcTree binary file\n"
        << "# (feel free to add / change comments, but leave the first line as it is!)\n#\n"
        << "id " << tree.getTreeType() << "\nsize " << tree.size() << "\nres "
        << tree.getResolution() << "\ndata\n";
    tree.writeBinaryData(out);
}

}  // namespace akimap::app
