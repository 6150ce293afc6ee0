// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "errors.h"

namespace akimap::app {

namespace {

/** The text behind the last `mark` and before the next `end`; all of it if there is no mark. */
std::string between(const std::string& text, const std::string& mark, const std::string& end) {
    const auto at = text.rfind(mark);
    if (at == std::string::npos) return text;
    const std::string rest = text.substr(at + mark.size());
    return rest.substr(0, rest.find(end));
}

std::string oneLine(const std::string& text) {
    std::string line;
    bool is_blank = true;  // at the start, or behind a blank
    for (const char c : text) {
        const bool blank = c == '\n' || c == '\r' || c == ' ';
        if (!(blank && is_blank)) line += blank ? ' ' : c;
        is_blank = blank;
    }
    while (!line.empty() && line.back() == ' ') line.pop_back();
    return line;
}

}  // namespace

std::string reasonOf(std::string what) {
    what = between(what, "Original exception:\n", std::string(1, '\0'));
    if (what.find("Call stack backtrace:") == std::string::npos) return oneLine(what);
    if (what.find("Message:") == std::string::npos)  // of an exception that MRPT only passed on
        return oneLine(between(what, "MRPT exception ====\n", "\nCall stack"));
    const std::string message = oneLine(between(what, "Message:", "\nLocation:"));
    return message.empty() ? oneLine(between(what, "\nLocation:", "\n")) : message;
}

}  // namespace akimap::app
