#pragma once

namespace pounding {

/// Receives the deed of a denied call: "write to a file or change it".
using Denied = void (*)(const char* deed);

/// Guard of a process.
enum class Guard { none, seccomp, seccomp_and_landlock };

/// Forbids this process, for the rest of its life, to start programs, to open, make, change or
/// remove files, to open network connections and to meddle with other processes and the kernel; it
/// may read files, write to descriptors that are open, and start threads. Two guards, each alone:
///
/// - the kernel's Landlock, where there is one, grants no right over any file but to read it;
/// - its filter of calls (seccomp) hands the calls of a list to `denied`, files among them for
///   kernels without Landlock, and ends the process by SIGSYS where no handler can run (glibc
///   blocks all signals while it starts a program).
///
/// Part of the program pounding-mesh only.
Guard guard_process(Denied denied);

/// The part of it that Landlock has; false without Landlock.
bool restrict_files();

}  // namespace pounding
