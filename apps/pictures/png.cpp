// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "pictures/png.h"

#include "pictures/cairo_bytes.h"

#include <cairo.h>

#include <cstring>
#include <memory>
#include <stdexcept>

namespace akimap::app {

std::string pngOf(const mrpt::img::CImage& image) {
    const auto width = static_cast<int>(image.getWidth());
    const auto height = static_cast<int>(image.getHeight());
    const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), cairo_surface_destroy);
    check(cairo_surface_status(surface.get()));
    const int stride = cairo_image_surface_get_stride(surface.get());
    for (int y = 0; y < height; y++) {
        const auto* from = image.ptrLine<uint8_t>(static_cast<unsigned>(y));  // blue, green, red
        unsigned char* to = cairo_image_surface_get_data(surface.get()) + y * stride;
        for (int x = 0; x < width; x++) {
            const uint32_t pixel =
                uint32_t{from[3 * x + 2]} << 16 | uint32_t{from[3 * x + 1]} << 8 | from[3 * x];
            std::memcpy(to + 4 * x, &pixel, sizeof pixel);
        }
    }
    cairo_surface_mark_dirty(surface.get());
    std::string bytes;
    check(cairo_surface_write_to_png_stream(surface.get(), append, &bytes));
    return bytes;
}

}  // namespace akimap::app
