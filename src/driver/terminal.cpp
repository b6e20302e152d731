#include "driver/terminal.h"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <sys/ioctl.h>
#include <unistd.h>

#include "common/parent_process.h"

namespace pounding {
namespace {

/// Where the standard output of a process goes; "" where that is not to be seen.
std::string standard_output(const std::string& process) {
  std::error_code failure;
  return std::filesystem::read_symlink("/proc/" + process + "/fd/1", failure);
}

}  // namespace

bool is_watched() {
  if (isatty(STDOUT_FILENO) == 0) return false;
  if (std::getenv("OMPI_COMM_WORLD_RANK") == nullptr && std::getenv("PMI_RANK") == nullptr) {
    return true;
  }
  // Scripts between mpirun and the program have the same terminal as the program.
  const std::string own = standard_output("self");
  pid_t process = getppid();
  while (process > 0 && standard_output(std::to_string(process)) == own) {
    process = parent_of(process);
  }
  const std::string outer = standard_output(std::to_string(process));
  return outer.empty() || outer.starts_with("/dev/pts/") || outer.starts_with("/dev/tty") ||
         outer == "/dev/console";
}

int terminal_width() {
  constexpr int usual = 80;
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return usual;
  return size.ws_col > 1 ? size.ws_col : usual;
}

}  // namespace pounding
