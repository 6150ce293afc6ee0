// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "output/outputs.h"

#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "errors.h"
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

void withErrorsInJson(const std::string& json, const std::vector<std::string>& others,
                      const std::function<void()>& work) {
    const auto note = [&](const std::string& reason) {
        if (json.empty()) return;
        try {
            checkOutputs({json}, others);
            const nlohmann::json error{{"error", reason}};
            // A file's name in it need not be UTF-8.
            writeWhole(json,
                       error.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
        } catch (const std::exception&) {  // the first failure is the one to tell of
        }
    };
    try {
        work();
    } catch (const Interrupted&) {
        throw;
    } catch (const std::bad_alloc&) {
        note("out of memory");
        throw;
    } catch (const std::exception& e) {
        note(reasonOf(e.what()));
        throw;
    }
}

}  // namespace akimap::app
