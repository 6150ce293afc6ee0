// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <exception>
#include <new>
#include <string>

namespace akimap {

/** A file that appears whole or not at all: write to path(), a temporary beside the target, then
 * commit() puts it in the target's place. Uncommitted, the temporary is removed and an older
 * target stays as it was. An older target's mode is kept, and its owner where that is allowed;
 * not its access lists. Symbolic links are followed. Devices and pipes (/dev/stdout) are written
 * directly.
 * Several may write one target at once, in threads or programs: the last to commit wins. */
class AtomicFile {
 public:
    /** Creates the (empty) temporary.
     * \exception std::runtime_error naming the target and the system's reason */
    explicit AtomicFile(const std::string& target);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /** Where to write; it ends with the target's extension, which many writers go by. */
    [[nodiscard]] const std::string& path() const { return path_; }
    /** The file the caller asked for, for error messages. */
    [[nodiscard]] const std::string& target() const { return target_; }

    /** Returns when the file is on the disk. \exception std::runtime_error as the constructor */
    void commit();

    /** Throws as the constructor would, and leaves nothing behind: for asking before long work.
     * \exception std::runtime_error as the constructor */
    static void checkWritable(const std::string& target);

 private:
    void createTemporary();
    void remove();

    std::string target_;
    std::string destination_;  // the target behind symbolic links
    std::string path_;
    void* registration_ = nullptr;  // of a temporary that is there to be renamed or removed
};

/** "cannot write 'target': why". */
[[noreturn]] void throwCannotWrite(const std::string& target, const std::string& why);

/** Calls write(path), and puts what it wrote there in the target's place.
 * \exception std::runtime_error naming the target before what write() threw */
template <class Write>
void writeAtomically(const std::string& target, Write&& write) {
    AtomicFile file(target);
    try {
        write(file.path());
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        throwCannotWrite(target, e.what());
    }
    file.commit();
}

/** Writes a file whole or not at all. \exception std::runtime_error naming it */
void writeWhole(const std::string& target, const std::string& bytes);

}  // namespace akimap
