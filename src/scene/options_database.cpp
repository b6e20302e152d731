#include "scene/options_database.h"

#include <algorithm>
#include <cstring>
#include <deque>
#include <filesystem>
#include <set>

#include <petscsys.h>

#include "common/error.h"
#include "common/petsc.h"

namespace pounding {
namespace {

using OptionsHandle = PetscHandle<PetscOptions, PetscOptionsDestroy>;

/// All options that PETSc has not used itself.
OptionsDatabase entries(PetscOptions options) {
  PetscInt count = 0;
  char** names = nullptr;
  char** values = nullptr;
  POUNDING_PETSC(PetscOptionsLeftGet(options, &count, &names, &values));
  OptionsDatabase database;
  for (PetscInt i = 0; i < count; ++i) {
    database[names[i]] = values[i] == nullptr ? "" : values[i];
  }
  POUNDING_PETSC(PetscOptionsLeftRestore(options, &count, &names, &values));
  return database;
}

OptionsDatabase read_file(const std::string& option, const std::string& file) {
  if (!std::filesystem::is_regular_file(file)) {
    throw UserError("option -" + option + " " + file +
                    ": no such file (paths are relative to the folder in which the program runs)");
  }
  OptionsHandle options;
  POUNDING_PETSC(PetscOptionsCreate(options.out()));
  const std::string extension = std::filesystem::path(file).extension();
  const bool yaml = extension == ".yaml" || extension == ".yml";
  POUNDING_PETSC(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
  const PetscErrorCode error =
      yaml ? PetscOptionsInsertFileYAML(PETSC_COMM_WORLD, options.get(), file.c_str(), PETSC_TRUE)
           : PetscOptionsInsertFile(PETSC_COMM_WORLD, options.get(), file.c_str(), PETSC_TRUE);
  POUNDING_PETSC(PetscPopErrorHandler());
  if (error != 0) {
    throw UserError("option -" + option + " " + file + ": not a readable " +
                    (yaml ? "YAML" : "options") + " file; check indentation, colons and quotes");
  }
  return entries(options.get());
}

}  // namespace

std::vector<std::string> take_option_files(int& count, char** words) {
  std::vector<std::string> files;
  int kept = 1;
  for (int i = 1; i < count; ++i) {
    if (std::strcmp(words[i], "-options_file") == 0 && i + 1 < count) {
      files.emplace_back(words[++i]);
    } else {
      words[kept++] = words[i];
    }
  }
  count = kept;
  words[kept] = nullptr;
  return files;
}

OptionsDatabase read_options_database(const std::vector<std::string>& files) {
  OptionsDatabase database = entries(nullptr);
  std::deque<std::pair<std::string, std::string>> waiting;  // option and file
  for (const std::string& file : files) {
    waiting.emplace_front("options_file", file);
  }
  std::set<std::string> seen;
  const auto take_include = [&](OptionsDatabase& from) {
    const auto found = from.find("include");
    if (found != from.end()) {
      waiting.emplace_back("include", found->second);
      from.erase(found);
    }
  };
  take_include(database);
  while (!waiting.empty()) {
    const auto [option, file] = waiting.front();
    waiting.pop_front();
    if (!seen.insert(file).second) {
      throw UserError("option -" + option + " " + file + ": this file is read already");
    }
    OptionsDatabase read = read_file(option, file);
    take_include(read);
    for (const auto& [name, value] : read) {
      const bool fresh = database.try_emplace(name, value).second;
      if (fresh && is_petsc_option(name)) {
        POUNDING_PETSC(PetscOptionsSetValue(nullptr, ("-" + name).c_str(),
                                            value.empty() ? nullptr : value.c_str()));
      }
    }
  }
  return database;
}

}  // namespace pounding
