#include "output/csv_file.h"

#include <stdexcept>

namespace pounding {

CsvFile::CsvFile(const std::string& path) : path_(path), file_(std::fopen(path.c_str(), "w")) {
  if (file_ == nullptr) {
    throw std::runtime_error(path + ": cannot be written");
  }
}

CsvFile::~CsvFile() {
  if (file_ != nullptr) {
    std::fclose(file_);
  }
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
    std::fprintf(file_, first ? "%.17g" : ",%.17g", value);
    first = false;
  }
  std::fputc('\n', file_);
}

void CsvFile::close() {
  const bool failed = std::ferror(file_) != 0;
  const bool lost = std::fclose(file_) != 0;
  file_ = nullptr;
  if (failed || lost) {
    throw std::runtime_error(path_ + ": could not be written completely (is the disk full?)");
  }
}

}  // namespace pounding
