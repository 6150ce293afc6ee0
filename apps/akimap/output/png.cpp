// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <optional>
#include <stdexcept>

#include "output/formats.h"
#include "pictures/picture.h"
#include "pictures/png.h"
#include "support/stream.h"

namespace akimap::app {

void writePng(const AkiMap& map, const std::string& path, const ExportOptions& options) {
    if (map.isEmpty()) throw std::runtime_error("the map has no cell to draw");
    const MapView view = viewOf(map, options.threshold);
    std::optional<Viewpoint> viewpoint;
    if (view.cells.occupied.size() > 0) viewpoint = chooseViewpoint(view, options);
    std::ofstream out = openForWriting(path);
    writeBytes(out, pngOf(draw(view, viewpoint, options)));
    closeWritten(out);
}

}  // namespace akimap::app
