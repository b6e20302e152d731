#include "scene/standard_sections.h"

#include <array>
#include <standard_section_rows.h>

#include "scene/option_values.h"

namespace pounding {
namespace {

/// A section as its standard lists it, see standard_sections.csv.
struct Row {
  std::string name;
  std::array<double, 6> size{};
};

/// Rows of standard_sections.csv, which CMake makes the text `standard_section_rows`.
const std::vector<Row>& rows() {
  static const std::vector<Row> all = [] {
    std::vector<Row> found;
    for (const std::string& line : split(standard_section_rows, '\n')) {
      if (line.empty() || line.front() == '#') continue;
      const std::vector<std::string> words = split(line, ',');
      Row& row = found.emplace_back();
      row.name = words.front();
      for (std::size_t i = 1; i < words.size(); ++i) row.size.at(i - 1) = *parse_real(words[i]);
    }
    return found;
  }();
  return all;
}

constexpr double millimetre = 1e-3;
constexpr double inch = 0.0254;

SectionNumbers numbers_of(const Row& row) {
  const auto& size = row.size;
  if (row.name.front() == 'W') {
    return i_section({size[0] * inch, size[1] * inch, size[2] * inch, size[3] * inch,
                      (size[4] - size[3]) * inch, 0});
  }
  const RolledShape shape{size[0] * millimetre, size[1] * millimetre, size[2] * millimetre,
                          size[3] * millimetre, size[4] * millimetre, size[5] * millimetre};
  return row.name.front() == 'U' ? channel_section(shape) : i_section(shape);
}

/// A length as sections write it: 8, 168.3, 1/2, 3-1/2.
std::optional<double> parse_size(const std::string& text) {
  const std::size_t dash = text.find('-');
  const std::size_t bar = text.find('/');
  if (bar == std::string::npos) return parse_real(text);
  const std::size_t from = dash == std::string::npos ? 0 : dash + 1;
  if (bar < from) return std::nullopt;
  const auto whole = from == 0 ? std::optional<double>(0) : parse_real(text.substr(0, dash));
  const auto above = parse_real(text.substr(from, bar - from));
  const auto below = parse_real(text.substr(bar + 1));
  if (!whole || !above || !below || *below <= 0) return std::nullopt;
  return *whole + *above / *below;
}

/// The sizes behind the letters of a section, if there are `count`.
std::optional<std::vector<double>> sizes_of(const std::string& name, std::string_view letters,
                                            std::size_t count) {
  if (!name.starts_with(letters)) return std::nullopt;
  std::vector<double> sizes;
  for (const std::string& word : split(name.substr(letters.size()), 'X')) {
    const auto size = parse_size(word);
    if (!size || *size <= 0) return std::nullopt;
    sizes.push_back(*size);
  }
  if (sizes.size() != count) return std::nullopt;
  return sizes;
}

/// The sizes behind the letters of a tube, if there are `count` and it has a hole.
std::optional<std::vector<double>> tube_sizes(const std::string& name, std::string_view letters,
                                              std::size_t count) {
  const auto sizes = sizes_of(name, letters, count);
  // A corner of two walls outside leaves room for the wall opposite.
  for (std::size_t i = 0; sizes && i + 1 < count; ++i) {
    if ((*sizes)[i] < 4 * sizes->back()) return std::nullopt;
  }
  return sizes;
}

/// Solid sections.
std::optional<SectionNumbers> solid(const std::string& name) {
  if (const auto s = sizes_of(name, "RECT", 2)) {
    return rectangular_section((*s)[0] * millimetre, (*s)[1] * millimetre);
  }
  if (const auto s = sizes_of(name, "ROUND", 1)) return circular_section((*s)[0] * millimetre);
  return std::nullopt;
}

/// Tubes: EN 10210 with corners of 1.5 t outside and 1.0 t inside; HSS with 0.93 of the nominal
/// wall, corners of 2 t and 1 t, as AISC lists them.
std::optional<SectionNumbers> tube(const std::string& name) {
  if (const auto s = tube_sizes(name, "SHS", 2)) {
    const double side = (*s)[0] * millimetre;
    const double t = (*s)[1] * millimetre;
    return hollow_section(side, side, t, 1.5 * t, t);
  }
  if (const auto s = tube_sizes(name, "RHS", 3)) {
    const double t = (*s)[2] * millimetre;
    return hollow_section((*s)[0] * millimetre, (*s)[1] * millimetre, t, 1.5 * t, t);
  }
  if (const auto s = tube_sizes(name, "CHS", 2)) {
    return round_section((*s)[0] * millimetre, (*s)[1] * millimetre);
  }
  if (const auto s = tube_sizes(name, "HSS", 3)) {
    const double t = 0.93 * (*s)[2] * inch;
    return hollow_section((*s)[0] * inch, (*s)[1] * inch, t, 2 * t, t);
  }
  return std::nullopt;
}

/// HE160B is HEB160.
std::string usual_order(const std::string& name) {
  const bool turned = name.size() > 3 && name.starts_with("HE") && name[2] >= '0' &&
                      name[2] <= '9' &&
                      std::string_view("ABM").find(name.back()) != std::string_view::npos;
  return turned ? "HE" + name.substr(name.size() - 1) + name.substr(2, name.size() - 3) : name;
}

}  // namespace

std::optional<SectionNumbers> standard_section(std::string_view name) {
  const std::string wanted = usual_order(upper_case(name));
  for (const Row& row : rows()) {
    if (row.name == wanted) return numbers_of(row);
  }
  const auto numbers = tube(wanted);
  return numbers ? numbers : solid(wanted);
}

std::vector<std::string> standard_section_names() {
  std::vector<std::string> names;
  for (const Row& row : rows()) names.push_back(row.name);
  return names;
}

}  // namespace pounding
