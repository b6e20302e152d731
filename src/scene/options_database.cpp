#include "scene/options_database.h"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "common/error.h"
#include "common/parallel.h"
#include "scene/option_values.h"
#include "scene/options_file.h"

namespace pounding {
namespace {

constexpr std::uintmax_t largest_file = 10'000'000;  // bytes

std::string read_text(const std::string& option, const std::string& file) {
  const std::string what = "option -" + option + " " + file + ": ";
  std::error_code failure;
  if (!std::filesystem::is_regular_file(file, failure)) {
    throw UserError(
        what +
        "no such file (paths are relative to the folder in which the program runs, in a "
        "file of options first to the folder of that file)");
  }
  if (std::filesystem::file_size(file, failure) > largest_file) {
    throw UserError(what + "above 10 MB, that is no options file");
  }
  std::ifstream stream(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!stream || stream.bad()) throw UserError(what + "it cannot be read; look at its permissions");
  return text;
}

/// A path in a file of that folder: relative to the folder if there is something there, else as it
/// is, relative to where the program runs.
std::string found_path(const std::filesystem::path& folder, const std::string& path) {
  const std::filesystem::path beside = folder / path;  // an absolute path stays
  std::error_code failure;
  const bool there = !path.empty() && std::filesystem::exists(beside, failure);
  return there ? beside.lexically_normal().string() : path;
}

/// Whether the value of an option is the path of something that the program reads.
bool names_input(std::string_view option) {
  return std::ranges::any_of(option_table(), [option](const OptionRow& row) {
    if (row.unit != "file" && !row.form.starts_with("a folder with")) return false;
    const std::size_t last = row.pattern.rfind('>');
    return last == std::string_view::npos ? option == row.pattern
                                          : option.ends_with(row.pattern.substr(last + 1));
  });
}

/// A file of options to be read.
struct Waiting {
  std::string option;  ///< that names it
  std::string file;
  std::filesystem::path folder;  ///< of the file that includes it
};

}  // namespace

void find_inputs(MPI_Comm comm, const std::string& file, OptionsDatabase& options) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  for (auto& [name, value] : options) {
    const std::string path = trimmed(value);
    if (folder.empty() || !names_input(name) || path.empty() || path == "none") continue;
    std::string found;
    on_rank0(comm, [&] { found = found_path(folder, path); });
    broadcast(comm, found);
    value = found;
  }
}

OptionsDatabase read_options_database(MPI_Comm comm, const CommandLine& line,
                                      std::vector<std::string>* files) {
  OptionsDatabase database = line.options;
  std::deque<Waiting> waiting;
  for (const std::string& file : line.files) waiting.push_front({"options_file", file, {}});
  std::set<std::string> seen;
  const auto take_include = [&](OptionsDatabase& from, const std::filesystem::path& folder) {
    const auto found = from.find("include");
    if (found != from.end()) {
      waiting.push_back({"include", found->second, folder});
      from.erase(found);
    }
  };
  take_include(database, {});
  while (!waiting.empty()) {
    const Waiting next = waiting.front();
    waiting.pop_front();
    std::string file;
    std::string text;
    on_rank0(comm, [&] {
      file = found_path(next.folder, next.file);
      text = read_text(next.option, file);
    });
    broadcast(comm, file);
    if (!seen.insert(file).second) {
      throw UserError("option -" + next.option + " " + file + ": this file is read already");
    }
    broadcast(comm, text);
    if (files != nullptr) files->push_back(file);
    OptionsDatabase read = parse_options_file(text, file);
    find_inputs(comm, file, read);
    take_include(read, std::filesystem::path(file).parent_path());
    database.merge(read);
  }
  return database;
}

OptionsDatabase petsc_options(const OptionsDatabase& database) {
  OptionsDatabase options;
  for (const auto& [name, value] : database) {
    if (is_petsc_option(name)) options[name] = value;
  }
  return options;
}

}  // namespace pounding
