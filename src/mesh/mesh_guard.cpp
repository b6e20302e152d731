#include "mesh/mesh_guard.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <fcntl.h>
#include <initializer_list>
#include <linux/landlock.h>
#include <memory>
#include <sched.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

namespace pounding {
namespace {

/// A system call that is denied, in words; `path`: which of its arguments names a file, -1: none.
struct DeniedCall {
  int number;
  const char* deed;
  int path;
};

/// Calls that are denied whatever their arguments are. Numbers below 0 are of other processors.
constexpr auto denied_calls = std::to_array<DeniedCall>({
    {SCMP_SYS(execve), "start the program", 0},
    {SCMP_SYS(execveat), "start the program", 1},
    {SCMP_SYS(fork), "start a program", -1},
    {SCMP_SYS(vfork), "start a program", -1},
    {SCMP_SYS(creat), "write to", 0},
    {SCMP_SYS(truncate), "cut", 0},
    {SCMP_SYS(ftruncate), "cut a file", -1},
    {SCMP_SYS(fallocate), "write to a file", -1},
    {SCMP_SYS(unlink), "remove", 0},
    {SCMP_SYS(unlinkat), "remove", 1},
    {SCMP_SYS(rmdir), "remove", 0},
    {SCMP_SYS(rename), "rename", 0},
    {SCMP_SYS(renameat), "rename", 1},
    {SCMP_SYS(renameat2), "rename", 1},
    {SCMP_SYS(link), "link", 0},
    {SCMP_SYS(linkat), "link", 1},
    {SCMP_SYS(symlink), "link", 1},
    {SCMP_SYS(symlinkat), "link", 2},
    {SCMP_SYS(mkdir), "make the folder", 0},
    {SCMP_SYS(mkdirat), "make the folder", 1},
    {SCMP_SYS(mknod), "make", 0},
    {SCMP_SYS(mknodat), "make", 1},
    {SCMP_SYS(chmod), "change the rights of", 0},
    {SCMP_SYS(fchmod), "change the rights of a file", -1},
    {SCMP_SYS(fchmodat), "change the rights of", 1},
    {SCMP_SYS(chown), "change the owner of", 0},
    {SCMP_SYS(lchown), "change the owner of", 0},
    {SCMP_SYS(fchown), "change the owner of a file", -1},
    {SCMP_SYS(fchownat), "change the owner of", 1},
    {SCMP_SYS(utime), "change the times of", 0},
    {SCMP_SYS(utimes), "change the times of", 0},
    {SCMP_SYS(futimesat), "change the times of", 1},
    {SCMP_SYS(utimensat), "change the times of", 1},
    {SCMP_SYS(setxattr), "change the attributes of", 0},
    {SCMP_SYS(lsetxattr), "change the attributes of", 0},
    {SCMP_SYS(fsetxattr), "change the attributes of a file", -1},
    {SCMP_SYS(removexattr), "change the attributes of", 0},
    {SCMP_SYS(lremovexattr), "change the attributes of", 0},
    {SCMP_SYS(fremovexattr), "change the attributes of a file", -1},
    {SCMP_SYS(socket), "open a network connection", -1},
    {SCMP_SYS(socketpair), "open a network connection", -1},
    {SCMP_SYS(mq_open), "open a queue of messages", -1},
    {SCMP_SYS(shmget), "share memory", -1},
    {SCMP_SYS(ptrace), "meddle with another process", -1},
    {SCMP_SYS(process_vm_writev), "meddle with another process", -1},
    {SCMP_SYS(process_vm_readv), "meddle with another process", -1},
    {SCMP_SYS(pidfd_open), "meddle with another process", -1},
    {SCMP_SYS(pidfd_send_signal), "meddle with another process", -1},
    {SCMP_SYS(pidfd_getfd), "meddle with another process", -1},
    {SCMP_SYS(open_by_handle_at), "open a file by its number", -1},
    {SCMP_SYS(mount), "mount", 1},
    {SCMP_SYS(umount2), "unmount", 0},
    {SCMP_SYS(chroot), "change the root to", 0},
    {SCMP_SYS(pivot_root), "change the root to", 0},
    {SCMP_SYS(unshare), "leave its namespace", -1},
    {SCMP_SYS(setns), "leave its namespace", -1},
    {SCMP_SYS(bpf), "load a program into the kernel", -1},
    {SCMP_SYS(perf_event_open), "watch the kernel", -1},
    {SCMP_SYS(userfaultfd), "watch its memory", -1},
    {SCMP_SYS(keyctl), "use keys", -1},
    {SCMP_SYS(add_key), "use keys", -1},
    {SCMP_SYS(request_key), "use keys", -1},
});

/// Denied for some of their arguments.
constexpr auto conditional_calls = std::to_array<DeniedCall>({
    {SCMP_SYS(open), "write to", 0},
    {SCMP_SYS(openat), "write to", 1},
    {SCMP_SYS(clone), "start a program", -1},
    {SCMP_SYS(kill), "send a signal to another process", -1},
    {SCMP_SYS(tgkill), "send a signal to another process", -1},
    {SCMP_SYS(tkill), "send a signal to another process", -1},
    {SCMP_SYS(prlimit64), "meddle with another process", -1},
});

/// Calls that glibc replaces by others where the kernel does not know them: their arguments lie in
/// memory, where no filter can look.
/// The last ones are younger than the headers: fchmodat2, setxattrat, removexattrat.
constexpr auto unknown_calls = std::to_array<int>(
    {SCMP_SYS(clone3), SCMP_SYS(openat2), SCMP_SYS(io_uring_setup), 452, 463, 466});

/// Flags with which a file is written to or made.
constexpr auto writing_flags = std::to_array<int>({O_WRONLY, O_RDWR, O_CREAT, O_TRUNC});

Denied answer_denied = nullptr;

/// Argument of the call at which the process was stopped.
std::uint64_t argument(const ucontext_t& context, int number) {
#if defined(__x86_64__)
  constexpr std::array registers{REG_RDI, REG_RSI, REG_RDX};
  return static_cast<std::uint64_t>(
      context.uc_mcontext.gregs[registers[static_cast<std::size_t>(number)]]);
#elif defined(__aarch64__)
  return context.uc_mcontext.regs[number];
#else
#error "which registers hold the arguments of a system call?"
#endif
}

/// The thread is stopped in the call itself, in the midst of nothing else, so that this may do
/// anything that any other function may.
void on_denied_call(int /*signal*/, siginfo_t* info, void* context) {
  std::string deed = "make the system call " + std::to_string(info->si_syscall);
  const auto tell = [&](const auto& calls) {
    const auto call = std::ranges::find(calls, info->si_syscall, &DeniedCall::number);
    if (call == calls.end()) return;
    deed = call->deed;
    if (call->path < 0) return;
    const auto* path = reinterpret_cast<const char*>(
        argument(*static_cast<const ucontext_t*>(context), call->path));
    if (path != nullptr) deed += " '" + std::string(path) + "'";
  };
  tell(denied_calls);
  tell(conditional_calls);
  deny(deed);
}

bool filter_calls() {
  using Context = std::unique_ptr<void, void (*)(scmp_filter_ctx)>;
  const Context filter(seccomp_init(SCMP_ACT_ALLOW), seccomp_release);
  if (filter == nullptr) return false;
  bool whole = true;
  const auto forbid = [&](int call, std::initializer_list<scmp_arg_cmp> where) {
    if (call < 0) return;
    whole =
        whole && seccomp_rule_add_array(filter.get(), SCMP_ACT_TRAP, call,
                                        static_cast<unsigned>(where.size()), where.begin()) == 0;
  };
  for (const DeniedCall& call : denied_calls) forbid(call.number, {});
  for (const int flag : writing_flags) {
    const auto bits = static_cast<scmp_datum_t>(flag);
    forbid(SCMP_SYS(open), {SCMP_A1_64(SCMP_CMP_MASKED_EQ, bits, bits)});
    forbid(SCMP_SYS(openat), {SCMP_A2_64(SCMP_CMP_MASKED_EQ, bits, bits)});
  }
  forbid(SCMP_SYS(clone), {SCMP_A0_64(SCMP_CMP_MASKED_EQ, CLONE_THREAD, 0)});
  const auto own = static_cast<scmp_datum_t>(getpid());
  forbid(SCMP_SYS(kill), {SCMP_A0_64(SCMP_CMP_NE, own)});
  forbid(SCMP_SYS(tgkill), {SCMP_A0_64(SCMP_CMP_NE, own)});
  forbid(SCMP_SYS(tkill), {SCMP_A0_64(SCMP_CMP_NE, own)});
  forbid(SCMP_SYS(prlimit64), {SCMP_A0_64(SCMP_CMP_NE, 0)});
  for (const int call : unknown_calls) {
    if (call < 0) continue;
    whole = whole && seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(ENOSYS), call, 0) == 0;
  }
  return whole && seccomp_load(filter.get()) == 0;
}

/// Rights over files that the running kernel knows, of those that this one names; later versions of
/// Landlock have them although their header is not here yet.
std::uint64_t rights_of(long version) {
  constexpr std::uint64_t reading = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
  constexpr std::uint64_t first = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1;
  constexpr std::uint64_t refer = 1ULL << 13;     // from version 2
  constexpr std::uint64_t truncate = 1ULL << 14;  // from version 3
  std::uint64_t rights = first & ~reading;
  if (version >= 2) rights |= refer;
  if (version >= 3) rights |= truncate;
  return rights;
}

/// Denies every right over files but to read them, by a set of rules that allows none.
bool restrict_files() {
  const long version =
      syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return false;
  const std::uint64_t rights = rights_of(version);
  const auto rules =
      static_cast<int>(syscall(SYS_landlock_create_ruleset, &rights, sizeof rights, 0));
  if (rules < 0) return false;
  const bool restricted = syscall(SYS_landlock_restrict_self, rules, 0) == 0;
  close(rules);
  return restricted;
}

}  // namespace

Guard guard_process(Denied denied) {
  answer_denied = denied;
  struct sigaction action {};
  action.sa_sigaction = on_denied_call;
  action.sa_flags = SA_SIGINFO;
  if (sigaction(SIGSYS, &action, nullptr) != 0) return Guard::none;
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return Guard::none;
  const bool landlock = restrict_files();
  if (!filter_calls()) return Guard::none;
  return landlock ? Guard::seccomp_and_landlock : Guard::seccomp;
}

void deny(const std::string& deed) {
  if (answer_denied != nullptr) answer_denied(deed);
  _exit(1);
}

}  // namespace pounding
