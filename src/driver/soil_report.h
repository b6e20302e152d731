#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "interactions/pairing/absorbing_faces.h"
#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Prints the absorbing faces of a structure and which of them the motion enters through; nothing
/// without such faces.
void print_absorbing(const Structure& structure, const interactions::AbsorbingReport& report);

/// Absorbing faces of a structure for the summary, in SI.
nlohmann::ordered_json describe_absorbing(const Structure& structure,
                                          const interactions::AbsorbingReport& report);

/// A group of springs that are spread over an area or along lines.
struct SpreadReport {
  const Region* region = nullptr;  ///< borrowed from the structure
  std::int64_t nodes = 0;
  double extent = 0;  ///< [m2] or [m]
};

/// The groups of a structure whose springs are spread, in the order of its regions.
std::vector<SpreadReport> find_spread_springs(const Structure& structure, const GlobalMesh& mesh);

/// Prints over what each group is spread and its stiffness as a whole; nothing without such groups.
void print_spread_springs(std::span<const SpreadReport> groups);

/// Groups of spread springs for the summary, in SI.
nlohmann::ordered_json describe_spread_springs(std::span<const SpreadReport> groups);

/// Frequency of a0 = 2, up to which the impedances of a mat's soil are meant to hold [Hz].
double largest_soil_frequency(const Soil& soil, const Foundation& foundation);

/// Prints the soil under a structure's mat, its impedances and the frequency up to which they hold;
/// nothing without soil.
void print_soil(const Structure& structure);

/// Soil under a mat for the summary, in SI. The structure has soil and its foundation is known.
nlohmann::ordered_json describe_soil(const Structure& structure);

}  // namespace pounding
