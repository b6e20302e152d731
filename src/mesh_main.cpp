#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <span>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "mesh/gmsh_model.h"
#include "mesh/raw_mesh.h"

/// The program pounding-mesh, which `pounding` runs once per mesh: Gmsh's failures, and all deeds
/// of a .geo file, stay in a process of its own, which can read files and answer, and nothing else.
///
///     pounding-mesh FILE make|open [-setnumber NAME NUMBER | -setstring NAME WORD]...
///
/// FILE is a geometry to mesh or a mesh to open; the answer (mesh/raw_mesh.h) goes to descriptor 3.
namespace {

constexpr int answer_descriptor = 3;

/// It ends with the process that started it, it is the first to go where memory ends, and it leaves
/// no image of itself.
void restrict_process() {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (std::FILE* file = std::fopen("/proc/self/oom_score_adj", "w")) {
    std::fputs("1000", file);
    std::fclose(file);
  }
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
}

/// Answers; throws std::runtime_error when nobody listens any more.
void send(std::span<const char> bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = write(answer_descriptor, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno != EINTR) throw std::runtime_error("the answer cannot be written");
    done += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
}

/// Memory to answer with where there is none left.
std::unique_ptr<char[]> reserve;

/// Gmsh is not asked to go on: parts of it assert that their memory came.
void answer_no_memory() {
  if (reserve == nullptr) _exit(1);
  reserve.reset();
  pounding::RawAnswer answer;
  answer.error = "the memory is not enough for it";
  pounding::write_answer(answer, send);
  _exit(0);
}

/// Answers the deed at which the file was stopped, and ends.
void answer_denied(const char* deed) {
  pounding::RawAnswer answer;
  answer.denied = deed;
  pounding::write_answer(answer, send);
  _exit(0);
}

}  // namespace

int main(int count, char** words) {
  if (count < 3) {
    std::fputs("pounding-mesh is run by pounding, not by hand\n", stderr);
    return 1;
  }
  restrict_process();
  reserve = std::make_unique<char[]>(1 << 20);
  std::set_new_handler(answer_no_memory);
  const std::span<char*> arguments(words + 2, static_cast<std::size_t>(count - 2));
  const bool make = std::strcmp(words[2], "make") == 0;
  try {
    pounding::write_answer(pounding::gmsh_mesh({words[1], make, arguments}, answer_denied), send);
  } catch (const std::runtime_error&) {
    return 1;
  }
  _exit(0);  // the end of libraries is of no use
}
