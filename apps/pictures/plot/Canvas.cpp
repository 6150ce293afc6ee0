// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "pictures/plot/Canvas.h"

#include <cairo-svg.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "pictures/cairo_bytes.h"

namespace akimap::app {

namespace {

constexpr double kPixelsPerPoint = 2;

}  // namespace

Canvas::Canvas(Format format, double width, double height) : format_(format) {
    if (format == Format::svg) {
        surface_ = cairo_svg_surface_create_for_stream(append, &bytes_, width, height);
    } else {
        const auto pixels = [](double points) {
            return static_cast<int>(std::lround(points * kPixelsPerPoint));
        };
        surface_ = cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels(width), pixels(height));
        cairo_surface_set_device_scale(surface_, kPixelsPerPoint, kPixelsPerPoint);
    }
    cairo_ = cairo_create(surface_);
    fill({0, 0, width, height}, {1, 1, 1});
}

Canvas::~Canvas() {
    cairo_destroy(cairo_);
    cairo_surface_destroy(surface_);
}

void Canvas::stroke(const Stroke& stroke) {
    cairo_set_source_rgb(cairo_, stroke.color.r, stroke.color.g, stroke.color.b);
    cairo_set_line_width(cairo_, stroke.width);
    cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
    cairo_set_dash(cairo_, stroke.dashes.data(), static_cast<int>(stroke.dashes.size()), 0);
    cairo_stroke(cairo_);
}

void Canvas::line(const std::vector<Point>& points, const Stroke& how) {
    for (const Point& p : points) cairo_line_to(cairo_, p.x, p.y);
    stroke(how);
}

void Canvas::fill(const Rect& r, const Color& color, double opacity) {
    cairo_set_source_rgba(cairo_, color.r, color.g, color.b, opacity);
    cairo_rectangle(cairo_, r.left, r.top, r.width, r.height);
    cairo_fill(cairo_);
}

void Canvas::frame(const Rect& r, const Stroke& how) {
    cairo_rectangle(cairo_, r.left, r.top, r.width, r.height);
    stroke(how);
}

void Canvas::dot(Point center, double radius, const Color& color) {
    cairo_set_source_rgb(cairo_, color.r, color.g, color.b);
    cairo_arc(cairo_, center.x, center.y, radius, 0, 2 * M_PI);
    cairo_fill(cairo_);
}

void Canvas::select(const TextStyle& style) {
    cairo_select_font_face(cairo_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo_, style.size);
    cairo_set_source_rgb(cairo_, style.color.r, style.color.g, style.color.b);
}

double Canvas::textWidth(const std::string& words, const TextStyle& style) {
    select(style);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_, displayable(words).c_str(), &extents);
    return extents.x_advance;
}

void Canvas::text(Point at, const std::string& words, const TextStyle& style) {
    const double width = textWidth(words, style);
    cairo_save(cairo_);
    cairo_translate(cairo_, at.x, at.y);
    if (style.upwards) cairo_rotate(cairo_, -M_PI / 2);
    cairo_move_to(cairo_, -style.anchor * width, 0);
    cairo_show_text(cairo_, displayable(words).c_str());
    cairo_restore(cairo_);
    cairo_new_path(cairo_);
}

void Canvas::clip(const Rect& r) {
    cairo_save(cairo_);
    cairo_rectangle(cairo_, r.left, r.top, r.width, r.height);
    cairo_clip(cairo_);
}

void Canvas::unclip() {
    cairo_restore(cairo_);
}

std::string Canvas::finish() {
    check(cairo_status(cairo_));
    if (format_ == Format::png) check(cairo_surface_write_to_png_stream(surface_, append, &bytes_));
    cairo_surface_finish(surface_);
    check(cairo_surface_status(surface_));
    return std::move(bytes_);
}

std::string displayable(const std::string& text) {
    using nlohmann::json;  // which knows what UTF-8 is
    auto clean = json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace))
                     .get<std::string>();
    for (char& c : clean)
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
    return clean;
}

}  // namespace akimap::app
