#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace pounding {

/// A file that a run leaves in its folder of results.
struct ResultFile {
  std::string name;
  std::string holds;      ///< in words, for summary.json
  std::string columns{};  ///< of a table
  bool goes_on = false;   ///< a run that continues in the folder begins from it
};

/// The folders of a path that are not there yet, the innermost first.
std::vector<std::filesystem::path> missing_folders(std::filesystem::path folder);

/// Makes the folder of results. Throws UserError.
void create_output(const std::string& folder);

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

  /// Removes these files of an earlier run, whole or as they are called while they are written, and
  /// nothing else; returns the names. If the run continues from the checkpoint `restart` in the
  /// folder, those that it begins from stay.
  std::vector<std::string> clear(const std::string& restart,
                                 std::span<const ResultFile> files) const;

 private:
  void lock();

  std::string path_;
  std::vector<std::filesystem::path> made_;  ///< folders that were not there, innermost first
  int lock_ = -1;                            ///< file descriptor
};

}  // namespace pounding
