#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fuzz/mutator.h"

namespace pounding::fuzz {

/// A reader under fuzzing. Its seeds are the files of `seeds`, and of tests/fuzz/found/NAME.
struct Target {
  std::string name;
  std::vector<std::string> seeds;  ///< contents
  std::vector<std::string> words;  ///< of its format, put in at random
  /// Reads the file of this name as the program does. Throws UserError when it refuses it; anything
  /// else that is thrown is a failure. `random` chooses options.
  std::function<void(const std::string& path, Random& random)> read;
  std::string file;      ///< name of the file, for readers that look at its end
  bool is_hdf5 = false;  ///< every other change is made through HDF5
};

/// Readers of text: records, target spectra, tables of impacts, scenes.
std::vector<Target> text_targets();
/// Readers of matrices and of what a run left, with seeds made in `folder`.
std::vector<Target> state_targets(const std::string& folder);

}  // namespace pounding::fuzz
