// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/natural_order.h"

#include <cctype>
#include <filesystem>

namespace akimap::app {

namespace {

bool isDigit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/** The digits from `at` on, without leading zeros; moves `at` behind them. */
std::string takeDigits(const std::string& text, std::size_t& at) {
    while (at < text.size() && text[at] == '0') at++;
    const std::size_t begin = at;
    while (at < text.size() && isDigit(text[at])) at++;
    return text.substr(begin, at - begin);
}

}  // namespace

bool naturallyBefore(const std::string& a, const std::string& b) {
    std::size_t i = 0, j = 0;
    while (i < a.size() && j < b.size()) {
        if (isDigit(a[i]) && isDigit(b[j])) {
            const std::string x = takeDigits(a, i), y = takeDigits(b, j);
            if (x.size() != y.size()) return x.size() < y.size();
            if (x != y) return x < y;
        } else if (a[i] != b[j]) {
            return a[i] < b[j];
        } else {
            i++, j++;
        }
    }
    if (i == a.size() && j == b.size()) return a < b;  // 01 and 1
    return i == a.size();
}

std::string frameName(const std::string& file) {
    const std::string name = std::filesystem::path(file).filename().string();
    for (std::size_t i = 1; i < name.size(); i++) {
        const bool parts_digits =
            i + 1 < name.size() && isDigit(name[i - 1]) && isDigit(name[i + 1]);
        if (name[i] == '.' && !parts_digits) return name.substr(0, i);
    }
    return name;
}

std::string lastNumber(const std::string& text) {
    std::size_t end = text.size();
    while (end > 0 && !isDigit(text[end - 1])) end--;
    std::size_t begin = end;
    bool has_point = false;
    while (begin > 0) {
        const char c = text[begin - 1];
        const bool is_point = c == '.' && !has_point && begin > 1 && isDigit(text[begin - 2]);
        if (!isDigit(c) && !is_point) break;
        has_point |= is_point;
        begin--;
    }
    return text.substr(begin, end - begin);
}

}  // namespace akimap::app
