#include "mesh/mesh_guard.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <functional>
#include <sched.h>
#include <seccomp.h>
#include <spawn.h>
#include <string>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

namespace pounding {
namespace mesh_guard_test {

int answer = -1;

void tell(const char* deed) {
  [[maybe_unused]] const ssize_t written = write(answer, deed, std::strlen(deed));
  _exit(1);
}

/// From here on a kernel without Landlock, for this process.
bool forget_landlock() {
  const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SYS_landlock_create_ruleset, 0) == 0 &&
         seccomp_load(filter) == 0;
}

/// What the guard says of a deed; "killed" where it could say nothing, "done" where it let it be.
std::string attempt(const std::function<void()>& deed, bool landlock) {
  int ends[2];
  if (pipe(ends) != 0) return "no pipe";
  const pid_t child = fork();
  if (child == 0) {
    answer = ends[1];
    if (!landlock && (!forget_landlock() || restrict_files())) abort();
    const Guard guard = guard_process(tell);
    if (landlock ? guard != Guard::none : guard == Guard::seccomp) deed();
    _exit(0);
  }
  close(ends[1]);
  std::string told(200, '\0');
  const ssize_t length = read(ends[0], told.data(), told.size());
  told.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) return WTERMSIG(status) == SIGSYS ? "killed" : "crashed";
  return WEXITSTATUS(status) == 0 ? "done" : told;
}

/// A folder with a file, gone at the end.
class MeshGuard : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_NE(mkdtemp(folder_), nullptr);
    old_ = std::string(folder_) + "/old";
    made_ = std::string(folder_) + "/made";
    close(open(old_.c_str(), O_CREAT | O_WRONLY, 0600));
  }
  void TearDown() override {
    EXPECT_EQ(access(made_.c_str(), F_OK), -1);
    unlink(old_.c_str());
    EXPECT_EQ(rmdir(folder_), 0);
  }

  char folder_[40] = "/tmp/pounding-guard-XXXXXX";
  std::string old_;
  std::string made_;
};

TEST_F(MeshGuard, DeniesWhatAMeshNeedsNot) {
  const char* old = old_.c_str();
  const char* made = made_.c_str();
  const pid_t parent = getpid();
  char* const words[] = {const_cast<char*>("/bin/true"), nullptr};
  const std::string start = "start a program";
  const std::string change = "write to a file or change it";
  const std::string connect = "open a network connection";
  const std::string other = "meddle with another process";
  const std::string kernel = "meddle with the system";
  const std::pair<std::string, std::function<void()>> deeds[] = {
      {start, [&] { execv(words[0], words); }},
      {change, [&] { open(old, O_WRONLY); }},
      {change, [&] { open(old, O_RDWR | O_CLOEXEC); }},
      {change, [&] { open(old, O_RDONLY | O_TRUNC); }},
      {change, [&] { creat(made, 0600); }},
      {change, [&] { [[maybe_unused]] const int done = truncate(old, 0); }},
      {change, [&] { unlink(old); }},
      {change, [&] { rmdir(folder_); }},
      {change, [&] { rename(old, made); }},
      {change, [&] { [[maybe_unused]] const int done = link(old, made); }},
      {change, [&] { [[maybe_unused]] const int done = symlink(old, made); }},
      {change, [&] { mkdir(made, 0700); }},
      {change, [&] { mkfifo(made, 0600); }},
      {change, [&] { chmod(old, 0666); }},
      {connect, [&] { socket(AF_UNIX, SOCK_STREAM, 0); }},
      {connect, [&] { socket(AF_INET, SOCK_DGRAM, 0); }},
      {other, [&] { kill(parent, 0); }},
      {other, [&] { kill(-1, 0); }},
      {other, [&] { sigqueue(parent, 0, {}); }},
      {other, [&] { ptrace(PTRACE_ATTACH, parent, nullptr, nullptr); }},
      {other, [&] { process_vm_readv(parent, nullptr, 0, nullptr, 0, 0); }},
      {kernel, [&] { unshare(CLONE_NEWUSER); }},
      {kernel, [&] { setns(0, 0); }},
      {kernel, [&] { mount("none", folder_, "tmpfs", 0, nullptr); }},
      {kernel, [&] { syscall(SYS_bpf, 0, nullptr, 0); }},
      {kernel, [&] { syscall(SYS_keyctl, 0, 0, 0, 0, 0); }},
  };
  for (const bool landlock : {true, false}) {
    for (const auto& [said, deed] : deeds) EXPECT_EQ(attempt(deed, landlock), said);
    const std::string forked =
        attempt([] { [[maybe_unused]] const pid_t child = fork(); }, landlock);
    EXPECT_TRUE(forked == start || forked == "killed") << forked;
    const auto spawn = [&] {
      pid_t child = 0;
      posix_spawn(&child, words[0], nullptr, nullptr, words, environ);
    };
    const std::string spawned = attempt(spawn, landlock);
    EXPECT_TRUE(spawned == start || spawned == "killed") << spawned;
    const auto ring = [] {
      if (syscall(SYS_io_uring_setup, 1, nullptr) != -1 || errno != ENOSYS) abort();
    };
    EXPECT_EQ(attempt(ring, landlock), "done");
  }
}

TEST_F(MeshGuard, LandlockAloneKeepsFiles) {
  const pid_t child = fork();
  if (child == 0) {
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    if (!restrict_files()) _exit(2);
    const char* old = old_.c_str();
    const char* made = made_.c_str();
    char* const words[] = {const_cast<char*>("/bin/true"), nullptr};
    const bool kept = open(old, O_WRONLY) < 0 && creat(made, 0600) < 0 && unlink(old) < 0 &&
                      rename(old, made) < 0 && link(old, made) < 0 && symlink(old, made) < 0 &&
                      mkdir(made, 0700) < 0 && mkfifo(made, 0600) < 0 && execv(words[0], words) < 0;
    _exit(kept && open(old, O_RDONLY) >= 0 ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 2) GTEST_SKIP() << "no Landlock here";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST_F(MeshGuard, LetsReadAndStartThreads) {
  for (const bool landlock : {true, false}) {
    EXPECT_EQ(attempt(
                  [] {
                    const int file = open("/proc/self/status", O_RDONLY);
                    char byte = 0;
                    std::thread reader([&] { byte = read(file, &byte, 1) == 1 ? byte : '\0'; });
                    reader.join();
                    if (byte != 'N' || kill(getpid(), 0) != 0) abort();
                  },
                  landlock),
              "done");
  }
}

}  // namespace mesh_guard_test
}  // namespace pounding
