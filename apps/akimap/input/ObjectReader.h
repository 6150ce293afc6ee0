// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "input/ByteSource.h"
#include "input/CheckedLog.h"

namespace akimap::app {

/** The file ends inside an object, or its gz stream does: its writer crashed, or a copy stopped. */
struct CutFile : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/** The bytes of a file that is there, plain or gz.
 * \exception std::runtime_error naming it if it can't be read */
[[nodiscard]] std::unique_ptr<ByteSource> wholeFile(const std::string& file);

/** Reads serialized MRPT objects one by one from a plain or gz file, and tells a clean end from a
 * cut one, which MRPT's own end-of-file exception does not. */
class ObjectReader {
 public:
    /** \exception std::runtime_error naming the file if it can't be read */
    explicit ObjectReader(const CheckedLog& log);
    /** Reads the file's bytes, unchecked, from `source`, whose end is taken for the file's. */
    ObjectReader(const std::string& file, std::unique_ptr<ByteSource> source);
    ~ObjectReader();

    /** The next object; null at a clean end.
     * \exception CutFile \exception std::runtime_error if the file is damaged or no MRPT file;
     *  both name the file and the object; no further object can be read then */
    mrpt::serialization::CSerializable::Ptr next();

    [[nodiscard]] std::size_t objectsRead() const { return objects_; }

 private:
    class Stream;

    [[noreturn]] void refuse(const std::string& what) const;

    std::string file_;
    std::unique_ptr<Stream> stream_;
    std::size_t objects_ = 0;
};

}  // namespace akimap::app
