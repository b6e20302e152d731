#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include "mesh/raw_mesh.h"

/// The mesher of jobs: it answers as pounding-mesh, which it starts, and keeps the answers with what the
/// files held that Gmsh opened. To make a small mesh takes longer than most tests compute, and many
/// tests ask for the same ones. Beside job_server it comes before the mesher of the program; without the
/// variable POUNDING_KEPT_MESHES, a folder, it is that one.
namespace {

constexpr int answer_descriptor = 3;

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string fingerprint(const std::string& bytes) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char byte : bytes) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211U;
  }
  return std::to_string(hash) + "-" + std::to_string(bytes.size());
}

/// The answer of an entry whose question is this one, while all files hold what they held.
bool kept_answer(const std::string& entry, const std::string& question, std::string& answer) {
  std::ifstream file(entry, std::ios::binary);
  std::string line;
  std::string asked;
  while (std::getline(file, line) && line != "files") asked += line + "\n";
  if (!file || asked != question) return false;
  while (std::getline(file, line) && line != "answer") {
    const std::size_t space = line.find(' ');
    if (fingerprint(content_of(line.substr(space + 1))) != line.substr(0, space)) return false;
  }
  if (!file) return false;
  answer.assign(std::istreambuf_iterator<char>(file), {});
  return true;
}

/// Keeps an answer that is a mesh.
void keep(const std::string& entry, const std::string& question, const std::string& answer) {
  std::size_t at = 0;
  const pounding::RawAnswer read = pounding::read_answer(
      [&](std::span<char> bytes) {
        if (answer.size() - at < bytes.size()) throw std::runtime_error("the answer is cut");
        std::memcpy(bytes.data(), answer.data() + at, bytes.size());
        at += bytes.size();
      },
      answer.size());
  if (!read.error.empty() || !read.denied.empty()) return;
  const std::string written = entry + "." + std::to_string(getpid());
  std::ofstream file(written, std::ios::binary);
  file << question << "files\n";
  for (const std::string& path : read.mesh.files) {
    if (path.find('\n') != std::string::npos) return;
    file << fingerprint(content_of(path)) << " " << path << "\n";
  }
  file << "answer\n" << answer;
  file.close();
  if (file) std::filesystem::rename(written, entry);
}

void send(const std::string& answer) {
  for (std::size_t done = 0; done < answer.size();) {
    const ssize_t count = write(answer_descriptor, answer.data() + done, answer.size() - done);
    if (count < 0 && errno != EINTR) _exit(1);
    done += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
}

/// Its answer and its end, as waitpid tells it.
std::pair<std::string, int> answer_of(const char* mesher, char** words) {
  int ends[2];
  if (pipe(ends) != 0) _exit(1);
  const pid_t process = fork();
  if (process == 0) {
    dup2(ends[1], answer_descriptor);
    for (const int end : ends) {
      if (end != answer_descriptor) close(end);
    }
    execv(mesher, words);
    _exit(127);
  }
  close(ends[1]);
  std::string answer;
  std::vector<char> piece(1 << 16);
  for (;;) {
    const ssize_t count = read(ends[0], piece.data(), piece.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    answer.append(piece.data(), static_cast<std::size_t>(count));
  }
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return {answer, status};
}

}  // namespace

int main(int count, char** words) {
  const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe");
  const std::string mesher = (own.parent_path().parent_path() / "pounding-mesh").string();
  words[0] = const_cast<char*>(mesher.c_str());
  const char* place = std::getenv("POUNDING_KEPT_MESHES");
  std::string question;
  for (int i = 1; i < count; ++i) question += std::string(words[i]) + "\n";
  if (place == nullptr || count < 3 ||
      static_cast<std::ptrdiff_t>(count - 1) !=
          std::count(question.begin(), question.end(), '\n')) {
    execv(mesher.c_str(), words);
    return 1;
  }
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // as the mesher ends with its program
  const std::string entry =
      (std::filesystem::path(place) / std::to_string(std::hash<std::string>{}(question))).string();
  std::string answer;
  if (kept_answer(entry, question, answer)) {
    send(answer);
    return 0;
  }
  const auto [made, status] = answer_of(mesher.c_str(), words);
  send(made);
  if (WIFSIGNALED(status)) {
    signal(WTERMSIG(status), SIG_DFL);
    raise(WTERMSIG(status));
  }
  if (status != 0) return WEXITSTATUS(status);
  try {
    keep(entry, question, made);
  } catch (const std::exception&) {  // no place, or no answer: the next job asks again
  }
  return 0;
}
