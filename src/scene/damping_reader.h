#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

inline constexpr std::string_view region_damping_factor = "<structure>_<group>_damping_factor";

/// Refuses the options of the damping of a region, `names` being its structure and group.
void forbid_damping(const OptionReader& options, const OptionReader::Names& names,
                    const Region& region, const std::string& why);

/// Rayleigh damping of a structure: alpha and beta, or one damping ratio at two frequencies. Throws
/// UserError.
Rayleigh read_structure_damping(OptionReader& options, const std::string& structure);

/// Uniform damping of a structure over a band, if it is asked for; then Rayleigh damping of the
/// structure is refused. Throws UserError.
std::optional<UniformDamping> read_uniform_damping(OptionReader& options,
                                                   const std::string& structure);

/// Damping of a region, `names` being its structure and group; alpha and beta that are not given is
/// that of `inherited`. Nothing where the region has no damping options at all. Refused for
/// tension-only bars, whose force has one beta, that of their structure. Throws UserError.
std::optional<Rayleigh> read_region_damping(OptionReader& options, const OptionReader::Names& names,
                                            const Region& region, const Rayleigh& inherited);

}  // namespace pounding
