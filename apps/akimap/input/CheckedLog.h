// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/rtti/CObject.h>

#include <string>

#include "input/external_files.h"

namespace akimap::app {

/** A log of MRPT's objects that can be read without harm. Some of MRPT's classes crash on damaged
 * data, or take gigabytes for a few bytes that claim so; so the log is read once to its end in a
 * process of its own, of bounded memory, and taken only if that lived. Whatever is wrong with it,
 * the checksum of a gz log first of all, is found before this process makes an object of it.
 * No help against a log that is changed after that. */
class CheckedLog {
 public:
    /** Takes as long as reading the log does. What is cut at its end passes: a reader tells.
     * \exception std::runtime_error naming the file, and the object where it can */
    CheckedLog(const std::string& file, ExternalFiles external_files);

    [[nodiscard]] const std::string& file() const { return file_; }

 private:
    std::string file_;
};

/** Of an object that was read: nothing in it is missing that MRPT takes to be there, and
 * checkExternalFiles(). \exception std::runtime_error without the file's name */
void checkObject(const mrpt::rtti::CObject& object, const std::string& log_file,
                 ExternalFiles external_files);

}  // namespace akimap::app
