#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace pounding {

/// The folders of a path that are not there yet, the innermost first.
std::vector<std::filesystem::path> missing_folders(std::filesystem::path folder);

/// The folder that a run writes to, and its alone for as long as this object lives: the file
/// running.lock in it is locked (flock), which ends with the process however that dies. For one
/// rank.
class ResultFolder {
 public:
  /// Creates the folder if there is none. Throws UserError: it cannot be created or written, or
  /// another run is writing there. A file system without locks is taken as it is.
  explicit ResultFolder(const std::string& path);
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;
  /// Takes running.lock away, and the folders that were made for it and are still empty.
  ~ResultFolder();

  /// Removes the files of an earlier run under the names that this program gives to results, among
  /// them `tables`, and nothing else; returns the names. If the run continues from the checkpoint
  /// `restart` in the folder, that, its history and the shapes of modes stay.
  std::vector<std::string> clear(const std::string& restart,
                                 std::span<const char* const> tables) const;

 private:
  void lock();

  std::string path_;
  std::vector<std::filesystem::path> made_;  ///< folders that were not there, innermost first
  int lock_ = -1;                            ///< file descriptor
};

}  // namespace pounding
