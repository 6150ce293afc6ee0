// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "help.h"

#include <sstream>

namespace akimap::app {

namespace {

std::string broken(const std::string& text, std::size_t width) {
    std::istringstream words(text);
    std::string lines, line;
    for (std::string word; words >> word;) {
        if (!line.empty() && line.size() + 1 + word.size() > width) {
            lines += line + "\n";
            line.clear();
        }
        line += (line.empty() ? "" : " ") + word;
    }
    return lines + line;
}

}  // namespace

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
    return broken(Formatter::make_option_desc(option), kWidth - kNames);
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
    std::ostringstream out;
    CLI::detail::format_help(out, command->get_name(),
                             broken(command->get_description(), kWidth - kNames), kNames);
    return out.str();
}

void addExamples(CLI::App& command, const std::string& first, const std::string& second) {
    const std::string footer = command.get_footer();
    command.footer(footer + (footer.empty() ? "" : "\n\n") + "Examples:\n  akimap " + first +
                   "\n  akimap " + second);
}

}  // namespace akimap::app
