// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "support/AtomicFile.h"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "support/Descriptor.h"
#include "support/pending_files.h"

namespace fs = std::filesystem;

namespace akimap {
namespace {

/** Beside a file: a name that nobody can guess, short whatever the file's own is. */
std::string temporaryBeside(const fs::path& file) {
    constexpr char kLetters[] = "abcdefghijklmnopqrstuvwxyz234567";
    std::array<unsigned char, 16> random{};
    if (getrandom(random.data(), random.size(), 0) != static_cast<ssize_t>(random.size()))
        throw std::runtime_error("the system gives no random numbers");
    std::string name = ".akimap-";
    for (const unsigned char r : random) name += kLetters[r % 32];
    const std::string extension = file.extension().string();
    if (extension.size() <= 16) name += extension;
    return (file.parent_path() / name).string();
}

/** Gives a new file the mode and, where the system allows it, the owner of the one it will
 * replace. A group that it may not have must not get what was another group's. */
bool takeOver(int file, const struct stat& older) {
    mode_t mode = older.st_mode & 07777;
    const auto nobody = static_cast<uid_t>(-1);
    if (fchown(file, older.st_uid, older.st_gid) != 0 && fchown(file, nobody, older.st_gid) != 0)
        mode = (mode & ~07070u) | (mode & 07u) << 3;
    return fchmod(file, mode) == 0;
}

/** Whether the file's data are on the disk, where its file system can tell. */
bool flush(const std::string& path, int flags) {
    const Descriptor file(open(path.c_str(), flags | O_NOFOLLOW | O_CLOEXEC));
    return file.isOpen() && (fsync(file.number()) == 0 || errno == EINVAL || errno == ENOTSUP);
}

/** The file behind symbolic links, whether it is there or not. */
std::string behindLinks(const std::string& target) {
    fs::path file = target;
    std::error_code error;
    for (int links = 0; links < 40 && fs::is_symlink(file, error); links++) {
        const fs::path next = fs::read_symlink(file, error);
        if (error) throwCannotWrite(target, error.message());
        file = next.is_absolute() ? next : file.parent_path() / next;
    }
    return file.string();
}

}  // namespace

void throwCannotWrite(const std::string& target, const std::string& why) {
    throw std::runtime_error("cannot write '" + target + "': " + why);
}

AtomicFile::AtomicFile(const std::string& target) : target_(target) {
    const auto refuse = [&] { throwCannotWrite(target, std::strerror(errno)); };
    if (target.empty()) throwCannotWrite(target, "the file has no name");
    struct stat older {};
    const bool is_there = stat(target.c_str(), &older) == 0;
    if (!is_there && errno != ENOENT) refuse();
    if (is_there && S_ISDIR(older.st_mode)) throwCannotWrite(target, "it is a folder");
    if (is_there && access(target.c_str(), W_OK) != 0) refuse();
    // /dev/stdout may be a regular file, of which others hold the end.
    const auto isIn = [&](const char* place) { return target.rfind(place, 0) == 0; };
    const bool is_stream = isIn("/dev/std") || isIn("/dev/fd/") || isIn("/proc/");
    if (is_there && (is_stream || !S_ISREG(older.st_mode))) {
        path_ = target;
        return;
    }
    destination_ = behindLinks(target);
    createTemporary();
}

void AtomicFile::createTemporary() {
    struct stat older {};
    const bool is_there = stat(destination_.c_str(), &older) == 0;
    path_ = temporaryBeside(destination_);  // all that needs memory comes before the file is there
    registration_ = rememberPendingFile(path_);
    const Descriptor file(open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC,
                               is_there ? 0600 : 0666));
    if (file.isOpen() && (!is_there || takeOver(file.number(), older))) return;
    const int error = errno;
    if (!file.isOpen()) path_.clear();  // whatever has that name is not ours
    remove();
    throwCannotWrite(target_, std::strerror(error));
}

void AtomicFile::remove() {
    if (!registration_) return;
    if (!path_.empty()) unlink(path_.c_str());
    forgetPendingFile(registration_);
    registration_ = nullptr;
}

AtomicFile::~AtomicFile() {
    remove();
}

void AtomicFile::commit() {
    if (!registration_) return;
    const std::string folder = fs::path(destination_).parent_path() / ".";
    if (!flush(path_, O_WRONLY) || std::rename(path_.c_str(), destination_.c_str()) != 0)
        throwCannotWrite(target_, std::strerror(errno));
    forgetPendingFile(registration_);
    registration_ = nullptr;
    // The file is in its place: that its folder can't be flushed, as one without the right to be
    // read, is no failure.
    flush(folder, O_RDONLY | O_DIRECTORY);
}

void AtomicFile::checkWritable(const std::string& target) {
    const AtomicFile probe(target);
}

void writeWhole(const std::string& target, const std::string& bytes) {
    writeAtomically(target, [&](const std::string& path) {
        Descriptor out(open(path.c_str(), O_WRONLY | O_CLOEXEC));
        const auto require = [](bool ok) {
            if (!ok) throw std::runtime_error(std::strerror(errno));
        };
        require(out.isOpen());
        for (std::size_t at = 0; at < bytes.size();) {
            const ssize_t n = write(out.number(), bytes.data() + at, bytes.size() - at);
            require(n >= 0 || errno == EINTR);
            if (n > 0) at += static_cast<std::size_t>(n);
        }
        require(out.close());
    });
}

}  // namespace akimap
