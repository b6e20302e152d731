#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>
#include <utility>

#include <gtest/gtest.h>

#include "support/refusal.h"
#include "support/source_folder.h"

namespace pounding::testing_support {

/// A file of the reference data; empty when the data are not there.
inline std::string shared_file(const std::string& name) {
  const char* set = std::getenv("POUNDING_SHARED");
  const std::filesystem::path folder = set ? set : source_folder() + "/../shared";
  return std::filesystem::exists(folder / name) ? (folder / name).string() : std::string();
}

/// A folder of its own for the files of a test, removed afterwards.
class MotionFiles : public ::testing::Test {
 protected:
  MotionFiles()
      : folder_(std::filesystem::temp_directory_path() /
                ("pounding-motion-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~MotionFiles() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    const auto path = folder_ / name;
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
  }

  std::filesystem::path folder_;
};

/// The message of the UserError that `action` throws; it must be one line.
template <class Action>
std::string refusal(Action&& action) {
  const std::string message = refusal_of(std::forward<Action>(action));
  if (message.empty()) ADD_FAILURE() << "accepted";
  return message;
}

}  // namespace pounding::testing_support
