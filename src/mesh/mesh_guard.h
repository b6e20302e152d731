#pragma once

#include <string>

namespace pounding {

/// Receives the deed of a denied call: "write to '/tmp/x'".
using Denied = void (*)(const std::string& deed);

/// Guard of a process.
enum class Guard { none, seccomp, seccomp_and_landlock };

/// Forbids this process, for the rest of its life, to start programs, to open, make, change or
/// remove files, to open network connections and to meddle with other processes; it may read files,
/// write to descriptors that are open, and start threads. The kernel's filter of calls (seccomp)
/// hands a denied call to `denied`, and ends the process by SIGSYS where no handler can run (glibc
/// blocks all signals while it starts a program). The kernel's Landlock, where there is one, denies
/// the same for all files once more. Part of the program pounding-mesh only.
Guard guard_process(Denied denied);

/// Ends a guarded process as a denied call does.
[[noreturn]] void deny(const std::string& deed);

}  // namespace pounding
