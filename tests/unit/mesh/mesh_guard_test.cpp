#include "mesh/mesh_guard.h"

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <functional>
#include <spawn.h>
#include <string>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

namespace pounding {
namespace mesh_guard_test {

int answer = -1;

void tell(const std::string& deed) {
  [[maybe_unused]] const ssize_t written = write(answer, deed.data(), deed.size());
  _exit(1);
}

/// What the guard says of a deed; "killed" where it could say nothing, "done" where it let it be.
std::string attempt(const std::function<void()>& deed) {
  int ends[2];
  if (pipe(ends) != 0) return "no pipe";
  const pid_t child = fork();
  if (child == 0) {
    answer = ends[1];
    if (guard_process(tell) != Guard::none) deed();
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

TEST(MeshGuard, DeniesWhatAMeshNeedsNot) {
  char folder[] = "/tmp/pounding-guard-XXXXXX";
  ASSERT_NE(mkdtemp(folder), nullptr);
  const std::string old = std::string(folder) + "/old";
  const std::string made = std::string(folder) + "/made";
  close(open(old.c_str(), O_CREAT | O_WRONLY, 0600));
  const std::string of_old = " '" + old + "'";
  const std::string of_made = " '" + made + "'";
  const pid_t parent = getpid();
  char* const words[] = {const_cast<char*>("/bin/true"), nullptr};
  const std::pair<std::string, std::function<void()>> deeds[] = {
      {"start the program '/bin/true'", [&] { execv(words[0], words); }},
      {"write to" + of_old, [&] { open(old.c_str(), O_WRONLY); }},
      {"write to" + of_old, [&] { open(old.c_str(), O_RDWR | O_CLOEXEC); }},
      {"write to" + of_old, [&] { open(old.c_str(), O_RDONLY | O_TRUNC); }},
      {"write to" + of_made, [&] { creat(made.c_str(), 0600); }},
      {"cut" + of_old, [&] { [[maybe_unused]] const int done = truncate(old.c_str(), 0); }},
      {"remove" + of_old, [&] { unlink(old.c_str()); }},
      {"remove '" + std::string(folder) + "'", [&] { rmdir(folder); }},
      {"rename" + of_old, [&] { rename(old.c_str(), made.c_str()); }},
      {"link" + of_old, [&] { [[maybe_unused]] const int done = link(old.c_str(), made.c_str()); }},
      {"link" + of_made,
       [&] { [[maybe_unused]] const int done = symlink(old.c_str(), made.c_str()); }},
      {"make the folder" + of_made, [&] { mkdir(made.c_str(), 0700); }},
      {"make" + of_made, [&] { mkfifo(made.c_str(), 0600); }},
      {"change the rights of" + of_old, [&] { chmod(old.c_str(), 0666); }},
      {"open a network connection", [&] { socket(AF_UNIX, SOCK_STREAM, 0); }},
      {"open a network connection", [&] { socket(AF_INET, SOCK_DGRAM, 0); }},
      {"send a signal to another process", [&] { kill(parent, 0); }},
      {"send a signal to another process", [&] { kill(-1, 0); }},
  };
  for (const auto& [said, deed] : deeds) EXPECT_EQ(attempt(deed), said);
  const std::string forked = attempt([] { [[maybe_unused]] const pid_t child = fork(); });
  EXPECT_TRUE(forked == "start a program" || forked == "killed") << forked;
  const std::string spawned = attempt([&] {
    pid_t child = 0;
    posix_spawn(&child, words[0], nullptr, nullptr, words, environ);
  });
  EXPECT_TRUE(spawned == "start a program" || spawned == "killed") << spawned;
  EXPECT_EQ(access(made.c_str(), F_OK), -1);
  unlink(old.c_str());
  EXPECT_EQ(rmdir(folder), 0);
}

TEST(MeshGuard, LetsReadAndStartThreads) {
  EXPECT_EQ(attempt([] {
              const int file = open("/proc/self/status", O_RDONLY);
              char byte = 0;
              std::thread reader([&] { byte = read(file, &byte, 1) == 1 ? byte : '\0'; });
              reader.join();
              if (byte != 'N' || kill(getpid(), 0) != 0) abort();
            }),
            "done");
}

}  // namespace mesh_guard_test
}  // namespace pounding
