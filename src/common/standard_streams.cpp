#include "common/standard_streams.h"

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

#include "common/crowded_node.h"

namespace pounding {
namespace {

/// A file of /proc on a process, whose words end with a zero or a line.
std::string content(pid_t process, const char* name) {
  std::ifstream file("/proc/" + std::to_string(process) + "/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// mpirun, beyond scripts between it and this process; 0 where it is not on this node, or does more
/// with the words of its ranks than to pass them on.
pid_t plain_launcher() {
  pid_t process = getppid();
  std::string name;
  const auto is_launcher = [&] {
    name = content(process, "comm");
    return name == "mpirun\n" || name == "orterun\n" || name == "mpiexec\n" || name == "prterun\n";
  };
  while (process > 0 && !is_launcher()) process = parent_of(process);
  const std::string words = content(process, "cmdline");
  const std::string own = words.substr(0, words.find("pounding"));
  return own.find("output") == std::string::npos && own.find("xml") == std::string::npos ? process
                                                                                         : 0;
}

void write_past_launcher() {
  const char* const rank = std::getenv("OMPI_COMM_WORLD_RANK");
  std::error_code failure;
  const std::string own = std::filesystem::read_symlink("/proc/self/fd/1", failure);
  if (rank == nullptr || std::string(rank) != "0" || !own.starts_with("/dev/pts/")) return;
  const std::string outer = "/proc/" + std::to_string(plain_launcher()) + "/fd/1";
  if (!std::filesystem::read_symlink(outer, failure).string().starts_with("pipe:")) return;
  const int pipe = open(outer.c_str(), O_WRONLY | O_CLOEXEC);
  if (pipe < 0) return;
  dup2(pipe, STDOUT_FILENO);
  close(pipe);
}

}  // namespace

void guard_standard_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  int opened = STDIN_FILENO;  // the lowest that is free
  while (opened >= 0 && opened <= STDERR_FILENO) opened = open("/dev/null", O_RDONLY);
  if (opened > STDERR_FILENO) close(opened);
  write_past_launcher();
}

}  // namespace pounding
