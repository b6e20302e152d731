#include "scene/options_database.h"

#include <deque>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "common/error.h"
#include "common/parallel.h"
#include "scene/options_file.h"

namespace pounding {
namespace {

constexpr std::uintmax_t largest_file = 10'000'000;  // bytes

std::string read_text(const std::string& option, const std::string& file) {
  const std::string what = "option -" + option + " " + file + ": ";
  std::error_code failure;
  if (!std::filesystem::is_regular_file(file, failure)) {
    throw UserError(what +
                    "no such file (paths are relative to the folder in which the program runs)");
  }
  if (std::filesystem::file_size(file, failure) > largest_file) {
    throw UserError(what + "above 10 MB, that is no options file");
  }
  std::ifstream stream(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!stream || stream.bad()) throw UserError(what + "it cannot be read; look at its permissions");
  return text;
}

}  // namespace

OptionsDatabase read_options_database(MPI_Comm comm, const CommandLine& line) {
  OptionsDatabase database = line.options;
  std::deque<std::pair<std::string, std::string>> waiting;  // option and file
  for (const std::string& file : line.files) waiting.emplace_front("options_file", file);
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
    const std::string option = waiting.front().first;
    const std::string file = waiting.front().second;
    waiting.pop_front();
    if (!seen.insert(file).second) {
      throw UserError("option -" + option + " " + file + ": this file is read already");
    }
    std::string text;
    on_rank0(comm, [&] { text = read_text(option, file); });
    broadcast(comm, text);
    OptionsDatabase read = parse_options_file(text, file);
    take_include(read);
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
