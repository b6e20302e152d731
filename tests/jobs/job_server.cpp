#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <span>
#include <string>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include <mpi.h>
#include <nlohmann/json.hpp>

#include "common/crowded_node.h"
#include "io/hdf5_file.h"
#include "run_job.h"

/// Ranks that run one job of the program after the other, so that tests start MPI once:
/// tests/jobs/dispatcher.py starts them and says which ranks run what. A rank that has nothing to
/// do sleeps in a read. Words of a job are one line of JSON; the answer is the job's exit status.
namespace {

using Json = nlohmann::json;

/// Connection to the dispatcher, line by line; it ends the process where the dispatcher is gone.
class Dispatcher {
 public:
  explicit Dispatcher(const char* path) : socket_(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::snprintf(address.sun_path, sizeof address.sun_path, "%s", path);
    if (connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
      std::perror("job_server");
      MPI_Abort(MPI_COMM_WORLD, 1);
    }
  }

  /// The next line; nothing where there will be no other.
  std::optional<std::string> read_line() {
    for (std::size_t end = 0;;) {
      end = read_.find('\n');
      if (end != std::string::npos) {
        std::string line = read_.substr(0, end);
        read_.erase(0, end + 1);
        return line;
      }
      char bytes[4096];
      const ssize_t count = read(socket_, bytes, sizeof bytes);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return std::nullopt;
      read_.append(bytes, static_cast<std::size_t>(count));
    }
  }

  void write_line(const std::string& line) {
    const std::string text = line + "\n";
    if (write(socket_, text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
      MPI_Abort(MPI_COMM_WORLD, 1);
    }
  }

 private:
  int socket_;
  std::string read_;
};

/// A descriptor that goes to a file for as long as the object lives.
class Redirected {
 public:
  Redirected(int descriptor, const std::string& path)
      : descriptor_(descriptor), before_(fcntl(descriptor, F_DUPFD_CLOEXEC, 10)) {
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    dup2(file, descriptor_);
    close(file);
  }
  Redirected(const Redirected&) = delete;
  Redirected& operator=(const Redirected&) = delete;
  ~Redirected() {
    std::fflush(nullptr);
    dup2(before_, descriptor_);
    close(before_);
  }

 private:
  int descriptor_;
  int before_;
};

/// Variables of the environment with the values of a job for as long as the object lives.
class Variables {
 public:
  explicit Variables(const Json& values) {
    for (const auto& [name, value] : values.items()) {
      const char* const before = std::getenv(name.c_str());
      before_.emplace_back(name,
                           before == nullptr ? std::nullopt : std::optional<std::string>(before));
      set(name,
          value.is_null() ? std::nullopt : std::optional<std::string>(value.get<std::string>()));
    }
  }
  Variables(const Variables&) = delete;
  Variables& operator=(const Variables&) = delete;
  ~Variables() {
    for (const auto& [name, value] : before_) set(name, value);
  }

 private:
  static void set(const std::string& name, const std::optional<std::string>& value) {
    if (value) {
      setenv(name.c_str(), value->c_str(), 1);
    } else {
      unsetenv(name.c_str());
    }
  }

  std::vector<std::pair<std::string, std::optional<std::string>>> before_;
};

/// The working folder of a job for as long as the object lives.
class Folder {
 public:
  explicit Folder(const std::string& path) : before_(open(".", O_DIRECTORY | O_CLOEXEC)) {
    if (chdir(path.c_str()) != 0) {
      std::perror(path.c_str());
      MPI_Abort(MPI_COMM_WORLD, 1);
    }
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    if (fchdir(before_) != 0) MPI_Abort(MPI_COMM_WORLD, 1);
    close(before_);
  }

 private:
  int before_;
};

/// Runs a job on its ranks, of which this is one.
int run(const Json& job) {
  const auto ranks = job.at("ranks").get<std::vector<int>>();
  MPI_Group all = MPI_GROUP_NULL;
  MPI_Group chosen = MPI_GROUP_NULL;
  MPI_Comm comm = MPI_COMM_NULL;
  MPI_Comm_group(MPI_COMM_WORLD, &all);
  MPI_Group_incl(all, static_cast<int>(ranks.size()), ranks.data(), &chosen);
  MPI_Comm_create_group(MPI_COMM_WORLD, chosen, job.at("number").get<int>() % 1000, &comm);
  int status = 0;
  {
    const Redirected out(STDOUT_FILENO, job.at("stdout"));
    const Redirected err(STDERR_FILENO, job.at("stderr"));
    const Variables variables(job.at("environment"));
    const Folder folder(job.at("folder"));
    status = pounding::run_job(comm, job.at("words").get<std::vector<std::string>>());
  }
  MPI_Comm_free(&comm);
  MPI_Group_free(&chosen);
  MPI_Group_free(&all);
  return status;
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    std::fputs("job_server is run by tests/jobs/dispatcher.py, not by hand\n", stderr);
    return 1;
  }
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  pounding::yield_while_waiting();
  pounding::listen_nowhere();
  pounding::prepare_hdf5();
  MPI_Init(&count, &words);
  {
    const pounding::NamelessSegments segments;
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    Dispatcher dispatcher(words[1]);
    dispatcher.write_line(std::to_string(rank));
    while (const auto line = dispatcher.read_line()) {
      dispatcher.write_line(std::to_string(run(Json::parse(*line))));
    }
  }
  MPI_Finalize();
  return 0;
}
