#include "mesh/gmsh_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <optional>
#include <poll.h>
#include <span>
#include <spawn.h>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

#include "common/error.h"
#include "common/facts.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

/// Where pounding-mesh writes its answer.
constexpr int answer_descriptor = 3;

constexpr double longest_wait = 1e9;             // [s]
constexpr std::int64_t most_answer = 1LL << 46;  // above any memory of today [bytes]

/// pounding-mesh, beside this program or in the folder above (tests are a folder below).
std::string mesh_program() {
  const std::filesystem::path folder =
      std::filesystem::read_symlink("/proc/self/exe").parent_path();
  for (const std::filesystem::path& place : {folder, folder.parent_path()}) {
    if (std::filesystem::exists(place / "pounding-mesh")) return (place / "pounding-mesh").string();
  }
  throw UserError("the program pounding-mesh is not beside this one in " + folder.string() +
                  "; build it, or put both into one folder");
}

/// This process's variables without those by which MPI finds its job.
std::vector<char*> environment_without_mpi() {
  std::vector<char*> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text(*variable);
    if (!text.starts_with("OMPI_") && !text.starts_with("PMIX_") && !text.starts_with("PMI_")) {
      variables.push_back(*variable);
    }
  }
  variables.push_back(nullptr);
  return variables;
}

using Clock = std::chrono::steady_clock;

/// Words of the command line of a request.
std::vector<std::string> command_of(const MeshRequest& request) {
  std::vector<std::string> words{mesh_program(), request.file, request.make ? "make" : "open"};
  for (const auto& [name, value] : request.parameters) {
    char* end = nullptr;
    std::strtod(value.c_str(), &end);
    words.insert(words.end(), {*end == '\0' ? "-setnumber" : "-setstring", name, value});
  }
  return words;
}

struct TimeIsUp {};
struct AnswerCut {};

/// Why no whole answer came.
std::string describe_end(int status, const std::string& last_words) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGSYS) {
    return "stopped as it was about to start a program, which no mesh may; take the command out of "
           "it";
  }
  std::string text;
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    text = "Gmsh crashed on it (signal " + std::to_string(signal) + ", " + strsignal(signal) +
           (signal == SIGKILL ? ": was the memory enough?" : "") + ")";
  } else {
    text = "Gmsh ended without an answer (exit status " + std::to_string(WEXITSTATUS(status)) + ")";
  }
  if (!last_words.empty()) text += " after '" + last_words + "'";
  return text + "; look at the file and at the values of its parameters";
}

}  // namespace

/// A running pounding-mesh, which does not outlive this object.
class GmshRun::Process {
 public:
  explicit Process(const MeshRequest& request) {
    const Pipe answer;
    const Pipe errors;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, errors.in, 2);
    posix_spawn_file_actions_adddup2(&actions, answer.in, answer_descriptor);
    posix_spawn_file_actions_addclosefrom_np(&actions, answer_descriptor + 1);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
    std::vector<std::string> words = command_of(request);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    std::vector<char*> environment = environment_without_mpi();
    const int failure = posix_spawn(&process_, words[0].c_str(), &actions, &attributes,
                                    pointers.data(), environment.data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    close(answer.in);
    close(errors.in);
    answer_ = answer.out;
    errors_ = errors.out;
    if (failure != 0) {
      close(answer_);
      close(errors_);
      throw UserError(words[0] + " cannot be run: " + std::strerror(failure));
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process() {
    end();
    close(answer_);
    close(errors_);
  }

  /// The next bytes that it writes. Throws AnswerCut if it closes its end before, TimeIsUp.
  void read_exactly(std::span<char> bytes, Clock::time_point deadline) {
    for (std::size_t done = 0; done < bytes.size();) {
      const double left = std::chrono::duration<double>(deadline - Clock::now()).count();
      if (left <= 0) throw TimeIsUp();
      std::array<pollfd, 2> waiting{pollfd{answer_, POLLIN, 0}, pollfd{errors_, POLLIN, 0}};
      // Closed, it would be ready for ever.
      const nfds_t number = errors_end_ ? 1 : 2;
      if (poll(waiting.data(), number, static_cast<int>(std::min(1e3 * left + 1, 1e4))) <= 0) {
        continue;  // a signal, or the next turn of a long wait
      }
      if (waiting[1].revents != 0) take_errors();
      if (waiting[0].revents == 0) continue;
      const ssize_t count = read(answer_, bytes.data() + done, bytes.size() - done);
      if (count == 0) throw AnswerCut();
      if (count < 0 && errno != EINTR) {
        throw std::runtime_error("the pipe from the mesher cannot be read");
      }
      done += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
    }
  }

  /// Exit of the process as waitpid reports it; ends it if it still runs.
  int end(bool by_force = true) {
    if (process_ > 0) {
      if (by_force) kill(-process_, SIGKILL);
      while (!errors_end_) take_errors();
      while (waitpid(process_, &status_, 0) < 0 && errno == EINTR) {
      }
      process_ = 0;
    }
    return status_;
  }

  /// The last lines that it wrote as errors, in one; empty for none.
  std::string last_words() const {
    std::string text(trimmed(words_));
    std::ranges::replace(text, '\n', ' ');
    return text;
  }

 private:
  /// Both ends of a pipe, which no other program gets.
  struct Pipe {
    Pipe() {
      std::array<int, 2> ends{};
      if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe to the mesher");
      out = ends[0];
      in = ends[1];
    }
    int out = -1;
    int in = -1;
  };

  void take_errors() {
    constexpr std::size_t kept = 400;  // characters
    std::array<char, 4096> piece{};
    const ssize_t count = read(errors_, piece.data(), piece.size());
    if (count < 0 && errno == EINTR) return;
    errors_end_ = count <= 0;
    if (count > 0) words_.append(piece.data(), static_cast<std::size_t>(count));
    if (words_.size() <= kept) return;
    const std::size_t line = words_.find('\n', words_.size() - kept);
    words_.erase(0, line == std::string::npos || line + 1 == words_.size() ? words_.size() - kept
                                                                           : line + 1);
  }

  pid_t process_ = 0;
  int answer_ = -1;
  int errors_ = -1;
  bool errors_end_ = false;
  std::string words_;
  int status_ = 0;
};

GmshRun::GmshRun(MeshRequest request)
    : request_(std::move(request)), process_(std::make_unique<Process>(request_)) {}

GmshRun::~GmshRun() = default;

RawAnswer GmshRun::answer() {
  Process& process = *process_;
  const Clock::time_point deadline =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(
                         std::min(request_.time_limit, longest_wait)));
  std::optional<RawAnswer> answer;
  try {
    answer = read_answer([&](std::span<char> bytes) { process.read_exactly(bytes, deadline); },
                         static_cast<std::size_t>(most_answer));
  } catch (const AnswerCut&) {  // its exit status has the reason
  } catch (const TimeIsUp&) {
    throw UserError(sentence(
        "option {}: Gmsh was not done after {} s; look for a loop without end or too fine a mesh, "
        "or give a larger -mesh_time_limit",
        {request_.option, request_.time_limit}));
  }
  const int status = process.end(false);
  const std::string head = "option " + request_.option + ": ";
  if (status != 0 || !answer) {
    throw UserError(head + describe_end(status, process.last_words()));
  }
  refuse_if(!answer->denied.empty(),
            head + "stopped as it was about to " + answer->denied +
                ", and a mesh may only be read; take that out of the file");
  if (!answer->error.empty()) {
    std::ranges::replace(answer->error, '\n', ' ');
    throw UserError(head + "Gmsh could not read it (" + answer->error + ")");
  }
  return std::move(*answer);
}

}  // namespace pounding
