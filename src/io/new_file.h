#pragma once

#include <cstdint>
#include <cstdio>
#include <span>
#include <string>

namespace pounding {

/// Frees the name of a file that is about to be written: an earlier file of that name goes, and of
/// a symbolic link the link alone, so that nothing is ever written to where it points. Throws
/// UserError: a folder, a device or a pipe has the name, or it cannot be taken away.
void free_name(const std::string& path);

/// Throws UserError if a symbolic link has the name, as nothing is opened for writing through one.
void require_no_link(const std::string& path);

/// A file written from its beginning under a name that free_name() freed. Errors throw UserError
/// naming it.
class NewFile {
 public:
  explicit NewFile(const std::string& path);
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  /// A file that was not closed is not complete, and goes.
  ~NewFile();

  std::FILE* stream() const { return file_; }
  void write(std::span<const char> bytes) const;
  /// Throws if anything was not written.
  void close();

 private:
  std::string path_;
  std::FILE* file_ = nullptr;
};

/// Writes a whole file: under another name first, so that there is the old one, or none, until the
/// new one is complete. Throws UserError (no space).
void write_whole_file(const std::string& path, const std::string& text);

/// A file that is there, read and written at byte offsets, by any number of processes at once as
/// long as their ranges differ; written not through a symbolic link. Errors throw UserError naming
/// it.
class OffsetFile {
 public:
  enum class Access { read, write };
  OffsetFile(const std::string& path, Access access);
  OffsetFile(const OffsetFile&) = delete;
  OffsetFile& operator=(const OffsetFile&) = delete;
  ~OffsetFile();

  void write(std::int64_t offset, std::span<const double> values) const;
  void read(std::int64_t offset, std::span<double> values) const;
  /// All that was written is on the disk, or this throws.
  void sync() const;

 private:
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  int file_ = -1;
};

}  // namespace pounding
