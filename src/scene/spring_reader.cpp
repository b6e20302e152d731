#include "scene/spring_reader.h"

#include <algorithm>
#include <cmath>

#include "scene/hysteresis_reader.h"

namespace pounding {
namespace {

using Names = OptionReader::Names;

constexpr std::string_view yield_force = "<structure>_<group>_yield_force";
constexpr std::string_view hardening = "<structure>_<group>_hardening";
constexpr std::string_view yield_circle = "<structure>_<group>_yield_circle";
constexpr std::string_view sliding_friction = "<structure>_<group>_sliding_friction";
constexpr std::string_view radius = "<structure>_<group>_pendulum_radius";
constexpr std::string_view dashpot = "<structure>_<group>_dashpot";
constexpr std::string_view exponent = "<structure>_<group>_dashpot_exponent";
constexpr std::string_view dashpot_stiffness = "<structure>_<group>_dashpot_stiffness";
constexpr std::string_view series_stiffness = "<structure>_<group>_series_stiffness";
constexpr std::string_view law_rule = "<structure>_<group>_rule";
constexpr std::string_view law_skeleton = "<structure>_<group>_skeleton";
constexpr std::string_view slack = "<structure>_<group>_slack";

std::array<int, 3> circle_of(const std::string& word) {
  if (word == "x+y") return {0, 1, 2};
  if (word == "y+z") return {1, 2, 0};
  if (word == "x+z") return {0, 2, 1};
  return {0, 0, 0};
}

void check_sliding(const OptionReader& options, const Names& names, const Region& region) {
  const NonlinearSpring& spring = region.nonlinear;
  options.refuse_if(!spring.has_circle(), sliding_friction, names,
                    "give -<structure>_<group>_yield_circle, the plane in which it slides");
  const auto [a, b, across] = spring.circle;
  options.refuse_if(spring.yield_force[a] > 0 || spring.yield_force[b] > 0, sliding_friction, names,
                    "not beside -<structure>_<group>_yield_force in the same plane: the "
                    "compression across it decides");
  options.refuse_if(!(region.stiffness[across] > 0), sliding_friction, names,
                    "its stiffness across the plane is 0, so nothing presses on it");
}

void check_pendulum(const OptionReader& options, const Names& names,
                    const NonlinearSpring& spring) {
  options.refuse_if(!(spring.friction > 0), radius, names,
                    "give -<structure>_<group>_sliding_friction, and the plane of its dish");
  options.refuse_if(!(spring.hardening > 0), radius, names,
                    "give -<structure>_<group>_hardening, the largest pressure on it over radius, "
                    "as a part of stiffness");
}

void check_circle(const OptionReader& options, const Names& names, const Region& region) {
  const NonlinearSpring& spring = region.nonlinear;
  const auto [a, b, across] = spring.circle;
  options.refuse_if(
      spring.friction == 0 && !(spring.yield_force[a] > 0), yield_circle, names,
      "give -<structure>_<group>_yield_force or -<structure>_<group>_sliding_friction");
  options.refuse_if(
      spring.yield_force[a] != spring.yield_force[b] || region.stiffness[a] != region.stiffness[b],
      yield_circle, names, "stiffness and yield force must be the same in both directions");
}

/// Three numbers along x, y, z, or six, also about them.
std::array<double, 6> read_six(OptionReader& options, std::string_view pattern,
                               const Names& names) {
  const std::vector<double> values = options.reals(pattern, names);
  options.refuse_if(values.size() != 3 && values.size() != 6, pattern, names,
                    "wrong count of numbers");
  std::array<double, 6> result{};
  std::ranges::copy(values, result.begin());
  return result;
}

/// The one number of a bar, of an option that has six of a spring.
double read_one(OptionReader& options, std::string_view pattern, const Names& names) {
  const std::vector<double> values = options.reals(pattern, names);
  options.refuse_if(std::count(values.begin() + 1, values.end(), 0) + 1 != std::ssize(values),
                    pattern, names, "a bar takes one number");
  return values.front();
}

/// How springs are spread, by the options given.
Spread spread_of(const OptionReader& options, const Names& names) {
  const auto has = [&](Spread spread) {
    return options.given("<structure>_<group>_stiffness" + per_extent(spread), names) ||
           options.given(std::string(dashpot) + per_extent(spread), names);
  };
  options.refuse_if(has(Spread::area) && has(Spread::length),
                    "<structure>_<group>_stiffness_per_length", names,
                    "not beside those per area; a group is of lines or of surfaces");
  if (has(Spread::area)) return Spread::area;
  return has(Spread::length) ? Spread::length : Spread::none;
}

/// Stiffness and dashpots per length or area: of linear springs along x, y, z.
void read_spread(OptionReader& options, const Names& names, Region& region) {
  const std::string per = per_extent(region.spread);
  const std::string stiffness = "<structure>_<group>_stiffness" + per;
  options.forbid_each("",
                      {"<structure>_<group>_stiffness", dashpot, yield_force, hardening,
                       yield_circle, sliding_friction, radius, exponent, dashpot_stiffness,
                       series_stiffness, law_rule, law_skeleton},
                      names, "not beside -" + stiffness);
  std::ranges::copy(options.reals(stiffness, names, 3), region.stiffness.begin());
  std::ranges::copy(options.reals(std::string(dashpot) + per, names, 3), region.dashpot.begin());
  const auto is_zero = [](double value) { return value == 0; };
  options.refuse_if(std::ranges::all_of(region.stiffness, is_zero) &&
                        std::ranges::all_of(region.dashpot, is_zero),
                    stiffness, names, "all zero, and no dashpots; leave the group out");
}

std::string axis_of(std::size_t component) {
  return std::string(component < 3 ? "along " : "about ") + "xyz"[component % 3];
}

/// K1 in series with a spring K2 beside a dashpot c that is itself in series with K3, as the spring
/// and the one dashpot in series with a spring A that pull alike: they are at rest with K1 K2 / (K1
/// + K2), and moved at once with the series of K1 and K2 + K3. The dashpot's rate is K1 / (K1 + K2)
/// of the one of the whole, its force (K1 + K2) / K1 times that.
void put_in_series(double outer, double inner, double power, double& stiffness, double& rate,
                   double& branch) {
  branch = inner;
  if (!(outer > 0)) return;
  const double part = outer / (outer + stiffness);
  branch = inner > 0 ? part * outer * inner / (outer + stiffness + inner) : part * outer;
  rate *= std::pow(part, 1 + power);
  stiffness *= part;
}

/// Springs in series with dashpots, and with springs beside them.
void read_series(OptionReader& options, const Names& names, Region& region) {
  const std::array<double, 6> inner = read_six(options, dashpot_stiffness, names);
  const std::array<double, 6> outer = read_six(options, series_stiffness, names);
  NonlinearSpring& spring = region.nonlinear;
  for (std::size_t c = 0; c < inner.size(); ++c) {
    if (inner[c] == 0 && outer[c] == 0) continue;
    const std::string_view option = inner[c] > 0 ? dashpot_stiffness : series_stiffness;
    options.refuse_if(!(region.dashpot[c] > 0), option, names,
                      "there is no dashpot " + axis_of(c) + " for it to be in series with");
    options.refuse_if(outer[c] > 0 && spring.yields(c), series_stiffness, names,
                      "not in series with a spring that yields " + axis_of(c) +
                          "; give that one a group of its own");
    put_in_series(outer[c], inner[c], spring.dashpot_exponent, region.stiffness[c],
                  region.dashpot[c], spring.dashpot_stiffness[c]);
  }
}

/// Where a spring yields and how its dashpots go, beside stiffness and dashpots read already.
void read_nonlinear_spring(OptionReader& options, const Names& names, Region& region) {
  NonlinearSpring& spring = region.nonlinear;
  if (options.given(yield_force, names)) {
    spring.yield_force = read_six(options, yield_force, names);
  }
  spring.hardening = options.real(hardening, names);
  spring.circle = circle_of(options.choice(yield_circle, names));
  spring.friction = options.real(sliding_friction, names);
  spring.radius = options.real(radius, names);
  spring.dashpot_exponent = options.real(exponent, names);
  read_hysteresis(options, names, region.stiffness, spring);
  if (spring.radius > 0) check_pendulum(options, names, spring);
  if (spring.friction > 0) check_sliding(options, names, region);
  if (spring.has_circle()) check_circle(options, names, region);
  for (std::size_t c = 0; c < region.stiffness.size(); ++c) {
    options.refuse_if(spring.yields(c) && !(region.stiffness[c] > 0),
                      spring.friction > 0 ? sliding_friction : yield_force, names,
                      "its stiffness " + axis_of(c) + " is 0; give the one before it yields");
  }
  read_series(options, names, region);
}

}  // namespace

void read_spring(OptionReader& options, const Names& names, Region& region) {
  region.spread = spread_of(options, names);
  if (region.spread != Spread::none) {
    read_spread(options, names, region);
  } else {
    region.stiffness = read_six(options, "<structure>_<group>_stiffness", names);
    region.dashpot = read_six(options, dashpot, names);
    read_nonlinear_spring(options, names, region);
  }
  if (is_grounded(region.element)) {
    region.compression_only = options.boolean("<structure>_<group>_compression_only", names);
  }
  options.refuse_if(region.compression_only && !(region.stiffness[2] > 0),
                    "<structure>_<group>_compression_only", names,
                    "its stiffness along z is 0; give one, or leave this out");
  options.refuse_if(region.compression_only && region.nonlinear.yields(2),
                    "<structure>_<group>_compression_only", names,
                    "a spring that yields along z cannot press only; leave one of the two out");
  options.refuse_if(
      region.compression_only && region.dashpot[2] > 0 && region.nonlinear.dashpot_exponent != 1,
      exponent, names,
      "beside -<structure>_<group>_compression_only the dashpot along z goes by the rate itself; "
      "leave one of the two out, or give the dashpot to a group of its own");
  options.refuse_if(region.compression_only && region.nonlinear.dashpot_stiffness[2] > 0,
                    dashpot_stiffness, names,
                    "not along z beside -<structure>_<group>_compression_only; give the dashpot to "
                    "a group of its own");
  const auto turns = [](const std::array<double, 6>& values) {
    return std::any_of(values.begin() + 3, values.end(), [](double value) { return value > 0; });
  };
  if (turns(region.stiffness) || turns(region.dashpot)) {
    region.element = region.element == ElementType::spring ? ElementType::spring6
                                                           : ElementType::grounded_spring6;
  }
}

void read_nonlinear_bar(OptionReader& options, const Names& names, Region& region) {
  NonlinearSpring& bar = region.nonlinear;
  region.dashpot[0] = read_one(options, dashpot, names);
  bar.dashpot_exponent = options.real(exponent, names);
  if (region.dashpot[0] > 0) {
    bar.dashpot_stiffness[0] = read_one(options, dashpot_stiffness, names);
  }
  if (!(region.area > 0)) {
    if (!(region.dashpot[0] > 0)) options.refuse(dashpot, names, "0, and the bar has no area");
    options.forbid_each("", {yield_force, hardening, law_rule, law_skeleton, slack}, names,
                        "a bar of its dashpot alone has none; give it an area");
  }
  bar.yield_force[0] = read_one(options, yield_force, names);
  bar.hardening = options.real(hardening, names);
  bar.slack = options.real(slack, names);
  read_hysteresis(options, names, {region.material.young * region.area}, bar);
  options.refuse_if(bar.slack > 0 && region.element != ElementType::tension_bar, slack, names,
                    "for a bar that is tension_only or compression_only");
  options.refuse_if(bar.yields() && region.element == ElementType::tension_bar,
                    bar.has_skeleton() ? law_skeleton : yield_force, names,
                    "not for a bar that is tension_only or compression_only");
  if (bar.yields()) region.element = ElementType::yielding_bar;
}

}  // namespace pounding
