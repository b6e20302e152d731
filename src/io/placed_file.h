#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace pounding {

/// A file that is there, read and written by places in bytes, by any number of processes at once as
/// long as their places differ; written not through a symbolic link. Errors throw UserError naming
/// it.
class PlacedFile {
 public:
  enum class Access { read, write };
  PlacedFile(const std::string& path, Access access);
  PlacedFile(const PlacedFile&) = delete;
  PlacedFile& operator=(const PlacedFile&) = delete;
  ~PlacedFile();

  void write(std::int64_t place, std::span<const double> values) const;
  void read(std::int64_t place, std::span<double> values) const;
  /// All that was written is on the disk, or this throws.
  void sync() const;

 private:
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  int file_ = -1;
};

}  // namespace pounding
