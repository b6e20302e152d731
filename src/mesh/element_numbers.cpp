#include "mesh/element_numbers.h"

#include <cstdlib>
#include <fstream>
#include <unordered_set>

#include "common/error.h"

namespace pounding {
namespace {

/// Moves behind the line that begins with `head`; false at the file's end.
bool find_line(std::istream& stream, const std::string& head) {
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(head)) return true;
  }
  return false;
}

}  // namespace

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

}  // namespace pounding
