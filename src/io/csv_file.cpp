#include "io/csv_file.h"

#include "common/error.h"

namespace pounding {

CsvFile::CsvFile(const std::string& path, int digits)
    : standard_output_(path.empty() || path == "/dev/stdout"),
      path_(standard_output_ ? "standard output" : path),
      digits_(digits),
      file_(standard_output_ ? stdout : std::fopen(path.c_str(), "w")) {
  if (file_ == nullptr) throw UserError(path + ": cannot be written");
}

CsvFile::~CsvFile() {
  if (file_ != nullptr && !standard_output_) std::fclose(file_);
}

void CsvFile::comment(const std::string& text) {
  std::fprintf(file_, "# %s\n", text.c_str());
}

void CsvFile::header(const std::string& names) {
  std::fprintf(file_, "%s\n", names.c_str());
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
  const bool failed = std::ferror(file_) != 0;
  const bool lost = (standard_output_ ? std::fflush(file_) : std::fclose(file_)) != 0;
  file_ = nullptr;
  if (failed || lost) {
    throw UserError(path_ + ": could not be written completely (is the disk full?)");
  }
}

}  // namespace pounding
