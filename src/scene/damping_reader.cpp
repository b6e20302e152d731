#include "scene/damping_reader.h"

#include <algorithm>
#include <numbers>

namespace pounding {
namespace {

using Names = OptionReader::Names;

/// Beginnings and ends of the options of Rayleigh damping.
const std::string structure_damping = "<structure>_damping_";
const std::string region_damping = "<structure>_<group>_damping_";
const std::string details[] = {"alpha", "beta", "ratio", "frequencies"};

/// alpha and beta from one damping ratio xi at two circular frequencies:
/// alpha = 2 xi w1 w2 / (w1 + w2), beta = 2 xi / (w1 + w2).
Rayleigh read_damping_ratio(OptionReader& options, const std::string& head, const Names& names) {
  options.forbid_each(head, {"alpha", "beta"}, names,
                      "give either alpha and beta, or ratio and frequencies");
  const double ratio = options.real(head + "ratio", names);
  const std::vector<double> f = options.reals(head + "frequencies", names, 2);
  const double w1 = 2 * std::numbers::pi * f[0];
  const double w2 = 2 * std::numbers::pi * f[1];
  return {2 * ratio * w1 * w2 / (w1 + w2), 2 * ratio / (w1 + w2)};
}

/// Rayleigh damping as given; an alpha or beta that is neither given nor has a default of its own
/// is that of `inherited`.
Rayleigh read_damping(OptionReader& options, const std::string& head, const Names& names,
                      const Rayleigh& inherited) {
  if (options.given(head + "ratio", names)) return read_damping_ratio(options, head, names);
  options.forbid(head + "frequencies", names, goes_with(head + "ratio"));
  const auto number = [&](std::string_view pattern, double otherwise) {
    const bool known = options.given(pattern, names) || option_row(pattern).preset.has_value;
    return known ? options.real(pattern, names) : otherwise;
  };
  return {number(head + "alpha", inherited.alpha), number(head + "beta", inherited.beta)};
}

/// Whether a structure asks for Rayleigh damping that is not nothing.
bool gives_rayleigh(OptionReader& options, const Names& names) {
  return options.given(structure_damping + "ratio", names) ||
         options.real(structure_damping + "alpha", names) != 0 ||
         options.real(structure_damping + "beta", names) != 0;
}

}  // namespace

void forbid_damping(const OptionReader& options, const Names& names, const Region& region,
                    const std::string& why) {
  for (const std::string& detail : details) options.forbid(region_damping + detail, names, why);
  options.refuse_if(region.damping_factor != 1, region_damping_factor, names, why);
}

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
    options.forbid_all<UniformDamping>(names, goes_with(uniform));
    return std::nullopt;
  }
  if (options.real(uniform, names) == 0 && gives_rayleigh(options, names)) return std::nullopt;
  const std::string why = "give either this or -<structure>_damping_uniform, not both";
  for (const std::string& pattern : {structure_damping + "alpha", structure_damping + "beta"}) {
    options.refuse_if(options.real(pattern, names) != 0, pattern, names,
                      why + " (0 takes back the value of an included file)");
  }
  options.forbid_each(structure_damping, {"ratio", "frequencies"}, names, why);
  const std::vector<double> ends = options.reals(band, names, 2);
  options.refuse_if(!(ends[0] < ends[1]), band, names,
                    "the lower frequency first, then the higher one");
  const double ratio = read_damping_factor(options, structure) * options.real(uniform, names);
  options.refuse_if(!option_row(uniform).range.contains(ratio), uniform, names,
                    "times -<structure>_damping_factor it is too large");
  UniformDamping damping =
      fit_uniform_damping(ratio, ends[0], ends[1], options.integer(filters, names));
  options.read(damping, names);
  return damping;
}

std::optional<Rayleigh> read_region_damping(OptionReader& options, const Names& names,
                                            const Region& region, const Rayleigh& inherited) {
  if (is_nonlinear(region)) {
    forbid_damping(options, names, region,
                   "elements with tension_only or compression_only take the damping of their "
                   "structure, those that yield none; leave it out");
  }
  const bool given = std::ranges::any_of(details, [&](const std::string& detail) {
    return options.given(region_damping + detail, names);
  });
  if (!given) return std::nullopt;
  return read_damping(options, region_damping, names, inherited);
}

}  // namespace pounding
