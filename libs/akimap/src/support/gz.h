// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

struct gzFile_s;

// gz files that tell what went wrong, which MRPT's do not: a full disk, a cut or damaged file.
// Both have what mrpt::serialization::archiveFrom() needs of a stream. All throw
// std::runtime_error with the reason, without the file's name.

namespace akimap {

class GzWriter {
 public:
    /** Truncates the file, which may be a pipe.
     * \param failure gets the reason of what is thrown, which MRPT wraps in banners */
    GzWriter(const std::string& path, std::string& failure);
    ~GzWriter();
    GzWriter(const GzWriter&) = delete;
    GzWriter& operator=(const GzWriter&) = delete;

    std::size_t Write(const void* bytes, std::size_t size);
    /** Writes what is left: without it the file is not whole. */
    void close();

    std::size_t Read(void* bytes, std::size_t size);
    [[nodiscard]] std::string getStreamDescription() const { return "a gz file"; }

 private:
    [[noreturn]] void fail(int zlib_error);

    std::string& failure_;
    gzFile_s* file_;
};

/** Calls write(GzWriter&) on a file, and closes it. What is thrown has the reason and nothing else.
 */
template <class Write>
void writeGz(const std::string& path, Write&& write) {
    std::string failure;
    try {
        GzWriter gz(path, failure);
        write(gz);
        gz.close();
    } catch (const std::exception&) {
        if (failure.empty()) throw;
        throw std::runtime_error(failure);
    }
}

/** Reads gz files, of one member or several, and other files as they are. */
class GzReader {
 public:
    explicit GzReader(const std::string& path);
    ~GzReader();
    GzReader(const GzReader&) = delete;
    GzReader& operator=(const GzReader&) = delete;

    /** \return fewer bytes at the end only, be the file whole or cut */
    std::size_t readSome(void* bytes, std::size_t size);
    /** All of the bytes; throws if there are fewer. */
    std::size_t Read(void* bytes, std::size_t size);
    /** Whether the end that was met is that of a cut gz file. */
    [[nodiscard]] bool isCut() const;

    std::size_t Write(const void* bytes, std::size_t size);
    [[nodiscard]] std::string getStreamDescription() const { return "a gz file"; }

 private:
    class Inflater;
    std::unique_ptr<Inflater> inflater_;
};

}  // namespace akimap
