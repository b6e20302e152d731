#include "scene/standard_sections.h"

#include <array>
#include <span>

#include "scene/option_values.h"

namespace pounding {
namespace {

/// A section as its standard lists it: height, width, web, flange, radius of the root, then that
/// of the toe of a channel; of W in the last place the distance from the outside of the flange to
/// the end of the fillet.
struct Row {
  std::string_view name;
  std::array<double, 6> size;
};

/// EN 10365 [mm].
// clang-format off
constexpr std::array ipe{
    Row{"IPE80", {80, 46, 3.8, 5.2, 5}}, Row{"IPE100", {100, 55, 4.1, 5.7, 7}},
    Row{"IPE120", {120, 64, 4.4, 6.3, 7}}, Row{"IPE140", {140, 73, 4.7, 6.9, 7}},
    Row{"IPE160", {160, 82, 5, 7.4, 9}}, Row{"IPE180", {180, 91, 5.3, 8, 9}},
    Row{"IPE200", {200, 100, 5.6, 8.5, 12}}, Row{"IPE220", {220, 110, 5.9, 9.2, 12}},
    Row{"IPE240", {240, 120, 6.2, 9.8, 15}}, Row{"IPE270", {270, 135, 6.6, 10.2, 15}},
    Row{"IPE300", {300, 150, 7.1, 10.7, 15}}, Row{"IPE330", {330, 160, 7.5, 11.5, 18}},
    Row{"IPE360", {360, 170, 8, 12.7, 18}}, Row{"IPE400", {400, 180, 8.6, 13.5, 21}},
    Row{"IPE450", {450, 190, 9.4, 14.6, 21}}, Row{"IPE500", {500, 200, 10.2, 16, 21}},
    Row{"IPE550", {550, 210, 11.1, 17.2, 24}}, Row{"IPE600", {600, 220, 12, 19, 24}},
};
// clang-format on

// clang-format off
constexpr std::array hea{
    Row{"HEA100", {96, 100, 5, 8, 12}}, Row{"HEA120", {114, 120, 5, 8, 12}},
    Row{"HEA140", {133, 140, 5.5, 8.5, 12}}, Row{"HEA160", {152, 160, 6, 9, 15}},
    Row{"HEA180", {171, 180, 6, 9.5, 15}}, Row{"HEA200", {190, 200, 6.5, 10, 18}},
    Row{"HEA220", {210, 220, 7, 11, 18}}, Row{"HEA240", {230, 240, 7.5, 12, 21}},
    Row{"HEA260", {250, 260, 7.5, 12.5, 24}}, Row{"HEA280", {270, 280, 8, 13, 24}},
    Row{"HEA300", {290, 300, 8.5, 14, 27}}, Row{"HEA320", {310, 300, 9, 15.5, 27}},
    Row{"HEA340", {330, 300, 9.5, 16.5, 27}}, Row{"HEA360", {350, 300, 10, 17.5, 27}},
    Row{"HEA400", {390, 300, 11, 19, 27}}, Row{"HEA450", {440, 300, 11.5, 21, 27}},
    Row{"HEA500", {490, 300, 12, 23, 27}}, Row{"HEA550", {540, 300, 12.5, 24, 27}},
    Row{"HEA600", {590, 300, 13, 25, 27}}, Row{"HEA650", {640, 300, 13.5, 26, 27}},
    Row{"HEA700", {690, 300, 14.5, 27, 27}}, Row{"HEA800", {790, 300, 15, 28, 30}},
    Row{"HEA900", {890, 300, 16, 30, 30}}, Row{"HEA1000", {990, 300, 16.5, 31, 30}},
};
// clang-format on

// clang-format off
constexpr std::array heb{
    Row{"HEB100", {100, 100, 6, 10, 12}}, Row{"HEB120", {120, 120, 6.5, 11, 12}},
    Row{"HEB140", {140, 140, 7, 12, 12}}, Row{"HEB160", {160, 160, 8, 13, 15}},
    Row{"HEB180", {180, 180, 8.5, 14, 15}}, Row{"HEB200", {200, 200, 9, 15, 18}},
    Row{"HEB220", {220, 220, 9.5, 16, 18}}, Row{"HEB240", {240, 240, 10, 17, 21}},
    Row{"HEB260", {260, 260, 10, 17.5, 24}}, Row{"HEB280", {280, 280, 10.5, 18, 24}},
    Row{"HEB300", {300, 300, 11, 19, 27}}, Row{"HEB320", {320, 300, 11.5, 20.5, 27}},
    Row{"HEB340", {340, 300, 12, 21.5, 27}}, Row{"HEB360", {360, 300, 12.5, 22.5, 27}},
    Row{"HEB400", {400, 300, 13.5, 24, 27}}, Row{"HEB450", {450, 300, 14, 26, 27}},
    Row{"HEB500", {500, 300, 14.5, 28, 27}}, Row{"HEB550", {550, 300, 15, 29, 27}},
    Row{"HEB600", {600, 300, 15.5, 30, 27}}, Row{"HEB650", {650, 300, 16, 31, 27}},
    Row{"HEB700", {700, 300, 17, 32, 27}}, Row{"HEB800", {800, 300, 17.5, 33, 30}},
    Row{"HEB900", {900, 300, 18.5, 35, 30}}, Row{"HEB1000", {1000, 300, 19, 36, 30}},
};
// clang-format on

// clang-format off
constexpr std::array hem{
    Row{"HEM100", {120, 106, 12, 20, 12}}, Row{"HEM120", {140, 126, 12.5, 21, 12}},
    Row{"HEM140", {160, 146, 13, 22, 12}}, Row{"HEM160", {180, 166, 14, 23, 15}},
    Row{"HEM180", {200, 186, 14.5, 24, 15}}, Row{"HEM200", {220, 206, 15, 25, 18}},
    Row{"HEM220", {240, 226, 15.5, 26, 18}}, Row{"HEM240", {270, 248, 18, 32, 21}},
    Row{"HEM260", {290, 268, 18, 32.5, 24}}, Row{"HEM280", {310, 288, 18.5, 33, 24}},
    Row{"HEM300", {340, 310, 21, 39, 27}}, Row{"HEM400", {432, 307, 21, 40, 27}},
    Row{"HEM500", {524, 306, 21, 40, 27}}, Row{"HEM600", {620, 305, 21, 40, 27}},
};
// clang-format on

// clang-format off
constexpr std::array upn{
    Row{"UPN80", {80, 45, 6, 8, 8, 4}}, Row{"UPN100", {100, 50, 6, 8.5, 8.5, 4.5}},
    Row{"UPN120", {120, 55, 7, 9, 9, 4.5}}, Row{"UPN140", {140, 60, 7, 10, 10, 5}},
    Row{"UPN160", {160, 65, 7.5, 10.5, 10.5, 5.5}}, Row{"UPN180", {180, 70, 8, 11, 11, 5.5}},
    Row{"UPN200", {200, 75, 8.5, 11.5, 11.5, 6}}, Row{"UPN220", {220, 80, 9, 12.5, 12.5, 6.5}},
    Row{"UPN240", {240, 85, 9.5, 13, 13, 6.5}}, Row{"UPN260", {260, 90, 10, 14, 14, 7}},
    Row{"UPN280", {280, 95, 10, 15, 15, 7.5}}, Row{"UPN300", {300, 100, 10, 16, 16, 8}},
    Row{"UPN320", {320, 100, 14, 17.5, 17.5, 8.75}}, Row{"UPN350", {350, 100, 14, 16, 16, 8}},
    Row{"UPN380", {380, 102, 13.5, 16, 16, 8}}, Row{"UPN400", {400, 110, 14, 18, 18, 9}},
};
// clang-format on

// clang-format off
constexpr std::array w{
    Row{"W8X10", {7.89, 3.94, 0.17, 0.205, 0.505}}, Row{"W8X13", {7.99, 4, 0.23, 0.255, 0.555}},
    Row{"W8X15", {8.11, 4.02, 0.245, 0.315, 0.615}}, Row{"W8X18", {8.14, 5.25, 0.23, 0.33, 0.63}},
    Row{"W8X21", {8.28, 5.27, 0.25, 0.4, 0.7}}, Row{"W8X24", {7.93, 6.5, 0.245, 0.4, 0.794}},
    Row{"W8X28", {8.06, 6.54, 0.285, 0.465, 0.859}}, Row{"W8X31", {8, 8, 0.285, 0.435, 0.829}},
    Row{"W8X35", {8.12, 8.02, 0.31, 0.495, 0.889}}, Row{"W8X40", {8.25, 8.07, 0.36, 0.56, 0.954}},
    Row{"W8X48", {8.5, 8.11, 0.4, 0.685, 1.08}}, Row{"W8X58", {8.75, 8.22, 0.51, 0.81, 1.2}},
    Row{"W8X67", {9, 8.28, 0.57, 0.935, 1.33}},
    Row{"W10X12", {9.87, 3.96, 0.19, 0.21, 0.51}}, Row{"W10X15", {9.99, 4, 0.23, 0.27, 0.57}},
    Row{"W10X17", {10.1, 4.01, 0.24, 0.33, 0.63}}, Row{"W10X19", {10.2, 4.02, 0.25, 0.395, 0.695}},
    Row{"W10X22", {10.2, 5.75, 0.24, 0.36, 0.66}}, Row{"W10X26", {10.3, 5.77, 0.26, 0.44, 0.74}},
    Row{"W10X30", {10.5, 5.81, 0.3, 0.51, 0.81}}, Row{"W10X33", {9.73, 7.96, 0.29, 0.435, 0.935}},
    Row{"W10X39", {9.92, 7.99, 0.315, 0.53, 1.03}}, Row{"W10X45", {10.1, 8.02, 0.35, 0.62, 1.12}},
    Row{"W10X49", {10, 10, 0.34, 0.56, 1.06}}, Row{"W10X54", {10.1, 10, 0.37, 0.615, 1.12}},
    Row{"W10X60", {10.2, 10.1, 0.42, 0.68, 1.18}}, Row{"W10X68", {10.4, 10.1, 0.47, 0.77, 1.27}},
    Row{"W10X77", {10.6, 10.2, 0.53, 0.87, 1.37}}, Row{"W10X88", {10.8, 10.3, 0.605, 0.99, 1.49}},
    Row{"W10X100", {11.1, 10.3, 0.68, 1.12, 1.62}}, Row{"W10X112", {11.4, 10.4, 0.755, 1.25, 1.75}},
    Row{"W12X14", {11.9, 3.97, 0.2, 0.225, 0.525}}, Row{"W12X16", {12, 3.99, 0.22, 0.265, 0.565}},
    Row{"W12X19", {12.2, 4.01, 0.235, 0.35, 0.65}}, Row{"W12X22", {12.3, 4.03, 0.26, 0.425, 0.725}},
    Row{"W12X26", {12.2, 6.49, 0.23, 0.38, 0.68}}, Row{"W12X30", {12.3, 6.52, 0.26, 0.44, 0.74}},
    Row{"W12X35", {12.5, 6.56, 0.3, 0.52, 0.82}}, Row{"W12X40", {11.9, 8.01, 0.295, 0.515, 1.02}},
    Row{"W12X45", {12.1, 8.05, 0.335, 0.575, 1.08}}, Row{"W12X50", {12.2, 8.08, 0.37, 0.64, 1.14}},
    Row{"W12X53", {12.1, 10, 0.345, 0.575, 1.18}}, Row{"W12X58", {12.2, 10, 0.36, 0.64, 1.24}},
    Row{"W12X65", {12.1, 12, 0.39, 0.605, 1.2}}, Row{"W12X72", {12.3, 12, 0.43, 0.67, 1.27}},
    Row{"W12X79", {12.4, 12.1, 0.47, 0.735, 1.33}}, Row{"W12X87", {12.5, 12.1, 0.515, 0.81, 1.41}},
    Row{"W12X96", {12.7, 12.2, 0.55, 0.9, 1.5}}, Row{"W12X106", {12.9, 12.2, 0.61, 0.99, 1.59}},
    Row{"W12X120", {13.1, 12.3, 0.71, 1.11, 1.7}}, Row{"W12X136", {13.4, 12.4, 0.79, 1.25, 1.85}},
    Row{"W12X152", {13.7, 12.5, 0.87, 1.4, 2}}, Row{"W12X170", {14, 12.6, 0.96, 1.56, 2.16}},
    Row{"W12X190", {14.4, 12.7, 1.06, 1.74, 2.33}},
    Row{"W14X22", {13.7, 5, 0.23, 0.335, 0.735}}, Row{"W14X26", {13.9, 5.03, 0.255, 0.42, 0.82}},
    Row{"W14X30", {13.8, 6.73, 0.27, 0.385, 0.785}}, Row{"W14X34", {14, 6.75, 0.285, 0.455, 0.855}},
    Row{"W14X38", {14.1, 6.77, 0.31, 0.515, 0.915}}, Row{"W14X43", {13.7, 8, 0.305, 0.53, 1.12}},
    Row{"W14X48", {13.8, 8.03, 0.34, 0.595, 1.19}}, Row{"W14X53", {13.9, 8.06, 0.37, 0.66, 1.25}},
    Row{"W14X61", {13.9, 10, 0.375, 0.645, 1.24}}, Row{"W14X68", {14, 10, 0.415, 0.72, 1.31}},
    Row{"W14X74", {14.2, 10.1, 0.45, 0.785, 1.38}}, Row{"W14X82", {14.3, 10.1, 0.51, 0.855, 1.45}},
    Row{"W14X90", {14, 14.5, 0.44, 0.71, 1.31}}, Row{"W14X99", {14.2, 14.6, 0.485, 0.78, 1.38}},
    Row{"W14X109", {14.3, 14.6, 0.525, 0.86, 1.46}}, Row{"W14X120", {14.5, 14.7, 0.59, 0.94, 1.54}},
    Row{"W14X132", {14.7, 14.7, 0.645, 1.03, 1.63}}, Row{"W14X145", {14.8, 15.5, 0.68, 1.09, 1.69}},
    Row{"W14X159", {15, 15.6, 0.745, 1.19, 1.79}}, Row{"W14X176", {15.2, 15.7, 0.83, 1.31, 1.91}},
    Row{"W14X193", {15.5, 15.7, 0.89, 1.44, 2.04}}, Row{"W14X211", {15.7, 15.8, 0.98, 1.56, 2.16}},
    Row{"W14X233", {16, 15.9, 1.07, 1.72, 2.32}}, Row{"W14X257", {16.4, 16, 1.18, 1.89, 2.49}},
    Row{"W14X283", {16.7, 16.1, 1.29, 2.07, 2.67}}, Row{"W14X311", {17.1, 16.2, 1.41, 2.26, 2.86}},
    Row{"W16X26", {15.7, 5.5, 0.25, 0.345, 0.747}}, Row{"W16X31", {15.9, 5.53, 0.275, 0.44, 0.842}},
    Row{"W16X36", {15.9, 6.99, 0.295, 0.43, 0.832}}, Row{"W16X40", {16, 7, 0.305, 0.505, 0.907}},
    Row{"W16X45", {16.1, 7.04, 0.345, 0.565, 0.967}}, Row{"W16X50", {16.3, 7.07, 0.38, 0.63, 1.03}},
    Row{"W16X57", {16.4, 7.12, 0.43, 0.715, 1.12}}, Row{"W16X67", {16.3, 10.2, 0.395, 0.665, 1.07}},
    Row{"W16X77", {16.5, 10.3, 0.455, 0.76, 1.16}}, Row{"W16X89", {16.8, 10.4, 0.525, 0.875, 1.28}},
    Row{"W16X100", {17, 10.4, 0.585, 0.985, 1.39}},
    Row{"W18X35", {17.7, 6, 0.3, 0.425, 0.827}}, Row{"W18X40", {17.9, 6.02, 0.315, 0.525, 0.927}},
    Row{"W18X46", {18.1, 6.06, 0.36, 0.605, 1.01}}, Row{"W18X50", {18, 7.5, 0.355, 0.57, 0.972}},
    Row{"W18X55", {18.1, 7.53, 0.39, 0.63, 1.03}}, Row{"W18X60", {18.2, 7.56, 0.415, 0.695, 1.1}},
    Row{"W18X65", {18.4, 7.59, 0.45, 0.75, 1.15}}, Row{"W18X71", {18.5, 7.64, 0.495, 0.81, 1.21}},
    Row{"W18X76", {18.2, 11, 0.425, 0.68, 1.08}}, Row{"W18X86", {18.4, 11.1, 0.48, 0.77, 1.17}},
    Row{"W18X97", {18.6, 11.1, 0.535, 0.87, 1.27}}, Row{"W18X106", {18.7, 11.2, 0.59, 0.94, 1.34}},
    Row{"W21X44", {20.7, 6.5, 0.35, 0.45, 0.95}}, Row{"W21X50", {20.8, 6.53, 0.38, 0.535, 1.04}},
    Row{"W21X57", {21.1, 6.56, 0.405, 0.65, 1.15}}, Row{"W21X62", {21, 8.24, 0.4, 0.615, 1.12}},
    Row{"W21X68", {21.1, 8.27, 0.43, 0.685, 1.19}}, Row{"W21X73", {21.2, 8.3, 0.455, 0.74, 1.24}},
    Row{"W21X83", {21.4, 8.36, 0.515, 0.835, 1.34}}, Row{"W21X93", {21.6, 8.42, 0.58, 0.93, 1.43}},
    Row{"W21X101", {21.4, 12.3, 0.5, 0.8, 1.3}}, Row{"W21X111", {21.5, 12.3, 0.55, 0.875, 1.38}},
    Row{"W21X122", {21.7, 12.4, 0.6, 0.96, 1.46}},
    Row{"W24X55", {23.6, 7.01, 0.395, 0.505, 1.01}}, Row{"W24X62", {23.7, 7.04, 0.43, 0.59, 1.09}},
    Row{"W24X68", {23.7, 8.97, 0.415, 0.585, 1.09}}, Row{"W24X76", {23.9, 8.99, 0.44, 0.68, 1.18}},
    Row{"W24X84", {24.1, 9.02, 0.47, 0.77, 1.27}}, Row{"W24X94", {24.3, 9.07, 0.515, 0.875, 1.38}},
    Row{"W24X104", {24.1, 12.8, 0.5, 0.75, 1.25}}, Row{"W24X117", {24.3, 12.8, 0.55, 0.85, 1.35}},
    Row{"W24X131", {24.5, 12.9, 0.605, 0.96, 1.46}},
};
// clang-format on

enum class Family { parallel, channel, inches };

struct SectionTable {
  Family family;
  std::span<const Row> rows;
};

std::array<SectionTable, 6> tables() {
  return {SectionTable{Family::parallel, ipe}, SectionTable{Family::parallel, hea},
          SectionTable{Family::parallel, heb}, SectionTable{Family::parallel, hem},
          SectionTable{Family::channel, upn},  SectionTable{Family::inches, w}};
}

constexpr double millimetre = 1e-3;
constexpr double inch = 0.0254;

SectionNumbers numbers_of(Family family, const Row& row) {
  const auto& size = row.size;
  if (family == Family::inches) {
    return i_section({size[0] * inch, size[1] * inch, size[2] * inch, size[3] * inch,
                      (size[4] - size[3]) * inch, 0});
  }
  const RolledShape shape{size[0] * millimetre, size[1] * millimetre, size[2] * millimetre,
                          size[3] * millimetre, size[4] * millimetre, size[5] * millimetre};
  return family == Family::channel ? channel_section(shape) : i_section(shape);
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
  for (const SectionTable& table : tables()) {
    for (const Row& row : table.rows) {
      if (row.name == wanted) return numbers_of(table.family, row);
    }
  }
  const auto numbers = tube(wanted);
  return numbers ? numbers : solid(wanted);
}

std::vector<std::string> standard_section_names() {
  std::vector<std::string> names;
  for (const SectionTable& table : tables()) {
    for (const Row& row : table.rows) names.emplace_back(row.name);
  }
  return names;
}

}  // namespace pounding
