// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <cstdlib>
#include <cstring>

/** What was read can be written, and reads back the same. */
inline void requireSameAfterReload(const akimap::AkiMap& map) {
    mrpt::io::CMemoryStream first, second;
    mrpt::serialization::archiveFrom(first) << map;
    first.Seek(0);
    akimap::AkiMap again;
    mrpt::serialization::archiveFrom(first) >> again;
    mrpt::serialization::archiveFrom(second) << again;
    const auto size = first.getTotalBytesCount();
    if (size != second.getTotalBytesCount() ||
        std::memcmp(first.getRawBufferData(), second.getRawBufferData(), size) != 0)
        std::abort();
}
