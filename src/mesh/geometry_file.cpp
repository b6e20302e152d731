#include "mesh/geometry_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>
#include <unordered_set>

#include "common/error.h"

namespace pounding {
namespace {

/// Meshes that Gmsh reads by the ending of their names.
constexpr auto meshes = std::to_array<std::string_view>({".msh", ".mesh", ".bdf", ".nas"});

/// Models of other programs that run/import makes scenes of, by the ending of their names.
constexpr auto models = std::to_array<std::string_view>(
    {".inp", ".unv", ".med", ".rmed", ".mmed", ".cdb", ".dat", ".k", ".key", ".dyn"});

/// Shapes that a geometry may merge, by the ending of their names.
constexpr auto shapes =
    std::to_array<std::string_view>({".stl", ".brep", ".step", ".stp", ".iges", ".igs"});

bool contains(const auto& list, const auto& value) {
  return std::ranges::find(list, value) != list.end();
}

/// Gmsh takes a .msh file that does not begin as one for a geometry.
void check_header(const std::string& option, const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  const bool known = line.starts_with("$MeshFormat") || line.starts_with("$Comments") ||
                     line.starts_with("$NOD") || line.starts_with("$NOE");
  refuse_if(!known,
            "option " + option + ": " + file.string() +
                " line 1: a .msh file begins with $MeshFormat, this one does not; export the "
                "mesh again");
}

/// Gmsh passes over statements of a geometry that is one line without an end.
void check_line_end(const std::string& option, const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  if (!stream.eof() || line.empty()) return;
  throw UserError(
      "option " + option + ": " + file.string() +
      " line 1: Gmsh may pass over a geometry of one line that has no end; end the line");
}

/// Where the comment, text, word or sign that begins at `i` ends.
std::size_t end_of(const std::string& text, std::size_t i) {
  const auto is_part = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c >= 0x80;
  };
  const auto c = static_cast<unsigned char>(text[i]);
  std::size_t end = i + 1;
  if (text.compare(i, 2, "//") == 0) {
    end = text.find('\n', i);
  } else if (text.compare(i, 2, "/*") == 0) {
    end = text.find("*/", i + 2);
    end = end == std::string::npos ? end : end + 2;
  } else if (c == '"' || c == '\'') {
    end = text.find(text[i], i + 1);
    end = end == std::string::npos ? end : end + 1;
  } else if (is_part(c)) {
    while (end < text.size() && is_part(static_cast<unsigned char>(text[end]))) ++end;
  }
  return std::min(end, text.size());
}

/// Moves behind the line that begins with `head`; false at the file's end.
bool find_line(std::istream& stream, const std::string& head) {
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(head)) return true;
  }
  return false;
}

/// Throws UserError, with `option` at its head, where a text file of Gmsh's format 2 lists two
/// elements under one number: Gmsh keeps one of them in silence. Serial.
void check_element_numbers(const std::string& option, const std::filesystem::path& file) {
  std::ifstream stream(file);
  double version = 0;
  int binary = 0;
  if (!find_line(stream, "$MeshFormat") || !(stream >> version >> binary) || version >= 3 ||
      binary != 0 || !find_line(stream, "$Elements")) {
    return;
  }
  std::string line;
  std::getline(stream, line);  // how many
  std::unordered_set<long long> numbers;
  while (std::getline(stream, line) && !line.starts_with('$')) {
    char* end = nullptr;
    const long long number = std::strtoll(line.c_str(), &end, 10);
    if (end != line.c_str() && !numbers.insert(number).second) {
      throw UserError("option " + option + ": element " + std::to_string(number) +
                      " is listed twice; give each element one line and a number of its own");
    }
  }
}

}  // namespace

bool is_geometry(const std::filesystem::path& file) {
  return file.extension() == ".geo";
}

void check_mesh_file(const std::string& option, const std::filesystem::path& file) {
  refuse_if(!std::filesystem::is_regular_file(file),
            "option " + option + ": no such file; give the path of a Gmsh .geo or .msh file");
  const std::string ending = file.extension().string();
  refuse_if(contains(models, ending),
            "option " + option + ": files with the ending '" + ending +
                "' are not meshes of Gmsh; run/import makes a scene and a .msh of it "
                "(docs/manual/import.md)");
  refuse_if(!is_geometry(file) && !contains(meshes, ending),
            "option " + option + ": files with the ending '" + ending +
                "' are not read; give a Gmsh .geo or .msh file (or .mesh, .bdf, .nas)");
  if (ending == ".msh") check_header(option, file);
  if (is_geometry(file)) check_line_end(option, file);
}

void check_opened_files(const std::string& option, std::span<const std::string> files) {
  for (const std::filesystem::path file : files) {
    if (file.extension() == ".msh") check_element_numbers(option, file);
    if (is_geometry(file)) check_line_end(option, file);
  }
}

std::set<std::string> geometry_words(std::span<const std::string> files) {
  std::set<std::string> words;
  for (const std::filesystem::path file : files) {
    const std::string ending = file.extension().string();
    if (contains(meshes, ending) || contains(shapes, ending)) continue;
    std::stringstream buffer;
    buffer << std::ifstream(file, std::ios::binary).rdbuf();
    const std::string text = buffer.str();
    for (std::size_t i = 0; i < text.size();) {
      const std::size_t end = end_of(text, i);
      const auto c = static_cast<unsigned char>(text[i]);
      if (std::isalpha(c) != 0 || c == '_' || c >= 0x80) words.insert(text.substr(i, end - i));
      i = end;
    }
  }
  return words;
}

}  // namespace pounding
