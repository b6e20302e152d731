#include "output/result_folder.h"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <fstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/error.h"

namespace pounding {
namespace {

namespace fs = std::filesystem;

constexpr const char* lock_name = "running.lock";

std::string lock_path(const std::string& folder) {
  return folder + "/" + lock_name;
}

/// Whether the open file is still the one of that name.
bool has_name(int file, const std::string& path) {
  struct stat open_one {};
  struct stat named {};
  return fstat(file, &open_one) == 0 && stat(path.c_str(), &named) == 0 &&
         open_one.st_dev == named.st_dev && open_one.st_ino == named.st_ino;
}

std::string first_line(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

}  // namespace

std::vector<fs::path> missing_folders(fs::path folder) {
  std::vector<fs::path> missing;
  std::error_code failure;
  while (!folder.empty() && !fs::exists(fs::symlink_status(folder, failure))) {
    missing.push_back(folder);
    folder = folder.parent_path();
  }
  return missing;
}

void create_output(const std::string& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) throw UserError("option -output " + folder + ": the folder cannot be created");
}

ResultFolder::ResultFolder(const std::string& path)
    : path_(path), made_(missing_folders(fs::path(path).lexically_normal())) {
  std::error_code failure;
  fs::create_directories(path, failure);
  refuse_if(failure || access(path.c_str(), W_OK | X_OK) != 0,
            "option -output " + path + ": the folder cannot be created or written");
  lock();
}

void ResultFolder::lock() {
  const std::string path = lock_path(path_);
  for (bool own = false; !own;) {
    lock_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (lock_ < 0 && errno == ELOOP && unlink(path.c_str()) == 0) {
      continue;  // of a link the link went
    }
    refuse_if(lock_ < 0, "option -output " + path_ + ": the folder cannot be created or written");
    if (flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      close(lock_);
      throw UserError("option -output " + path_ + ": another run writes there (" +
                      first_line(path) + "); wait for its end, or give another folder");
    }
    own = has_name(lock_, path);  // else the run before took it away meanwhile
    if (!own) close(lock_);
  }
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  const std::string who =
      "process " + std::to_string(getpid()) + " on " + std::string(host.data()) + "\n";
  // A lock without its owner's name is a lock as well.
  [[maybe_unused]] const bool named =
      ftruncate(lock_, 0) == 0 && write(lock_, who.data(), who.size()) > 0;
}

ResultFolder::~ResultFolder() {
  if (has_name(lock_, lock_path(path_))) unlink(lock_path(path_).c_str());
  close(lock_);
  for (const fs::path& folder : made_) {
    rmdir(folder.c_str());  // fails where there is anything in it
  }
}

std::vector<std::string> ResultFolder::clear(const std::string& restart,
                                             std::span<const ResultFile> files) const {
  std::error_code ignored;
  const bool goes_on = !restart.empty() && fs::equivalent(fs::absolute(restart).parent_path(),
                                                          fs::absolute(path_), ignored);
  std::vector<std::string> removed;
  const auto remove = [&](const std::string& name) {
    const fs::file_status there = fs::symlink_status(path_ + "/" + name, ignored);
    if ((fs::is_regular_file(there) || fs::is_symlink(there)) &&  // of a link the link alone
        fs::remove(path_ + "/" + name, ignored)) {
      removed.emplace_back(name);
    }
  };
  for (const ResultFile& file : files) {
    if (!goes_on || !file.goes_on) remove(file.name);
    remove(file.name + ".new");
  }
  return removed;
}

}  // namespace pounding
