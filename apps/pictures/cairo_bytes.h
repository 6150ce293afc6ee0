// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cairo.h>

#include <stdexcept>
#include <string>

namespace akimap::app {

/** A cairo_write_func_t: appends to the std::string that `bytes` points to. */
inline cairo_status_t append(void* bytes, const unsigned char* data, unsigned length) {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

/** \exception std::runtime_error with Cairo's reason */
inline void check(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(cairo_status_to_string(status));
}

}  // namespace akimap::app
