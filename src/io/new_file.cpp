#include "io/new_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
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
  refuse_if(!fs::is_regular_file(there) && !fs::is_symlink(there),
            path + ": cannot be written: something that is no file has that name");
  if (unlink(path.c_str()) != 0 && errno != ENOENT) {
    throw UserError(path + ": cannot be written (" + std::strerror(errno) + ")");
  }
}

void require_no_link(const std::string& path) {
  std::error_code failure;
  refuse_if(fs::is_symlink(fs::symlink_status(path, failure)),
            path + ": a symbolic link, which is not followed for writing; take it away");
}

NewFile::NewFile(const std::string& path) : path_(path) {
  free_name(path);
  file_ = std::fopen(path.c_str(), "wxe");  // x: never through a link
  refuse_if(file_ == nullptr, path + ": cannot be written (" + std::strerror(errno) + ")");
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

OffsetFile::OffsetFile(const std::string& path, Access access)
    : path_(path),
      file_(open(path.c_str(),
                 (access == Access::write ? O_WRONLY | O_NOFOLLOW : O_RDONLY) | O_CLOEXEC)) {
  if (access == Access::write) require_no_link(path);
  if (file_ < 0) fail("be opened");
}

OffsetFile::~OffsetFile() {
  if (file_ >= 0) close(file_);
}

void OffsetFile::fail(const std::string& what) const {
  throw UserError(path_ + ": could not " + what + " (" + std::strerror(errno) + ")");
}

void OffsetFile::write(std::int64_t offset, std::span<const double> values) const {
  const char* from = reinterpret_cast<const char*>(values.data());
  for (std::size_t left = values.size_bytes(); left > 0;) {
    const ssize_t done = pwrite(file_, from, left, offset);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) fail("be written; is the disk full?");
    from += done;
    offset += done;
    left -= static_cast<std::size_t>(done);
  }
}

void OffsetFile::read(std::int64_t offset, std::span<double> values) const {
  char* to = reinterpret_cast<char*>(values.data());
  for (std::size_t left = values.size_bytes(); left > 0;) {
    const ssize_t done = pread(file_, to, left, offset);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) fail("be read as far as it must be");
    to += done;
    offset += done;
    left -= static_cast<std::size_t>(done);
  }
}

void OffsetFile::sync() const {
  if (fsync(file_) != 0) fail("be written to the disk; is it full?");
}

}  // namespace pounding
