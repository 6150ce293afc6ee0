// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <optional>
#include <stdexcept>

#include <cerrno>
#include <cstring>

#include "output/formats.h"
#include "pictures/picture.h"

namespace akimap::app {

void writePng(const AkiMap& map, const std::string& path, const ExportOptions& options) {
    if (map.isEmpty()) throw std::runtime_error("the map has no cell to draw");
    const MapView view = viewOf(map, options.threshold);
    std::optional<Viewpoint> viewpoint;
    if (view.cells.occupied.size() > 0) viewpoint = chooseViewpoint(view, options);
    const auto picture = draw(view, viewpoint, options);
    errno = 0;
    if (!picture.saveToFile(path))
        throw std::runtime_error(errno ? std::strerror(errno) : "the picture could not be written");
}

}  // namespace akimap::app
