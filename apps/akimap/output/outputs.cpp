// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "output/outputs.h"

#include <filesystem>
#include <stdexcept>

#include "support/AtomicFile.h"

namespace fs = std::filesystem;

namespace akimap::app {

namespace {

bool samePlace(const std::string& a, const std::string& b) {
    std::error_code ignored;
    const auto place = fs::weakly_canonical(a, ignored);
    return a == b || fs::equivalent(a, b, ignored) ||
           (!place.empty() && place == fs::weakly_canonical(b, ignored));
}

}  // namespace

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

}  // namespace akimap::app
