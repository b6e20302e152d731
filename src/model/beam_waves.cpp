#include "model/beam_waves.h"

#include <algorithm>
#include <numbers>

#include "common/facts.h"
#include "common/matrix3.h"
#include "common/parallel.h"
#include "elements/beam2.h"
#include "mesh/element_properties.h"

namespace pounding {
namespace {

constexpr double fewest_in_half_wave = 2;

/// Adds the beams of a block on this rank.
void add_block(const Mesh& mesh, const ElementBlock& block, const ElementProperties& properties,
               BeamWaves& waves) {
  for (std::size_t e = 0; e < block.count(); ++e) {
    const Vector3 first = mesh.position(block.connectivity[2 * e]);
    const double length = norm(minus(mesh.position(block.connectivity[2 * e + 1]), first));
    waves.length = std::max(waves.length, length);
    if (properties.resolved_frequency == 0) continue;
    const double part = added_rotary_part(properties, length);
    if (part > 0) waves.heavier += block.counted[e];
    waves.largest_part = std::max(waves.largest_part, part);
  }
}

}  // namespace

std::vector<BeamWaves> beam_waves(MPI_Comm comm, const Structure& structure, const Mesh& mesh) {
  std::vector<BeamWaves> all;
  for (std::size_t r = 0; r < structure.regions.size(); ++r) {
    const Region& region = structure.regions[r];
    if (!is_beam(region.element)) continue;
    BeamWaves& waves = all.emplace_back();
    waves.group = region.group;
    const ElementProperties properties = element_properties(region);
    for (const ElementBlock& block : mesh.blocks) {
      if (block.region == static_cast<int>(r)) add_block(mesh, block, properties, waves);
    }
    reduce_over_ranks(comm, MPI_MAX, waves.length, waves.largest_part);
    reduce_over_ranks(comm, MPI_SUM, waves.heavier);
  }
  return all;
}

std::vector<std::string> wave_doubts(const Structure& structure,
                                     const std::vector<BeamWaves>& waves,
                                     const std::vector<Mode>& modes) {
  std::vector<std::string> doubts;
  for (const BeamWaves& of : waves) {
    const Region& region = *std::ranges::find(structure.regions, of.group, &Region::group);
    const ElementProperties properties = element_properties(region);
    const double highest = region.resolved_frequency / (2 * std::numbers::pi);
    for (std::size_t m = 0; m < modes.size() && modes[m].frequency <= highest; ++m) {
      if (!(modes[m].frequency > 0) || !modes[m].location.empty()) continue;
      const double half = half_wave(properties, 2 * std::numbers::pi * modes[m].frequency);
      if (half >= fewest_in_half_wave * of.length) continue;
      doubts.push_back(
          sentence("structure {}, group {}: mode {} of {:.4g} Hz has {:.2g} of its beams of {:.4g} "
                   "m in half a wave of their bending, whose mass they carry at their ends; finer "
                   "ones, or -{}_{}_divide auto, which makes 4 of them up to {:.4g} Hz",
                   {structure.name, of.group, m + 1, modes[m].frequency, half / of.length,
                    of.length, structure.name, of.group, highest}));
      break;
    }
  }
  return doubts;
}

bool follows_spectra(const Structure& structure, const std::vector<BeamWaves>& waves) {
  const bool divided = std::ranges::any_of(structure.regions, [](const Region& region) {
    return is_beam(region.element) && region.parts == 0;
  });
  return divided || std::ranges::any_of(waves, [](const BeamWaves& of) { return of.heavier > 0; });
}

}  // namespace pounding
