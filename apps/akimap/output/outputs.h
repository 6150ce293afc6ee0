// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace akimap::app {

/** Before long work: all outputs can be written, none is named twice or is one of the files read.
 * Empty names stand for files not asked for.
 * \exception std::runtime_error naming the output */
void checkOutputs(const std::vector<std::string>& outputs, const std::vector<std::string>& read);

/** Does the work; of what it throws, the reason goes to the JSON file too, as "error", for scripts.
 * \param json empty: none. \param others the inputs and other outputs, which it must not replace */
void withErrorsInJson(const std::string& json, const std::vector<std::string>& others,
                      const std::function<void()>& work);

}  // namespace akimap::app
