#include "io/new_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <unistd.h>

#include "common/error.h"

namespace pounding {
namespace {

namespace fs = std::filesystem;

constexpr const char* not_complete = ": could not be written completely (is the disk full?)";

}  // namespace

void free_name(const std::string& path) {
  std::error_code failure;
  const fs::file_status there = fs::symlink_status(path, failure);
  if (!fs::exists(there)) return;
  if (!fs::is_regular_file(there) && !fs::is_symlink(there)) {
    throw UserError(path + ": cannot be written: something that is no file has that name");
  }
  if (unlink(path.c_str()) != 0 && errno != ENOENT) {
    throw UserError(path + ": cannot be written (" + std::strerror(errno) + ")");
  }
}

void require_no_link(const std::string& path) {
  std::error_code failure;
  if (fs::is_symlink(fs::symlink_status(path, failure))) {
    throw UserError(path + ": a symbolic link, which is not followed for writing; take it away");
  }
}

NewFile::NewFile(const std::string& path) : path_(path) {
  free_name(path);
  file_ = std::fopen(path.c_str(), "wxe");  // x: never through a link
  if (file_ == nullptr) {
    throw UserError(path + ": cannot be written (" + std::strerror(errno) + ")");
  }
}

NewFile::~NewFile() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  unlink(path_.c_str());
}

void NewFile::write(std::span<const char> bytes) const {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) {
    throw UserError(path_ + not_complete);
  }
}

void NewFile::close() {
  const bool failed = std::ferror(file_) != 0;
  const bool lost = std::fclose(file_) != 0;
  file_ = nullptr;
  if (!failed && !lost) return;
  unlink(path_.c_str());
  throw UserError(path_ + not_complete);
}

void write_whole_file(const std::string& path, const std::string& text) {
  const std::string draft = path + ".new";
  NewFile file(draft);
  file.write(text);
  file.close();
  std::error_code failure;
  fs::rename(draft, path, failure);
  if (failure) throw UserError(path + ": could not be written (" + failure.message() + ")");
}

}  // namespace pounding
