// Counts the instructions of a piece of a program by their addresses, one at a time (ptrace):
//
//     count_instructions COUNTS PROGRAM WORDS...
//
// The program marks begin and end of the piece by raising SIGTRAP, as step_benchmark does; it keeps
// standard input and output. COUNTS gets a line per address in the program's own file, its offset
// there in hexadecimal digits and how often it was carried out, then the number of instructions
// elsewhere, in libraries, behind the word "elsewhere". Of x86-64.

#include <cinttypes>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/personality.h>
#include <sys/ptrace.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>
#include <unordered_map>

namespace {

/// Addresses of a program's own file in a process.
struct Mapping {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

[[noreturn]] void fail(const std::string& why) {
  std::fprintf(stderr, "count_instructions: %s\n", why.c_str());
  std::exit(1);
}

Mapping mapping_of(pid_t process) {
  const std::string folder = "/proc/" + std::to_string(process);
  const std::string file = std::filesystem::read_symlink(folder + "/exe").string();
  std::ifstream maps(folder + "/maps");
  Mapping found;
  for (std::string line; std::getline(maps, line);) {
    if (!line.ends_with(file)) continue;
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    if (std::sscanf(line.c_str(), "%" SCNx64 "-%" SCNx64, &begin, &end) != 2) continue;
    if (found.end == 0) found.begin = begin;
    found.end = end;
  }
  if (found.end == 0) fail(file + " is nowhere in " + folder + "/maps");
  return found;
}

[[noreturn]] void become(char** words) {
  ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
  personality(ADDR_NO_RANDOMIZE);
  execvp(words[0], words);
  std::perror(words[0]);
  _exit(127);
}

}  // namespace

int main(int count, char** words) {
  if (count < 3) fail("count_instructions COUNTS PROGRAM WORDS...");
  const pid_t process = fork();
  if (process == 0) become(words + 2);
  int status = 0;
  waitpid(process, &status, 0);  // it stops when the program is there
  if (!WIFSTOPPED(status)) fail("the program does not start, or tracing is forbidden here");
  const Mapping program = mapping_of(process);
  std::unordered_map<std::uint64_t, std::uint64_t> counts;
  std::uint64_t elsewhere = 0;
  bool counting = false;
  for (long signal = 0;;) {
    ptrace(counting ? PTRACE_SINGLESTEP : PTRACE_CONT, process, nullptr, signal);
    signal = 0;
    if (waitpid(process, &status, 0) < 0 || !WIFSTOPPED(status)) break;
    if (WSTOPSIG(status) != SIGTRAP) {
      signal = WSTOPSIG(status);
      continue;
    }
    siginfo_t told;
    ptrace(PTRACE_GETSIGINFO, process, nullptr, &told);
    if (told.si_code == SI_TKILL) {
      counting = !counting;
      continue;
    }
    user_regs_struct registers;
    ptrace(PTRACE_GETREGS, process, nullptr, &registers);
    const std::uint64_t address = registers.rip;
    if (address < program.begin || address >= program.end) {
      ++elsewhere;
    } else {
      ++counts[address - program.begin];
    }
  }
  std::ofstream out(words[1]);
  for (const auto& [offset, times] : counts) {
    out << std::hex << offset << ' ' << std::dec << times << '\n';
  }
  out << "elsewhere " << elsewhere << '\n';
  return out && WIFEXITED(status) && WEXITSTATUS(status) == 0 ? 0 : 1;
}
