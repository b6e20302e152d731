#include "io/csv_file.h"

#include <poll.h>

#include "common/error.h"

namespace pounding {
namespace {

/// Whether a pipe's other end is closed: nobody reads, and nothing is missed.
bool is_unread(std::FILE* file) {
  pollfd pipe{fileno(file), POLLOUT, 0};
  return poll(&pipe, 1, 0) > 0 && (pipe.revents & POLLERR) != 0;
}

}  // namespace

CsvFile::CsvFile(const std::string& path, int digits)
    : target_(path.empty() || path == "/dev/stdout" ? Target::standard_output
              : path.starts_with("/dev/") && !path.starts_with("/dev/shm/") ? Target::device
                                                                            : Target::file),
      path_(target_ == Target::standard_output ? "standard output" : path),
      digits_(digits) {
  if (target_ == Target::file) new_file_.emplace(path);
  file_ = target_ == Target::standard_output ? stdout
          : target_ == Target::device        ? std::fopen(path.c_str(), "w")
                                             : new_file_->stream();
  if (file_ == nullptr) throw UserError(path + ": cannot be written");
}

CsvFile::~CsvFile() {
  if (file_ != nullptr && target_ == Target::device) std::fclose(file_);
}

std::string plain_cell(const std::string& text) {
  const bool formula = text.find_first_of("=+-@\t\r") == 0;
  const bool numbers = text.find_first_not_of("+-0123456789.,;eE ") == std::string::npos;
  return formula && !numbers ? "'" + text : text;
}

void CsvFile::row(const std::string& label, std::span<const double> values) {
  bool first = label.empty();
  std::fputs(label.c_str(), file_);
  for (const double value : values) {
    std::fprintf(file_, first ? "%.*g" : ",%.*g", digits_, value);
    first = false;
  }
  std::fputc('\n', file_);
}

void CsvFile::close() {
  if (new_file_) return new_file_->close();
  const bool unread = is_unread(file_);
  const bool failed = std::ferror(file_) != 0;
  const bool lost = (target_ == Target::device ? std::fclose(file_) : std::fflush(file_)) != 0;
  file_ = nullptr;
  refuse_if((failed || lost) && !unread,
            path_ + ": could not be written completely (is the disk full?)");
}

}  // namespace pounding
