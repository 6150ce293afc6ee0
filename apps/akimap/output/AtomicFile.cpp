// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "output/AtomicFile.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "output/stream.h"

namespace fs = std::filesystem;

namespace akimap::app {

namespace {

[[noreturn]] void refuse(const std::string& target, const std::string& why) {
    throw std::runtime_error("cannot write '" + target + "': " + why);
}

/** Creates `<file>.tmp-<pid>[-<n>]<extension>`, never one that is already there. */
std::string createTemporary(const fs::path& file, const std::string& target) {
    const std::string stem = file.string() + ".tmp-" + std::to_string(getpid());
    for (int n = 0; n < 1000; n++) {
        const std::string name =
            stem + (n ? "-" + std::to_string(n) : "") + file.extension().string();
        const int descriptor = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0) {
            close(descriptor);
            return name;
        }
        if (errno != EEXIST) refuse(target, std::strerror(errno));
    }
    refuse(target, "too many temporary files beside it");
}

bool samePlace(const std::string& a, const std::string& b) {
    std::error_code ignored;
    const auto place = fs::weakly_canonical(a, ignored);
    return a == b || fs::equivalent(a, b, ignored) ||
           (!place.empty() && place == fs::weakly_canonical(b, ignored));
}

}  // namespace

AtomicFile::AtomicFile(const std::string& target) : target_(target) {
    if (target.empty()) refuse(target, "the file has no name");
    std::error_code error;
    fs::path destination = target;
    if (fs::is_symlink(destination, error)) {
        destination = fs::weakly_canonical(target, error);
        if (error) refuse(target, error.message());
    }
    destination_ = destination.string();

    const auto status = fs::status(destination, error);
    if (fs::is_directory(status)) refuse(target, "it is a folder");
    if (fs::exists(status) && access(destination_.c_str(), W_OK) != 0)
        refuse(target, std::strerror(errno));
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        path_ = destination_;
        return;
    }
    path_ = createTemporary(destination, target);
    pending_ = true;
}

AtomicFile::~AtomicFile() {
    if (pending_) std::remove(path_.c_str());
}

void AtomicFile::commit() {
    if (!pending_) return;
    if (std::rename(path_.c_str(), destination_.c_str()) != 0)
        refuse(target_, std::strerror(errno));
    pending_ = false;
}

void AtomicFile::checkWritable(const std::string& target) {
    const AtomicFile probe(target);
}

void checkOutputs(const std::vector<std::string>& outputs, const std::vector<std::string>& read) {
    std::vector<std::string> taken = read;
    for (const std::string& output : outputs) {
        if (output.empty()) continue;
        for (std::size_t i = 0; i < taken.size(); i++) {
            const bool is_input = i < read.size();
            const bool is_device = output.rfind("/dev/", 0) == 0;
            if (samePlace(output, taken[i]) && (is_input || !is_device))
                throw std::runtime_error(output + ": this output is " +
                                         (is_input ? "an input too" : "given twice"));
        }
        AtomicFile::checkWritable(output);
        taken.push_back(output);
    }
}

void writeWhole(const std::string& target, const std::string& bytes) {
    AtomicFile file(target);
    try {
        std::ofstream out = openForWriting(file.path());
        out << bytes;
        closeWritten(out);
    } catch (const std::exception& e) {
        refuse(target, e.what());
    }
    file.commit();
}

}  // namespace akimap::app
