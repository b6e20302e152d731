#include "interactions/pairing/gap_survey.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "common/error.h"
#include "common/facts.h"
#include "common/matrix3.h"
#include "common/series.h"
#include "scene/member_table.h"
#include "scene/option_values.h"

namespace pounding::interactions {
namespace {

using Place = LinearField::Place;
using Triangle = std::array<int, 3>;

constexpr double noise = 1e-12;      ///< of a sum, over its terms
constexpr double least_turn = 1e-9;  ///< of the sides of a triangle, over the size of the survey
constexpr double one_point = 1e-6;   ///< of two points, over the size of the survey
constexpr double off_face = 0.1;     ///< of half of the points, over the size of the face
constexpr double wide_gap = 0.5;     ///< of half of the points [m]
constexpr double far_away = 1e4;     ///< of the corners that are left out again, over the size

Place side(const Place& from, const Place& to) {
  return {to[0] - from[0], to[1] - from[1]};
}
double doubled_area(const Place& a, const Place& b) {
  return a[0] * b[1] - a[1] * b[0];
}
double product(const Place& a, const Place& b) {
  return a[0] * b[0] + a[1] * b[1];
}
double squared(const Place& a) {
  return product(a, a);
}

/// Whether p is inside of the circle through the corners of a triangle, by more than round-off.
bool circle_holds(const std::vector<Place>& x, const Triangle& corners, const Place& p) {
  std::array<Place, 3> from{};
  for (std::size_t k = 0; k < 3; ++k) from[k] = side(p, x[static_cast<std::size_t>(corners[k])]);
  double sum = 0;
  double size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double part = squared(from[k]) * doubled_area(from[(k + 1) % 3], from[(k + 2) % 3]);
    sum += part;
    size += std::abs(part);
  }
  return sum > noise * size;
}

/// Points of a survey with their gaps, and their lines in its file.
struct Survey {
  std::vector<int> lines;
  std::vector<Vector3> points;
  std::vector<double> gaps;
};

/// The survey of a contact, and how to refuse it.
class SurveyFile {
 public:
  explicit SurveyFile(const Contact& contact)
      : contact_(contact.name),
        option_("option -" + contact.name + "_survey"),
        path_(contact.gap.survey) {}

  [[noreturn]] void refuse(const std::string& why, int line = 0) const {
    throw UserError(option_ + " " + path_ + (line > 0 ? ", line " + std::to_string(line) : "") +
                    ": " + why);
  }

  /// All points or, with a column `contact`, those of this one.
  Survey read(std::span<const Contact> contacts) const {
    const MemberTable table = read_table(option_, path_);
    const auto column = [&](const char* name) {
      return static_cast<std::size_t>(std::ranges::find(table.columns, name) -
                                      table.columns.begin());
    };
    std::array<std::size_t, 4> columns{};
    constexpr std::array<const char*, 4> names{"x", "y", "z", "gap"};
    for (std::size_t k = 0; k < names.size(); ++k) {
      columns[k] = column(names[k]);
      if (columns[k] == table.columns.size()) {
        refuse(std::string("no column '") + names[k] +
               "'; the first line names x, y, z and gap, in metres");
      }
    }
    const std::size_t owner = column("contact");
    Survey survey;
    for (std::size_t point = 0; point < table.members(); ++point) {
      if (owner < table.columns.size() && table.value(point, owner) != contact_) {
        const std::string& name = table.value(point, owner);
        if (std::ranges::find(contacts, name, &Contact::name) != contacts.end()) continue;
        refuse("'" + shown_value(name) + "' is no contact of the scene", table.lines[point]);
      }
      std::array<double, 4> values{};
      for (std::size_t k = 0; k < values.size(); ++k) {
        const std::string& word = table.value(point, columns[k]);
        const auto value = parse_real(word);
        if (!value) refuse("'" + shown_value(word) + "' is no number", table.lines[point]);
        values[k] = *value;
      }
      if (values[3] < 0) {
        refuse("a gap below 0; faces that touch have one of 0", table.lines[point]);
      }
      survey.lines.push_back(table.lines[point]);
      survey.points.push_back({values[0], values[1], values[2]});
      survey.gaps.push_back(values[3]);
    }
    if (survey.points.size() < 3) {
      refuse("fewer than three points of contact " + contact_ +
             ", between which nothing is linear; give more, or -..._gap");
    }
    return survey;
  }

 private:
  std::string contact_;
  std::string option_;
  std::string path_;
};

/// Refuses a survey most of which is not on the faces of a joint, or of gaps in another unit.
void require_on_face(const SurveyFile& file, const Survey& survey, std::span<const Constraint> rows,
                     const InterfaceReport& report) {
  BoundingBox box;
  double facet = 0;
  double widest = 0;
  for (const Constraint& row : rows) {
    box.include({row.level[0], row.level[1], dot(report.normal, row.at)});
    if (row.geometric_gap == open_gap) continue;
    box.include({row.level[0], row.level[1], dot(report.normal, row.at) + row.geometric_gap});
    facet = std::max(facet, row.facet_size);
    widest = std::max(widest, row.geometric_gap);
  }
  std::vector<double> away;
  for (const Vector3& point : survey.points) {
    const auto [s, t] = in_plane(point, report.normal, report.tangent_axes);
    const Vector3 at{s, t, dot(report.normal, point)};
    Vector3 beyond{};
    for (std::size_t d = 0; d < 3; ++d) {
      beyond[d] = std::max({0.0, box.low[d] - at[d], at[d] - box.high[d]});
    }
    away.push_back(norm(beyond));
  }
  if (const double off = median(away); off > off_face * std::max(box.longest_side(), facet)) {
    file.refuse(
        sentence("half of its points lie {:.4g} m or more off the faces, which are {:.4g} m "
                 "long; give them in the coordinates of the meshes, in metres",
                 {off, box.longest_side()}));
  }
  if (const double gap = median(survey.gaps); gap > wide_gap && gap > 2 * widest) {
    file.refuse(sentence("half of its gaps are {:.4g} m or more; gaps are in metres", {gap}));
  }
}

}  // namespace

LinearField::LinearField(std::span<const Place> places, std::span<const double> values)
    : places_(places.begin(), places.end()), values_(values.begin(), values.end()) {
  const auto count = static_cast<int>(places_.size());
  std::vector<Place> x = places_;
  x.insert(x.end(), {{-far_away, -far_away}, {far_away, -far_away}, {0, far_away}});
  triangles_ = {{count, count + 1, count + 2}};
  for (int i = 0; i < count; ++i) {  // Bowyer and Watson: triangles that hold it are cut out
    std::set<std::pair<int, int>> border;
    std::vector<Triangle> kept;
    for (const Triangle& triangle : triangles_) {
      if (!circle_holds(x, triangle, x[static_cast<std::size_t>(i)])) {
        kept.push_back(triangle);
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const std::pair edge(triangle[k], triangle[(k + 1) % 3]);
        if (border.erase({edge.second, edge.first}) == 0) border.insert(edge);
      }
    }
    triangles_ = std::move(kept);
    for (const auto& [from, to] : border) triangles_.push_back({from, to, i});
  }
  std::erase_if(triangles_, [&](const Triangle& triangle) {
    if (std::ranges::any_of(triangle, [count](int corner) { return corner >= count; })) return true;
    const auto corner = [&](std::size_t k) { return x[static_cast<std::size_t>(triangle[k])]; };
    return doubled_area(side(corner(0), corner(1)), side(corner(0), corner(2))) < least_turn;
  });
  for (const auto& [i, j, k] : triangles_) edges_.insert(edges_.end(), {{i, j}, {j, k}, {k, i}});
  if (triangles_.empty()) join_line();
}

void LinearField::join_line() {
  std::vector<int> order(places_.size());
  std::iota(order.begin(), order.end(), 0);
  const auto from_first = [this](int i) {
    return side(places_.front(), places_[static_cast<std::size_t>(i)]);
  };
  const Place along =
      from_first(std::ranges::max(order, {}, [&](int i) { return squared(from_first(i)); }));
  std::ranges::sort(order, {}, [&](int i) { return product(from_first(i), along); });
  for (std::size_t i = 1; i < order.size(); ++i) edges_.push_back({order[i - 1], order[i]});
}

LinearField::Value LinearField::at(const Place& place) const {
  Value nearest{0, std::numeric_limits<double>::infinity()};
  for (const Triangle& triangle : triangles_) {
    std::array<Place, 3> from{};
    std::array<double, 3> value{};
    for (std::size_t k = 0; k < 3; ++k) {
      from[k] = side(place, places_[static_cast<std::size_t>(triangle[k])]);
      value[k] = values_[static_cast<std::size_t>(triangle[k])];
    }
    std::array<double, 3> share{};
    for (std::size_t k = 0; k < 3; ++k) {
      share[k] = doubled_area(from[(k + 1) % 3], from[(k + 2) % 3]);
    }
    if (std::ranges::min(share) < 0) continue;
    const double all = share[0] + share[1] + share[2];
    return {(share[0] * value[0] + share[1] * value[1] + share[2] * value[2]) / all, 0};
  }
  for (const auto& [i, j] : edges_) {
    const auto begin = static_cast<std::size_t>(i);
    const auto end = static_cast<std::size_t>(j);
    const Place from = side(place, places_[begin]);
    const Place along = side(places_[begin], places_[end]);
    const double part = std::clamp(-product(from, along) / squared(along), 0.0, 1.0);
    const double away = std::hypot(from[0] + part * along[0], from[1] + part * along[1]);
    if (away >= nearest.beyond) continue;
    nearest = {values_[begin] + part * (values_[end] - values_[begin]), away};
  }
  return nearest;
}

double LinearField::off_line(const Place& place) const {
  if (!triangles_.empty()) return 0;
  const Place& first = places_[static_cast<std::size_t>(edges_.front()[0])];
  const Place along = side(first, places_[static_cast<std::size_t>(edges_.back()[1])]);
  return std::abs(doubled_area(side(first, place), along)) / std::sqrt(squared(along));
}

std::array<double, 2> in_plane(const Vector3& x, const Vector3& normal,
                               const std::array<int, 2>& axes) {
  const auto [a, b] = axes;
  // A plane seen along the third axis is shorter by |n| of it along (n_a, n_b).
  const double third = std::abs(normal[3 - a - b]);
  const double longer = (normal[a] * x[a] + normal[b] * x[b]) / (third * (1 + third));
  return {x[a] + longer * normal[a], x[b] + longer * normal[b]};
}

void lay_survey(std::span<const Contact> contacts, const Contact& contact,
                std::span<Constraint> rows, std::span<Constraint> watched,
                InterfaceReport& report) {
  const SurveyFile file(contact);
  const Survey survey = file.read(contacts);
  require_on_face(file, survey, rows, report);
  std::vector<Place> places;
  for (const Vector3& point : survey.points) {
    places.push_back(in_plane(point, report.normal, report.tangent_axes));
  }
  Place low = places.front();
  Place high = low;
  for (const Place& place : places) {
    for (std::size_t t = 0; t < 2; ++t) {
      low[t] = std::min(low[t], place[t]);
      high[t] = std::max(high[t], place[t]);
    }
  }
  const double size = std::max({high[0] - low[0], high[1] - low[1], one_point});
  const auto scaled = [&](const Place& place) {
    return Place{(place[0] - low[0]) / size, (place[1] - low[1]) / size};
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[i] = scaled(places[i]);
    for (std::size_t j = 0; j < i; ++j) {
      if (squared(side(places[i], places[j])) > one_point * one_point) continue;
      file.refuse(sentence("lines {} and {} are the same place of the face",
                           {survey.lines[j], survey.lines[i]}));
    }
  }
  const LinearField field(places, survey.gaps);
  if (std::ranges::any_of(
          rows, [&](const auto& row) { return field.off_line(scaled(row.level)) > off_face; })) {
    file.refuse("its points lie on one line of the face; give some beside it");
  }
  report.survey.points = static_cast<int>(places.size());
  for (Constraint& row : watched) row.surveyed = field.at(scaled(row.level)).value;
  for (Constraint& row : rows) {
    const auto [value, beyond] = field.at(scaled(row.level));
    row.surveyed = value;
    if (row.geometric_gap == open_gap || beyond <= one_point) continue;
    ++report.survey.beyond;
    report.survey.farthest = std::max(report.survey.farthest, size * beyond);
  }
}

}  // namespace pounding::interactions
