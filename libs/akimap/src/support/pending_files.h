// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>

// The temporary files of this process, for a program that a signal ends. What is here may be
// called by all threads at once.

namespace akimap {

/** From now on removePendingFiles() removes this file. \return for forgetPendingFile() */
[[nodiscard]] void* rememberPendingFile(const std::string& path);
void forgetPendingFile(void* registration);

/** Removes all of them; for signal handlers: async-signal-safe. */
void removePendingFiles() noexcept;

/** A signal handler: removes the pending files, and ends the process as the signal would. */
void endBySignal(int signal) noexcept;

/** Lets SIGINT, SIGTERM and SIGHUP remove the pending files before they end the process. Signals
 * that are ignored, as under nohup, stay so. */
void removePendingFilesOnSignals();

}  // namespace akimap
