#include "scene/command_line.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>

#include "common/error.h"
#include "common/version.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

/// Names begin with a letter after the dash; -1, -.5 and -inf are values.
bool is_option(const std::string& word) {
  const std::size_t first = word.starts_with("--") ? 2 : 1;
  return word.size() > first && word[0] == '-' &&
         std::isalpha(static_cast<unsigned char>(word[first])) != 0 && word != "-inf" &&
         word != "-nan" && word != "-infinity";
}

bool is_one_of(const std::string& word, std::initializer_list<const char*> words) {
  return std::ranges::find(words, word) != words.end();
}

[[noreturn]] void refuse_stray(const std::string& word) {
  const std::string extension = std::filesystem::path(word).extension();
  const std::size_t equals = word.find('=');
  std::string advice = "; names of options begin with a dash, and each takes one value";
  if (extension == ".yaml" || extension == ".yml") {
    advice = "; did you mean -options_file " + shown_value(word) + "?";
  } else if (equals != std::string::npos && equals > 0) {
    advice = "; did you mean -" + shown_value(word.substr(0, equals)) + " " +
             shown_value(word.substr(equals + 1)) + "?";
  }
  throw UserError("'" + shown_value(word) + "' on the command line is no option" + advice);
}

void refuse_joined(const std::string& word) {
  const std::size_t equals = word.find('=');
  refuse_if(equals != std::string::npos, "'" + shown_value(word) + "' on the command line: write " +
                                             shown_value(word.substr(0, equals)) + " " +
                                             shown_value(word.substr(equals + 1)) +
                                             ", with a blank");
}

}  // namespace

CommandLine read_command_line(std::span<const std::string> words) {
  CommandLine line;
  const auto asked = std::ranges::find_if(words, [](const auto& word) {
    return is_one_of(word, {"-help", "--help", "-h"});
  });
  line.help = asked != words.end();
  if (line.help && asked + 1 != words.end() && !is_option(asked[1])) line.help_about = asked[1];
  line.help_json = std::ranges::find(words, "-help_json") != words.end();
  line.version = std::ranges::any_of(words, [](const auto& word) {
    return is_one_of(word, {"-version", "--version"});
  });
  for (std::size_t i = 0; i < words.size() && !line.asks(); ++i) {
    const std::string& word = words[i];
    if (!is_option(word)) refuse_stray(word);
    refuse_joined(word);
    const bool has_value = i + 1 < words.size() && !is_option(words[i + 1]);
    const std::string value = has_value ? words[++i] : "";
    if (word != "-options_file") {
      line.options[word.substr(1)] = value;
    } else if (value.empty()) {
      throw UserError("option -options_file needs a file: -options_file case.yaml");
    } else {
      line.files.push_back(value);
    }
  }
  return line;
}

std::string version_text() {
  std::string text = std::string("pounding ") + program_version() + " (" + program_commit() + ")\n";
  for (const auto& [name, version] : library_versions()) text += "  " + name + " " + version + "\n";
  return text;
}

std::vector<std::string> ignored_variables() {
  std::vector<std::string> lines;
  for (const char* name : {"PETSC_OPTIONS", "PETSC_OPTIONS_YAML"}) {
    const char* value = std::getenv(name);
    if (value != nullptr && !trimmed(value).empty()) {
      lines.push_back("the variable " + std::string(name) + " (" + shown_value(value) +
                      ") is not read; give its options on the command line");
    }
  }
  return lines;
}

SceneOrigin origin_of(const CommandLine& line, const std::vector<std::string>& files) {
  SceneOrigin origin{files, {}};
  for (const auto& [name, value] : line.options) {
    const bool silent = may_differ(name, Comparison::scene) || name.ends_with("_modal_basis");
    if (!files.empty() && name != "include" && !silent) {
      origin.overrides.emplace_back(name, trimmed(value));
    }
  }
  return origin;
}

std::string overrides_text(const SceneOrigin& origin) {
  std::string text;
  for (const auto& [name, value] : origin.overrides) {
    if (name == "title") continue;
    text += (text.empty() ? "with " : ", ") + name;
    if (!value.empty()) text += " " + value;
  }
  return text;
}

}  // namespace pounding
