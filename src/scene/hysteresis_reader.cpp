#include "scene/hysteresis_reader.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <span>
#include <string>

#include "common/facts.h"
#include "scene/option_table.h"

namespace pounding {
namespace {

using Names = OptionReader::Names;

constexpr std::string_view rule_option = "<structure>_<group>_rule";
constexpr std::string_view skeleton_option = "<structure>_<group>_skeleton";
constexpr std::string_view back_option = "<structure>_<group>_skeleton_back";
constexpr std::string_view exponent_option = "<structure>_<group>_unloading_exponent";
constexpr std::string_view least_option = "<structure>_<group>_unloading_least";
constexpr std::string_view pinch_option = "<structure>_<group>_pinch";
constexpr std::string_view deterioration_option = "<structure>_<group>_deterioration";

constexpr double rounded = 1e-3;  ///< of the first corner off its line, as tables have it
constexpr double even = 1e-9;     ///< of slopes that are meant to be equal

double shear_modulus(const Material& material) {
  return material.young / (2 * (1 + material.poisson));
}

double slope_between(const SkeletonBreak& a, const SkeletonBreak& b) {
  return (b.force - a.force) / (b.elongation - a.elongation);
}

/// Corners of an option, the first one put on the line of the first slope.
std::vector<SkeletonBreak> read_corners(OptionReader& options, std::string_view pattern,
                                        const Names& names, double first_slope) {
  const std::vector<double> values = options.reals(pattern, names);
  if (pattern == back_option && values == std::vector<double>{0}) return {};
  if (values.size() % 2 != 0) options.refuse(pattern, names, "an elongation without its force");
  std::vector<SkeletonBreak> corners;
  for (std::size_t i = 0; i < values.size(); i += 2) corners.push_back({values[i], values[i + 1]});
  SkeletonBreak& first = corners.front();
  if (!(first.force > 0)) options.refuse(pattern, names, "the force of its first corner is 0");
  options.refuse_if(
      !(std::abs(first.elongation * first_slope / first.force - 1) <= rounded), pattern, names,
      sentence("its first corner is not on the line of the stiffness, which has {} at {}",
               {first.force, first.force / first_slope}));
  first.elongation = first.force / first_slope;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    options.refuse_if(!(corners[i].elongation > corners[i - 1].elongation), pattern, names,
                      "elongations must increase from corner to corner");
    options.refuse_if(corners[i].force / corners[i].elongation >
                          (1 + even) * corners[i - 1].force / corners[i - 1].elongation,
                      pattern, names,
                      "corner " + std::to_string(i + 1) +
                          " lies above the line from the origin through the one before it");
  }
  return corners;
}

void read_skeleton(OptionReader& options, const Names& names,
                   const std::array<double, 6>& first_slopes, NonlinearSpring& spring) {
  options.forbid(
      "<structure>_<group>_yield_force", names,
      "not beside -<structure>_<group>_skeleton, whose first corner says where it yields");
  const auto has_one = [](double slope) { return slope > 0; };
  options.refuse_if(std::ranges::count_if(first_slopes, has_one) != 1, skeleton_option, names,
                    "its stiffness must be along or about one axis only; give the other ones to a "
                    "group of their own");
  const auto found = std::ranges::find_if(first_slopes, has_one);
  Hysteresis& law = spring.law;
  law.positive.breaks = read_corners(options, skeleton_option, names, *found);
  law.positive.last_slope = law.negative.last_slope = spring.hardening * *found;
  law.negative.breaks = options.given(back_option, names)
                            ? read_corners(options, back_option, names, *found)
                            : law.positive.breaks;
  double least = law.positive.breaks.front().force;
  if (!law.negative.breaks.empty()) least = std::min(least, law.negative.breaks.front().force);
  spring.yield_force[static_cast<std::size_t>(found - first_slopes.begin())] = least;
  for (const Skeleton* skeleton : {&law.positive, &law.negative}) {
    if (skeleton->breaks.empty()) continue;
    const SkeletonBreak& last = skeleton->breaks.back();
    options.refuse_if(skeleton->last_slope > (1 + even) * last.force / last.elongation,
                      "<structure>_<group>_hardening", names,
                      "more than the secant of the last corner");
  }
}

/// Sliders in parallel cannot soften, nor have other slopes back than there.
void check_sliders(const OptionReader& options, const Names& names, std::string_view there,
                   std::string_view back, const Hysteresis& law) {
  options.refuse_if(law.is_one_sided() || law.positive.breaks.size() != law.negative.breaks.size(),
                    back, names, "kinematic hardening has the same slopes in both directions");
  double before = law.first_slope();
  for (std::size_t i = 1; i <= law.positive.breaks.size(); ++i) {
    const bool last = i == law.positive.breaks.size();
    const auto& plus = law.positive.breaks;
    const auto& minus = law.negative.breaks;
    const double slope = last ? law.positive.last_slope : slope_between(plus[i - 1], plus[i]);
    options.refuse_if(slope < -even * before || slope > (1 + even) * before, there, names,
                      "with kinematic hardening slopes must fall from corner to corner, and none "
                      "below 0; the rule peak may soften");
    options.refuse_if(
        !last && !(std::abs(slope_between(minus[i - 1], minus[i]) - slope) <= rounded * before),
        back, names, "kinematic hardening has the same slopes in both directions");
    before = slope;
  }
}

bool has_rule(const Hysteresis& law, std::initializer_list<HystereticRule> rules) {
  return std::ranges::find(rules, law.rule) != rules.end();
}

/// Numbers of the ways between loadings, for those laws that have them. `rules`: options of the
/// rules, for messages.
void read_paths(OptionReader& options, const Names& names, const std::string& rules,
                std::span<Hysteresis* const> laws) {
  using enum HystereticRule;
  const auto chosen = [&](std::string_view option, std::initializer_list<HystereticRule> wanted,
                          const char* with) {
    std::vector<Hysteresis*> found;
    std::ranges::copy_if(laws, std::back_inserter(found),
                         [&](const Hysteresis* law) { return has_rule(*law, wanted); });
    if (found.empty()) options.forbid(option, names, "goes with " + rules + " " + with);
    return found;
  };
  for (Hysteresis* const law :
       chosen(exponent_option, {peak, pinching, bending}, "peak, pinching or bending")) {
    if (options.given(exponent_option, names)) {
      law->unloading_exponent = options.real(exponent_option, names);
    } else if (law->rule == bending) {
      law->unloading_exponent = 0.5;
    }
  }
  for (Hysteresis* const law : chosen(least_option, {peak, pinching, bending, origin},
                                      "peak, pinching, bending or origin")) {
    law->unloading_least = options.real(least_option, names);
  }
  for (Hysteresis* const law : chosen(pinch_option, {pinching}, "pinching")) {
    const std::vector<double> pinch = options.reals(pinch_option, names, 2);
    options.refuse_if(!(pinch[0] <= pinch[1]) || !(pinch[1] < 1), pinch_option, names,
                      "the force must not exceed the way, nor the way reach 1");
    law->pinch_force = pinch[0];
    law->pinch_elongation = pinch[1];
  }
  for (Hysteresis* const law : chosen(deterioration_option, {peak, pinching}, "peak or pinching")) {
    if (!options.given(deterioration_option, names)) return;
    const std::vector<double> values = options.reals(deterioration_option, names);
    if (values.size() > 2) options.refuse(deterioration_option, names, "more than two numbers");
    law->lasting_energy = values[0];
    if (values.size() == 2) law->deterioration_exponent = values[1];
  }
}

/// Law with a skeleton that is the same both ways, whose first corner lies on a line of this slope.
Hysteresis read_law(OptionReader& options, const Names& names, std::string_view skeleton,
                    std::string_view rule, double first_slope) {
  Hysteresis law;
  law.rule = options.choice_of<HystereticRule>(rule, names);
  law.positive.breaks = read_corners(options, skeleton, names, first_slope);
  law.negative = law.positive;
  if (law.rule == HystereticRule::kinematic) {
    check_sliders(options, names, skeleton, skeleton, law);
  }
  return law;
}

/// Strength in bending that an axial force leaves.
void read_axial(OptionReader& options, const Names& names, YieldingSection& section) {
  constexpr std::string_view axial = "<structure>_<group>_bending_axial";
  if (!options.given(axial, names)) return;
  const auto follows = [](const std::optional<Hysteresis>& law) {
    return law && law->rule == HystereticRule::kinematic;
  };
  options.refuse_if(!follows(section.bending[0]) && !follows(section.bending[1]), axial, names,
                    "goes with -<structure>_<group>_bending_rule kinematic, the one rule whose "
                    "strength may change");
  const std::vector<double> values = options.reals(axial, names);
  if (values.size() > 2) options.refuse(axial, names, "more than two numbers");
  section.axial_strength = values[0];
  if (values.size() == 2) section.axial_exponent = values[1];
}

void read_cracking(OptionReader& options, const Names& names, Region& region) {
  constexpr std::string_view force = "<structure>_<group>_cracking_force";
  if (!options.given(force, names)) {
    options.forbid_all<ShellCracking>(names, "goes with -<structure>_<group>_cracking_force");
    return;
  }
  options.forbid("<structure>_<group>_shear_skeleton", names,
                 "not beside -<structure>_<group>_cracking_force: give one law or the other");
  options.refuse_if(region.material.poisson < 0, "material_<material>_poisson",
                    {region.material.name},
                    "group " + region.group + " cracks, whose energy wants one of 0 or above");
  ShellCracking& law = region.yielding_shell.cracking.emplace();
  options.read(law, names);
  if (law.moment == 0) law.moment = law.force * region.thickness / 6;
  if (!options.given("<structure>_<group>_cracked_bending", names)) law.bending = law.tension;
}

}  // namespace

void read_hysteresis(OptionReader& options, const Names& names,
                     const std::array<double, 6>& first_slopes, NonlinearSpring& spring) {
  Hysteresis& law = spring.law;
  law.rule = options.choice_of<HystereticRule>(rule_option, names);
  if (options.given(skeleton_option, names)) {
    read_skeleton(options, names, first_slopes, spring);
  } else {
    options.forbid(back_option, names, "goes with -<structure>_<group>_skeleton");
  }
  const bool kinematic = law.rule == HystereticRule::kinematic;
  options.refuse_if(
      !kinematic && !spring.yields(), rule_option, names,
      "nothing yields; give -<structure>_<group>_yield_force or -<structure>_<group>_skeleton");
  options.refuse_if(spring.has_circle() && (!kinematic || spring.has_skeleton()),
                    kinematic ? skeleton_option : rule_option, names,
                    "not beside -<structure>_<group>_yield_circle, on which kinematic hardening of "
                    "two slopes is all there is");
  Hysteresis* const laws[] = {&law};
  read_paths(options, names, "-<structure>_<group>_rule", laws);
  if (!spring.has_skeleton()) return;
  if (kinematic) check_sliders(options, names, skeleton_option, back_option, law);
  const bool one_sided = law.rule == HystereticRule::origin || law.rule == HystereticRule::peak ||
                         law.rule == HystereticRule::pinching;
  options.refuse_if(
      law.is_one_sided() && !one_sided, back_option, names,
      "what carries nothing back takes -<structure>_<group>_rule origin, peak or pinching");
}

void read_yielding_section(OptionReader& options, const Names& names, Region& region) {
  const Section& section = *region.section;
  const double shear = shear_modulus(region.material);
  const double young = region.material.young;
  std::vector<Hysteresis*> laws;
  const auto add = [&](const char* kind, std::size_t axis, double first_slope,
                       std::optional<Hysteresis>& law) {
    const std::string prefix = std::string("<structure>_<group>_") + kind;
    const std::string option = prefix + "_skeleton_" + "yz"[axis];
    if (!options.given(option, names)) return;
    options.refuse_if(!(first_slope > 0), option, names,
                      "the beam is not flexible in shear; give its section a shear_area");
    options.refuse_if(kind[0] == 's' && region.element == ElementType::euler_beam, option, names,
                      "an euler_beam is not flexible in shear and has no strength in it; give "
                      "-<structure>_<group>_element beam");
    law = read_law(options, names, option, prefix + "_rule", first_slope);
    laws.push_back(&*law);
  };
  add("shear", 0, shear * section.shear_area_y, region.yielding.shear[0]);
  add("shear", 1, shear * section.shear_area_z, region.yielding.shear[1]);
  add("bending", 0, young * section.inertia_y, region.yielding.bending[0]);
  add("bending", 1, young * section.inertia_z, region.yielding.bending[1]);
  for (const char* kind : {"shear", "bending"}) {
    const std::string prefix = std::string("<structure>_<group>_") + kind;
    const auto& of = kind[0] == 's' ? region.yielding.shear : region.yielding.bending;
    if (of[0] || of[1]) continue;
    options.forbid(prefix + "_rule", names,
                   "goes with -" + option_name(prefix + "_skeleton_y", names) + " or _z");
  }
  read_axial(options, names, region.yielding);
  read_paths(options, names, "-<structure>_<group>_shear_rule or -<structure>_<group>_bending_rule",
             laws);
}

void read_yielding_membrane(OptionReader& options, const Names& names, Region& region) {
  constexpr std::string_view skeleton = "<structure>_<group>_shear_skeleton";
  constexpr std::string_view rule = "<structure>_<group>_shear_rule";
  std::vector<Hysteresis*> laws;
  if (options.given(skeleton, names)) {
    region.yielding_shell.shear =
        read_law(options, names, skeleton, rule, shear_modulus(region.material));
    laws.push_back(&*region.yielding_shell.shear);
  } else {
    options.forbid(rule, names, "goes with -<structure>_<group>_shear_skeleton");
  }
  read_paths(options, names, "-<structure>_<group>_shear_rule", laws);
  read_cracking(options, names, region);
}

}  // namespace pounding
