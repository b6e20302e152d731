#include "scene/standard_sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
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

using std::numbers::pi;

double square(double x) {
  return x * x;
}

double cube(double x) {
  return x * x * x;
}

double fourth(double x) {
  return square(x) * square(x);
}

/// Area between a quarter circle of radius 1 and its two tangents, and how far its centroid is
/// from either of them.
constexpr double spandrel = 1 - pi / 4;
constexpr double spandrel_centroid = (10 - 3 * pi) / (12 - 3 * pi);

/// Second moment of a spandrel of radius 1 about an axis along a tangent through its centroid.
constexpr double spandrel_inertia = 1.0 / 3 - pi / 16 - 1 / (3 * (12 - 3 * pi));

/// Integral over [from, to] of a cubic: Simpson's rule, which is exact for it.
template <typename Cubic>
double integral(double from, double to, Cubic value) {
  return (to - from) / 6 * (value(from) + 4 * value((from + to) / 2) + value(to));
}

/// Walls of a section that bear shear along its height, by their middle lines: webs between two
/// flanges, and arms of these, two for each flange of an I, one for that of a channel.
struct ShearWalls {
  double height, web, flange, arm;
  int webs, arms;
};

double shear_area(const ShearWalls& s) {
  const double half = s.height / 2;
  const double inertia =
      s.arms * s.arm * s.flange * square(half) + s.webs * s.web * 2 / 3 * cube(half);
  const double flanges = s.arms * s.flange * square(half) * cube(s.arm) / 3;
  // S / t of a web: (c - z^2 / 2), with what the flanges bring
  const double c = s.arms / 2.0 * s.arm * s.flange * half / (s.webs * s.web) + square(half) / 2;
  const double webs =
      2 * s.webs * s.web * (square(c) * half - c * cube(half) / 3 + half * fourth(half) / 20);
  return square(inertia) / (flanges + webs);
}

/// Shear area across a channel, whose flanges bear the force.
double shear_area_across(double height, double web, double flange, double arm) {
  const double back = square(arm) * flange / (2 * arm * flange + height * web);  // to the centroid
  const double tip = arm - back;
  const double inertia = 2 * flange / 3 * (cube(tip) + cube(back)) + height * web * square(back);
  const double at_web = flange * (square(tip) - square(back)) / 2;
  // 2 flanges, integral of ((tip^2 - x^2) / 2)^2 from -back to tip
  const auto upto = [tip](double x) {
    return fourth(tip) * x - 2 * square(tip) * cube(x) / 3 + fourth(x) * x / 5;
  };
  const double flanges = flange / 2 * (upto(tip) + upto(back));
  return square(inertia) / (flanges + square(at_web) * height / (3 * web));
}

/// Place and weight of a corner's spandrel in the upper half of a channel.
struct Corner {
  double area, across, along;
};

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
  return names_of(rows());
}

SectionNumbers i_section(const RolledShape& s) {
  const double r = s.root_radius;
  const double clear = s.height - 2 * s.flange;
  const double fillet = spandrel * square(r);
  const double own = spandrel_inertia * fourth(r);
  SectionNumbers n;
  n.area = 2 * s.width * s.flange + clear * s.web + 4 * fillet;
  n.inertia_y = (s.width * cube(s.height) - (s.width - s.web) * cube(clear)) / 12 +
                4 * (own + fillet * square(clear / 2 - spandrel_centroid * r));
  n.inertia_z = (2 * s.flange * cube(s.width) + clear * cube(s.web)) / 12 +
                4 * (own + fillet * square(s.web / 2 + spandrel_centroid * r));
  const double circle =
      (square(r + s.web / 2) + square(r + s.flange) - square(r)) / (2 * r + s.flange);
  n.torsion = 2.0 / 3 * (s.width - 0.63 * s.flange) * cube(s.flange) + clear * cube(s.web) / 3 +
              2 * s.web / s.flange * (0.145 + 0.1 * r / s.flange) * fourth(circle);
  n.shear_area_y = 5.0 / 6 * 2 * s.width * s.flange;
  n.shear_area_z = shear_area({s.height - s.flange, s.web, s.flange, s.width / 2, 1, 4});
  return n;
}

SectionNumbers channel_section(const RolledShape& s) {
  const bool tall = s.height > 0.3;
  const double slope = tall ? 0.05 : 0.08;
  const double middle = s.width - (tall ? (s.width - s.web) / 2 : s.width / 2);
  const double half = s.height / 2;
  const auto thickness = [&](double x) { return s.flange + slope * (middle - x); };
  const auto over_flange = [&](auto value) { return integral(s.web, s.width, value); };

  double area = s.height * s.web + 2 * over_flange(thickness);
  double moment =
      s.height * square(s.web) / 2 + 2 * over_flange([&](double x) { return x * thickness(x); });
  double about_back = s.height * cube(s.web) / 3 +
                      2 * over_flange([&](double x) { return square(x) * thickness(x); });
  double inertia_y =
      s.web * cube(s.height) / 12 +
      2 * over_flange([&](double x) { return (cube(half) - cube(half - thickness(x))) / 3; });
  const double root = spandrel_centroid * s.root_radius;
  const double toe = spandrel_centroid * s.toe_radius;
  const std::array<Corner, 2> corners{
      Corner{spandrel * square(s.root_radius), s.web + root, half - thickness(s.web) - root},
      Corner{-spandrel * square(s.toe_radius), s.width - toe, half - thickness(s.width) + toe}};
  for (const Corner& corner : corners) {
    area += 2 * corner.area;
    moment += 2 * corner.area * corner.across;
    about_back += 2 * corner.area * square(corner.across);
    inertia_y += 2 * corner.area * square(corner.along);
  }
  const double t = s.flange;
  const double ratio = s.web / t;
  const double radius = s.root_radius / t;
  const double factor =
      -0.0908 + 0.2621 * ratio + 0.1231 * radius - 0.0752 * ratio * radius - 0.0945 * square(ratio);
  const double circle = 2 * (3 * s.root_radius + s.web + t -
                             std::sqrt(2 * (2 * s.root_radius + s.web) * (2 * s.root_radius + t)));
  const double torsion = 2.0 / 3 * s.width * cube(t) + (s.height - 2 * t) * cube(s.web) / 3 +
                         2 * factor * fourth(circle) - 0.42 * fourth(t);
  const double clear = s.height - t;
  const double arm = s.width - s.web / 2;
  return {area,
          inertia_y,
          about_back - square(moment) / area,
          torsion,
          shear_area_across(clear, s.web, t, arm),
          shear_area({clear, s.web, t, arm, 1, 2})};
}

SectionNumbers hollow_section(double height, double width, double wall, double outer_radius,
                              double inner_radius) {
  const auto inertia = [&](double along, double across) {
    const auto filled = [](double h, double b, double r) {
      return b * cube(h) / 12 - 4 * (spandrel_inertia * fourth(r) +
                                     spandrel * square(r) * square(h / 2 - spandrel_centroid * r));
    };
    return filled(along, across, outer_radius) -
           filled(along - 2 * wall, across - 2 * wall, inner_radius);
  };
  const double corner = (outer_radius + inner_radius) / 2;
  const double middle_area = (width - wall) * (height - wall) - square(corner) * (4 - pi);
  const double middle_line = 2 * (width + height - 2 * wall) - 2 * corner * (4 - pi);
  SectionNumbers n;
  n.area = 2 * wall * (width + height - 2 * wall) -
           (4 - pi) * (square(outer_radius) - square(inner_radius));
  n.inertia_y = inertia(height, width);
  n.inertia_z = inertia(width, height);
  n.torsion = cube(wall) * middle_line / 3 + 4 * square(middle_area) * wall / middle_line;
  n.shear_area_y = shear_area({width - wall, wall, wall, (height - wall) / 2, 2, 4});
  n.shear_area_z = shear_area({height - wall, wall, wall, (width - wall) / 2, 2, 4});
  return n;
}

SectionNumbers round_section(double diameter, double wall) {
  const double inside = diameter - 2 * wall;
  const double inertia = pi / 64 * (fourth(diameter) - fourth(inside));
  const double area = pi / 4 * (square(diameter) - square(inside));
  const double hole = square(inside / diameter);
  const double shear = 6 * square(1 + hole) / (7 * square(1 + hole) + 20 * hole) * area;
  return {area, inertia, inertia, 2 * inertia, shear, shear};
}

SectionNumbers rectangular_section(double height, double width) {
  const double area = height * width;
  const double thin = std::min(height, width);
  const double ratio = std::max(height, width) / thin;
  double series = 0;
  for (int n = 1; n < 20; n += 2) series += std::tanh(n * pi * ratio / 2) / (fourth(n) * n);
  const double torsion =
      area * square(thin) / 3 * (1 - 192 / (square(pi) * cube(pi) * ratio) * series);
  return {
      area,          area * square(height) / 12, area * square(width) / 12, torsion, 5.0 / 6 * area,
      5.0 / 6 * area};
}

SectionNumbers circular_section(double diameter) {
  const double area = pi / 4 * square(diameter);
  const double inertia = area * square(diameter) / 16;
  return {area, inertia, inertia, 2 * inertia, 0.9 * area, 0.9 * area};
}

}  // namespace pounding
