// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <map>
#include <string>

// A map file's options: lines of `name = value`. A reader steps over names that it does not know,
// unless they are marked by a '!' as ones that the meaning of the cells depends on.

namespace akimap {

struct NamedValue {
    std::string name, value;
    bool required = false;  ///< a reader that does not know the name must refuse the map
};

/** One line. */
[[nodiscard]] std::string lineOf(const NamedValue& v);

class NamedValues {
 public:
    /** \param section for the messages \exception CorruptMap unless each line is as lineOf() has
     * it, and no name stands twice */
    NamedValues(std::string section, const std::string& text);

    /** The value of a name, null if there is none; the name counts as known from now on. */
    [[nodiscard]] const std::string* take(const std::string& name);
    /** \exception CorruptMap naming a required name that was never taken */
    void requireNoneLeft() const;

 private:
    struct Line {
        std::string value;
        bool required = false, taken = false;
    };
    std::string section_;
    std::map<std::string, Line> lines_;
};

}  // namespace akimap
