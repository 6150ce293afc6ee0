// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cstddef>

namespace akimap::app {

/** The bytes of a file, unpacked if it is a gz file. */
class ByteSource {
 public:
    virtual ~ByteSource() = default;

    /** Gets so many bytes; fewer only at the end.
     * \exception std::runtime_error saying, without the file's name, what is wrong with it */
    virtual size_t read(void* buffer, size_t count) = 0;
    /** Whether the end that was met is that of a cut gz file. */
    [[nodiscard]] virtual bool isCut() const { return false; }
};

}  // namespace akimap::app
