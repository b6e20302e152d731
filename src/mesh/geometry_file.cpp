#include "mesh/geometry_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <sstream>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "mesh/element_numbers.h"

namespace pounding {
namespace {

/// A word, a text between quotes, or one other character of Gmsh's language.
struct Token {
  enum class Kind { word, text, sign } kind;
  std::string value;
  int line = 0;
};

/// Gmsh takes a longer text for the end of it.
constexpr std::size_t longest_text = 1000;

/// Files within files.
constexpr int deepest = 32;

/// Words of the .geo language that run a command or write a file by themselves.
constexpr auto commands = std::to_array<std::string_view>(
    {"SystemCall", "System", "NonBlockingSystemCall", "OnelabRun", "SendToServer", "CreateDir",
     "Print", "Save", "Plugin", "Parse"});

/// Words of the .geo language that read another file as this one is read.
constexpr auto inclusions =
    std::to_array<std::string_view>({"Include", "Merge", "MergeWithBoundingBox"});

/// Meshes that Gmsh reads by the ending of their names, in parsers that run nothing.
constexpr auto meshes = std::to_array<std::string_view>({".unv", ".mesh", ".bdf", ".nas"});

/// Shapes that a geometry may merge, likewise.
constexpr auto shapes =
    std::to_array<std::string_view>({".stl", ".brep", ".step", ".stp", ".iges", ".igs"});

bool contains(const auto& list, const auto& value) {
  return std::ranges::find(list, value) != list.end();
}

class Inspection {
 public:
  Inspection(std::string option, bool allow_commands)
      : option_(std::move(option)), allow_commands_(allow_commands) {}

  void inspect(const std::filesystem::path& file, int depth) {
    if (depth > deepest) refuse(file, 0, "files that include each other without end");
    if (!allow_commands_ && std::filesystem::exists(file.string() + ".opt")) {
      refuse(file, 0,
             "an options file " + file.string() +
                 ".opt stands beside it, whose commands "
                 "Gmsh would run; remove it or give -allow_geo_commands");
    }
    if (file.extension() == ".msh") {
      check_header(file);
      check_element_numbers(option_, file);
    } else if (!contains(meshes, file.extension().string()) &&
               !contains(shapes, file.extension().string())) {
      inspect_geometry(file, depth);
    }
  }

  [[noreturn]] void refuse(const std::filesystem::path& file, int line,
                           const std::string& why) const {
    throw UserError("option " + option_ + ": " + file.string() +
                    (line > 0 ? " line " + std::to_string(line) : "") + ": " + why);
  }

  GeometryWords found;
  std::vector<std::filesystem::path> included;

 private:
  void check_header(const std::filesystem::path& file) const {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    const bool known = line.starts_with("$MeshFormat") || line.starts_with("$Comments") ||
                       line.starts_with("$NOD") || line.starts_with("$NOE");
    if (!known) {
      refuse(file, 1,
             "a .msh file begins with $MeshFormat, this one does not; export the mesh "
             "again");
    }
  }

  void inspect_geometry(const std::filesystem::path& file, int depth) {
    const std::vector<Token> tokens = tokens_of(file);
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      if (tokens[i].kind != Token::Kind::word) continue;
      found.words.insert(tokens[i].value);
      const bool is_option = i + 1 < tokens.size() && tokens[i + 1].value == ".";
      if (!allow_commands_ && !is_option &&
          (contains(commands, tokens[i].value) || prints_to_file(tokens, i))) {
        refuse(file, tokens[i].line,
               "'" + tokens[i].value +
                   "' runs a command or writes a file; remove it, or give "
                   "-allow_geo_commands if you trust the file");
      }
      if (contains(inclusions, tokens[i].value)) follow(file, tokens, i, depth);
    }
  }

  void follow(const std::filesystem::path& file, const std::vector<Token>& tokens, std::size_t i,
              int depth) {
    const bool plain = i + 2 < tokens.size() && tokens[i + 1].kind == Token::Kind::text &&
                       tokens[i + 2].value == ";";
    if (plain) {
      const std::filesystem::path other = file.parent_path() / tokens[i + 1].value;
      if (!std::filesystem::is_regular_file(other)) {
        refuse(file, tokens[i].line, "the file " + other.string() + " that it takes in is missing");
      }
      included.push_back(other);
      inspect(other, depth + 1);
    } else if (!allow_commands_) {
      refuse(file, tokens[i].line,
             "'" + tokens[i].value +
                 "' of a file whose name is computed, so that it cannot be "
                 "looked at; write its name out, or give -allow_geo_commands if you trust it");
    }
  }

  /// Printf(...) > "file".
  static bool prints_to_file(const std::vector<Token>& tokens, std::size_t i) {
    if (tokens[i].value != "Printf" && tokens[i].value != "Error" && tokens[i].value != "Warning") {
      return false;
    }
    int open = 0;
    for (++i; i < tokens.size() && tokens[i].value != ";"; ++i) {
      if (tokens[i].kind == Token::Kind::sign) {
        open += tokens[i].value == "(" || tokens[i].value == "[" ? 1 : 0;
        open -= tokens[i].value == ")" || tokens[i].value == "]" ? 1 : 0;
        if (open <= 0 && tokens[i].value == ">") return true;
      }
    }
    return false;
  }

  std::vector<Token> tokens_of(const std::filesystem::path& file) const {
    std::ifstream stream(file, std::ios::binary);
    std::stringstream buffer;
    buffer << stream.rdbuf();
    const std::string text = buffer.str();
    std::vector<Token> tokens;
    int line = 1;
    for (std::size_t i = 0; i < text.size();) {
      const auto c = static_cast<unsigned char>(text[i]);
      std::size_t end = i + 1;
      if (std::iscntrl(c) != 0 && std::isspace(c) == 0) {
        refuse(file, line, "a control character; a geometry is plain text");
      } else if (text.compare(i, 2, "//") == 0) {
        end = text.find('\n', i);
      } else if (text.compare(i, 2, "/*") == 0) {
        end = text.find("*/", i + 2);
        end = end == std::string::npos ? end : end + 2;
      } else if (c == '"' || c == '\'') {
        end = text.find(static_cast<char>(c), i + 1);
        if (end == std::string::npos || end - i > longest_text) {
          refuse(file, line,
                 "a text between quotes without end, or longer than " +
                     std::to_string(longest_text) + " characters");
        }
        tokens.push_back({Token::Kind::text, text.substr(i + 1, end - i - 1), line});
        ++end;
      } else if (std::isalpha(c) != 0 || c == '_' || c >= 0x80) {
        while (end < text.size() &&
               (std::isalnum(static_cast<unsigned char>(text[end])) != 0 || text[end] == '_')) {
          ++end;
        }
        tokens.push_back({Token::Kind::word, text.substr(i, end - i), line});
      } else if (std::isspace(c) == 0) {
        tokens.push_back({Token::Kind::sign, std::string(1, text[i]), line});
      }
      end = std::min(end, text.size());
      line += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                          text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
      i = end;
    }
    return tokens;
  }

  std::string option_;
  bool allow_commands_;
};

}  // namespace

std::vector<std::filesystem::path> files_included_in(const std::filesystem::path& file) {
  if (!is_geometry(file) || !std::filesystem::is_regular_file(file)) return {};
  Inspection inspection("", true);
  try {
    inspection.inspect(file, 0);
  } catch (const UserError&) {
    return {};
  }
  return std::move(inspection.included);
}

bool is_geometry(const std::filesystem::path& file) {
  return file.extension() == ".geo";
}

GeometryWords inspect_mesh_file(const std::string& option, const std::filesystem::path& file,
                                bool allow_commands) {
  Inspection inspection(option, allow_commands);
  if (!std::filesystem::is_regular_file(file)) {
    throw UserError("option " + option +
                    ": no such file; give the path of a Gmsh .geo or .msh file");
  }
  if (file.string().find_first_of("\"\\\n\r") != std::string::npos) {
    throw UserError("option " + option +
                    ": a path with a quote, a backslash or a line's end; rename the file");
  }
  const std::string ending = file.extension().string();
  if (!is_geometry(file) && ending != ".msh" && !contains(meshes, ending)) {
    throw UserError("option " + option + ": files with the ending '" + ending +
                    "' are not read; give a Gmsh .geo or .msh file (or .unv, .mesh, .bdf, .nas)");
  }
  inspection.inspect(file, 0);
  return std::move(inspection.found);
}

}  // namespace pounding
