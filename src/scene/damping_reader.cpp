#include "scene/damping_reader.h"

#include <numbers>
#include <string_view>

namespace pounding {
namespace {

using Names = OptionReader::Names;

/// The options of Rayleigh damping of a structure or of a region.
struct DampingPatterns {
  std::string_view alpha;
  std::string_view beta;
  std::string_view ratio;
  std::string_view frequencies;
};

constexpr DampingPatterns structure_damping{"<structure>_damping_alpha", "<structure>_damping_beta",
                                            "<structure>_damping_ratio",
                                            "<structure>_damping_frequencies"};
constexpr DampingPatterns region_damping{
    "<structure>_<group>_damping_alpha", "<structure>_<group>_damping_beta",
    "<structure>_<group>_damping_ratio", "<structure>_<group>_damping_frequencies"};

/// alpha and beta from one damping ratio xi at two circular frequencies:
/// alpha = 2 xi w1 w2 / (w1 + w2), beta = 2 xi / (w1 + w2).
Rayleigh read_damping_ratio(OptionReader& options, const DampingPatterns& patterns,
                            const Names& names) {
  const std::string both = "give either alpha and beta, or ratio and frequencies";
  options.forbid(patterns.alpha, names, both);
  options.forbid(patterns.beta, names, both);
  const double ratio = options.real(patterns.ratio, names);
  const std::vector<double> f = options.reals(patterns.frequencies, names, 2);
  const double w1 = 2 * std::numbers::pi * f[0];
  const double w2 = 2 * std::numbers::pi * f[1];
  return {2 * ratio * w1 * w2 / (w1 + w2), 2 * ratio / (w1 + w2)};
}

/// Rayleigh damping as given; an alpha or beta that is neither given nor has a default of its own
/// is that of `inherited`.
Rayleigh read_damping(OptionReader& options, const DampingPatterns& patterns, const Names& names,
                      const Rayleigh& inherited) {
  if (options.given(patterns.ratio, names)) return read_damping_ratio(options, patterns, names);
  options.forbid(patterns.frequencies, names, goes_with(patterns.ratio, names));
  const auto number = [&](std::string_view pattern, double otherwise) {
    const bool known = options.given(pattern, names) || option_row(pattern).preset.has_value;
    return known ? options.real(pattern, names) : otherwise;
  };
  return {number(patterns.alpha, inherited.alpha), number(patterns.beta, inherited.beta)};
}

/// Whether a structure asks for Rayleigh damping that is not nothing.
bool gives_rayleigh(OptionReader& options, const Names& names) {
  return options.given(structure_damping.ratio, names) ||
         options.real(structure_damping.alpha, names) != 0 ||
         options.real(structure_damping.beta, names) != 0;
}

}  // namespace

Rayleigh read_structure_damping(OptionReader& options, const std::string& structure) {
  const Rayleigh damping = read_damping(options, structure_damping, {structure}, {});
  const double factor = read_damping_factor(options, structure);
  return {factor * damping.alpha, factor * damping.beta};
}

std::optional<UniformDamping> read_uniform_damping(OptionReader& options,
                                                   const std::string& structure) {
  constexpr std::string_view uniform = "<structure>_damping_uniform";
  constexpr std::string_view band = "<structure>_damping_band";
  constexpr std::string_view filters = "<structure>_damping_filters";
  const Names names{structure};
  if (!options.given(uniform, names)) {
    options.forbid_all<UniformDamping>(names, goes_with(uniform, names));
    return std::nullopt;
  }
  if (options.real(uniform, names) == 0 && gives_rayleigh(options, names)) return std::nullopt;
  const std::string why = "give either this or -" + option_name(uniform, names) + ", not both";
  for (const std::string_view pattern : {structure_damping.alpha, structure_damping.beta}) {
    if (options.real(pattern, names) != 0) {
      options.refuse(pattern, names, why + " (0 takes back the value of an included file)");
    }
  }
  options.forbid(structure_damping.ratio, names, why);
  options.forbid(structure_damping.frequencies, names, why);
  const std::vector<double> ends = options.reals(band, names, 2);
  if (!(ends[0] < ends[1])) {
    options.refuse(band, names, "the lower frequency first, then the higher one");
  }
  const double ratio = read_damping_factor(options, structure) * options.real(uniform, names);
  if (!option_row(uniform).range.contains(ratio)) {
    options.refuse(uniform, names, "times -" + structure + "_damping_factor it is too large");
  }
  UniformDamping damping =
      fit_uniform_damping(ratio, ends[0], ends[1], options.integer(filters, names));
  options.read(damping, names);
  return damping;
}

std::optional<Rayleigh> read_region_damping(OptionReader& options, const Names& names,
                                            const Region& region, const Rayleigh& inherited) {
  bool given = false;
  const std::string why =
      "elements with tension_only or compression_only take the damping of their structure, "
      "those that yield none; leave it out";
  for (const std::string_view pattern : {region_damping.alpha, region_damping.beta,
                                         region_damping.ratio, region_damping.frequencies}) {
    if (is_nonlinear(region)) options.forbid(pattern, names, why);
    given = given || options.given(pattern, names);
  }
  if (is_nonlinear(region) && region.damping_factor != 1) {
    options.refuse(region_damping_factor, names, why);
  }
  if (!given) return std::nullopt;
  return read_damping(options, region_damping, names, inherited);
}

}  // namespace pounding
