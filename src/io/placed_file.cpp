#include "io/placed_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

#include "common/error.h"
#include "io/new_file.h"

namespace pounding {

PlacedFile::PlacedFile(const std::string& path, Access access)
    : path_(path),
      file_(open(path.c_str(),
                 (access == Access::write ? O_WRONLY | O_NOFOLLOW : O_RDONLY) | O_CLOEXEC)) {
  if (access == Access::write) require_no_link(path);
  if (file_ < 0) fail("be opened");
}

PlacedFile::~PlacedFile() {
  if (file_ >= 0) close(file_);
}

void PlacedFile::fail(const std::string& what) const {
  throw UserError(path_ + ": could not " + what + " (" + std::strerror(errno) + ")");
}

void PlacedFile::write(std::int64_t place, std::span<const double> values) const {
  const char* from = reinterpret_cast<const char*>(values.data());
  for (std::size_t left = values.size_bytes(); left > 0;) {
    const ssize_t done = pwrite(file_, from, left, place);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) fail("be written; is the disk full?");
    from += done;
    place += done;
    left -= static_cast<std::size_t>(done);
  }
}

void PlacedFile::read(std::int64_t place, std::span<double> values) const {
  char* to = reinterpret_cast<char*>(values.data());
  for (std::size_t left = values.size_bytes(); left > 0;) {
    const ssize_t done = pread(file_, to, left, place);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) fail("be read as far as it must be");
    to += done;
    place += done;
    left -= static_cast<std::size_t>(done);
  }
}

void PlacedFile::sync() const {
  if (fsync(file_) != 0) fail("be written to the disk; is it full?");
}

}  // namespace pounding
