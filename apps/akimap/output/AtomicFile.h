// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>
#include <vector>

namespace akimap::app {

/** A file that appears whole or not at all: write to path(), a temporary beside the target, then
 * commit() puts it in the target's place. Uncommitted, the temporary is removed and an older
 * target stays as it was. Devices and pipes (/dev/stdout) are written directly. */
class AtomicFile {
 public:
    /** Creates the (empty) temporary.
     * \exception std::runtime_error naming the target if it can't be written */
    explicit AtomicFile(const std::string& target);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /** Where to write; it ends with the target's extension, which many writers go by. */
    [[nodiscard]] const std::string& path() const { return path_; }
    /** The file the caller asked for, for error messages. */
    [[nodiscard]] const std::string& target() const { return target_; }

    /** \exception std::runtime_error naming the target */
    void commit();

    /** Throws as the constructor would, and leaves nothing behind: for asking before long work.
     * \exception std::runtime_error naming the target */
    static void checkWritable(const std::string& target);

 private:
    std::string target_;
    std::string destination_;  // the target behind symbolic links
    std::string path_;
    bool pending_ = false;  // a temporary is there to be renamed or removed
};

/** Before long work: all outputs can be written, none is named twice or is one of the files read.
 * Empty names stand for files not asked for.
 * \exception std::runtime_error naming the output */
void checkOutputs(const std::vector<std::string>& outputs, const std::vector<std::string>& read);

/** Writes a file whole or not at all. \exception std::runtime_error naming it */
void writeWhole(const std::string& target, const std::string& bytes);

}  // namespace akimap::app
