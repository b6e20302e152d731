#include "spectra/acceptance.h"

#include <cstdlib>
#include <filesystem>
#include <unistd.h>
#include <vector>

#include "common/error.h"

namespace pounding {

void judge_motions(std::span<const std::string> words) {
  namespace fs = std::filesystem;
  const fs::path program = fs::read_symlink("/proc/self/exe");
  // Under a prefix the package is beside the scenes; else it is that of the sources.
  fs::path package = program.parent_path().parent_path() / "share/pounding/python";
  if (!fs::exists(package)) package = POUNDING_PYTHON;
  refuse_if(!fs::exists(package / "pounding" / "motion_rules.py"),
            "--accept: no Python package in " + package.string() + "; install it anew");
  const char* others = std::getenv("PYTHONPATH");
  const std::string places =
      package.string() + (others != nullptr ? std::string(":") + others : "");
  setenv("PYTHONPATH", places.c_str(), 1);
  std::vector<std::string> line{"python3", "-BPm", "pounding.motion_rules", program.string()};
  line.insert(line.end(), words.begin(), words.end());
  std::vector<char*> pointers;
  for (std::string& word : line) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv("/usr/bin/python3", pointers.data());
  throw UserError("--accept: /usr/bin/python3 cannot be started");
}

}  // namespace pounding
