#include "driver/folder_checks.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <unistd.h>

#include "common/error.h"
#include "common/finite_file.h"
#include "output/result_folder.h"
#include "scene/option_values.h"
#include "scene/resolved_options.h"

namespace pounding {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_folder(const std::string& option, const std::string& folder,
                                const std::string& why) {
  throw UserError("option -" + option + " " + folder +
                  ": the folder cannot be created or written (" + why + "); give another one");
}

void try_writing(const std::string& option, const std::string& folder) {
  std::string trial = folder + "/.trial-XXXXXX";
  const int file = mkstemp(trial.data());
  const bool written = file >= 0 && write(file, "trial\n", 6) == 6;
  const std::string why = std::strerror(errno);
  if (file >= 0) {
    close(file);
    unlink(trial.c_str());
  }
  if (!written) refuse_folder(option, folder, why);
}

bool tells_the_scene(const std::string& option) {
  return option == "structures" || option == "contacts" || option.ends_with("_mesh") ||
         option.ends_with("_mesh_set") || option.ends_with("_matrices") ||
         option.starts_with("motion_");
}

std::map<std::string, std::string> scene_options(const std::string& resolved) {
  std::map<std::string, std::string> options;
  for (const auto& [name, value] : resolved_values(resolved)) {
    if (tells_the_scene(name)) options[name] = value;
  }
  return options;
}

}  // namespace

void try_folder(const std::string& option, const std::string& folder) {
  std::error_code failure;
  const std::vector<fs::path> missing = missing_folders(fs::path(folder).lexically_normal());
  fs::create_directories(folder, failure);
  if (failure) refuse_folder(option, folder, failure.message());
  if (!fs::is_directory(folder, failure)) refuse_folder(option, folder, "it is a file");
  const auto restore = [&missing] {
    std::error_code ignored;
    for (const fs::path& made : missing) fs::remove(made, ignored);
  };
  try {
    try_writing(option, folder);
  } catch (const UserError&) {
    restore();
    throw;
  }
  restore();
}

std::vector<std::string> replaced_results(const Scene& scene, const std::string& resolved) {
  require_finite_file(scene.output + "/resolved.yaml");
  std::ifstream file(scene.output + "/resolved.yaml");
  if (!file || !scene.restart.empty()) return {};
  std::ostringstream text;
  text << file.rdbuf();
  const auto before = scene_options(text.str());
  const auto now = scene_options(resolved);
  if (before.empty() || before == now) return {};
  const auto other = std::ranges::find_if(now, [&before](const auto& option) {
    const auto found = before.find(option.first);
    return found != before.end() && found->second != option.second;
  });
  const std::string what = other == now.end()
                               ? "other structures or motions"
                               : "-" + other->first + " " + shown_value(before.at(other->first)) +
                                     ", now " + shown_value(other->second);
  return {"the folder " + scene.output + " holds results of another scene (" + what +
          "); this run replaces them"};
}

}  // namespace pounding
