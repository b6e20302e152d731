#pragma once

#include <cstdio>
#include <initializer_list>
#include <span>
#include <string>

namespace pounding {

/// A CSV file with comment lines first ("# "), one header line, then rows of numbers with all their
/// digits. Throws UserError if it cannot be opened or written.
class CsvFile {
 public:
  /// `path` empty or "/dev/stdout": the standard output of the program, wherever it stands; opened
  /// by name it would begin again at the start of its file.
  explicit CsvFile(const std::string& path);
  CsvFile(const CsvFile&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;
  ~CsvFile();

  void comment(const std::string& text);
  void header(const std::string& names);
  /// A row; `label` is its first field unless it is empty.
  void row(const std::string& label, std::span<const double> values);
  void row(const std::string& label, std::initializer_list<double> values) {
    row(label, std::span(values.begin(), values.size()));
  }
  /// Throws if anything was not written. Standard output stays open.
  void close();

 private:
  bool standard_output_ = false;
  std::string path_;
  std::FILE* file_ = nullptr;
};

}  // namespace pounding
