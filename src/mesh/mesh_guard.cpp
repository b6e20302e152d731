#include "mesh/mesh_guard.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <fcntl.h>
#include <initializer_list>
#include <linux/landlock.h>
#include <map>
#include <memory>
#include <sched.h>
#include <seccomp.h>
#include <sstream>
#include <string>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace pounding {
namespace {

/// A deed and the calls that it takes, by their names.
struct DeniedCalls {
  const char* deed;
  const char* calls;
};

constexpr const char* starting = "start a program";
constexpr const char* writing = "write to a file or change it";
constexpr const char* meddling = "meddle with another process";

/// Denied whatever their arguments are.
constexpr DeniedCalls denied_calls[] = {
    {starting, "execve execveat fork vfork"},
    {writing,
     "creat truncate ftruncate fallocate unlink unlinkat rmdir rename renameat renameat2 link "
     "linkat symlink symlinkat mkdir mkdirat mknod mknodat chmod fchmod fchmodat chown lchown "
     "fchown fchownat utime utimes futimesat utimensat setxattr lsetxattr fsetxattr removexattr "
     "lremovexattr fremovexattr mq_open open_by_handle_at"},
    {"open a network connection", "socket socketpair"},
    {meddling,
     "ptrace process_vm_readv process_vm_writev pidfd_open pidfd_send_signal pidfd_getfd "
     "rt_sigqueueinfo rt_tgsigqueueinfo shmget msgget semget"},
    {"meddle with the system",
     "mount umount2 fsopen open_tree move_mount chroot pivot_root unshare setns bpf "
     "perf_event_open userfaultfd keyctl add_key request_key init_module finit_module kexec_load "
     "kexec_file_load reboot"},
};

/// Calls that glibc replaces by others where the kernel does not know them: their arguments lie in
/// memory, where no filter can look, or they are younger than the headers (fchmodat2, setxattrat,
/// removexattrat).
constexpr auto unknown_calls = std::to_array<int>(
    {SCMP_SYS(clone3), SCMP_SYS(openat2), SCMP_SYS(io_uring_setup), 452, 463, 466});

Denied answer_denied = nullptr;

/// Deeds of the calls that are denied.
std::map<int, const char*>& deeds() {
  static std::map<int, const char*> of_calls;
  return of_calls;
}

/// The thread is stopped in the call itself, in the midst of nothing else, so that this may do
/// anything that any other function may.
void on_denied_call(int /*signal*/, siginfo_t* info, void* /*context*/) {
  const auto found = deeds().find(info->si_syscall);
  answer_denied(found != deeds().end() ? found->second : meddling);
  _exit(1);
}

bool filter_calls() {
  using Context = std::unique_ptr<void, void (*)(scmp_filter_ctx)>;
  using Where = std::initializer_list<scmp_arg_cmp>;
  const Context filter(seccomp_init(SCMP_ACT_ALLOW), seccomp_release);
  bool whole = filter != nullptr;
  const auto add = [&](std::uint32_t action, int call, const Where& where) {
    if (call < 0) return;  // of other processors
    const auto count = static_cast<unsigned>(where.size());
    whole = whole && seccomp_rule_add_array(filter.get(), action, call, count, where.begin()) == 0;
  };
  const auto deny = [&](const char* deed, int call, const Where& where) {
    deeds()[call] = deed;
    add(SCMP_ACT_TRAP, call, where);
  };
  for (const DeniedCalls& row : denied_calls) {
    std::istringstream names(row.calls);
    for (std::string name; names >> name;) {
      const int call = seccomp_syscall_resolve_name(name.c_str());
      whole = whole && call != __NR_SCMP_ERROR;
      deny(row.deed, call, {});
    }
  }
  for (const int flag : {O_WRONLY, O_RDWR, O_CREAT, O_TRUNC}) {
    const auto bits = static_cast<scmp_datum_t>(flag);
    deny(writing, SCMP_SYS(open), {SCMP_A1_64(SCMP_CMP_MASKED_EQ, bits, bits)});
    deny(writing, SCMP_SYS(openat), {SCMP_A2_64(SCMP_CMP_MASKED_EQ, bits, bits)});
  }
  deny(starting, SCMP_SYS(clone), {SCMP_A0_64(SCMP_CMP_MASKED_EQ, CLONE_THREAD, 0)});
  const auto own = static_cast<scmp_datum_t>(getpid());
  for (const int call : {SCMP_SYS(kill), SCMP_SYS(tgkill), SCMP_SYS(tkill)}) {
    deny(meddling, call, {SCMP_A0_64(SCMP_CMP_NE, own)});
  }
  deny(meddling, SCMP_SYS(prlimit64), {SCMP_A0_64(SCMP_CMP_NE, 0)});
  for (const int call : unknown_calls) add(SCMP_ACT_ERRNO(ENOSYS), call, {});
  return whole && seccomp_load(filter.get()) == 0;
}

}  // namespace

// Every right over files is denied but to read them, by a set of rules that allows none.
bool restrict_files() {
  const long version =
      syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return false;
  // Later versions know rights that the header here does not: to refer to other folders, to cut.
  const int known = version >= 3 ? 15 : version == 2 ? 14 : 13;
  const std::uint64_t rights =
      ((1ULL << known) - 1) & ~(LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR);
  const auto rules =
      static_cast<int>(syscall(SYS_landlock_create_ruleset, &rights, sizeof rights, 0));
  if (rules < 0) return false;
  const bool restricted = syscall(SYS_landlock_restrict_self, rules, 0) == 0;
  close(rules);
  return restricted;
}

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

}  // namespace pounding
