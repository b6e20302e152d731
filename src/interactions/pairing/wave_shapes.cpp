#include "interactions/pairing/wave_shapes.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "common/error.h"
#include "common/facts.h"
#include "io/hdf5_reader.h"

namespace pounding::interactions {
namespace {

constexpr double same_node = 1e-6;  // m

/// Along one axis.
struct WaveShapes {
  std::size_t direction = 0;
  std::size_t count = 0;
  std::vector<double> values;  ///< shape (nodes, count)
};

std::vector<WaveShapes> read_shapes(const Hdf5Reader& reader, std::size_t nodes) {
  std::vector<WaveShapes> all;
  for (std::size_t d = 0; d < 3; ++d) {
    const std::string axis = direction_names[d];
    if (reader.names(axis).empty()) continue;
    const auto [rows, columns] = reader.shape(axis + "/shapes");
    if (rows != nodes || columns != reader.shape(axis + "/histories").rows) {
      throw std::runtime_error("its shapes along " + axis + " fit neither nodes nor histories");
    }
    all.push_back({d, columns, reader.array(axis + "/shapes")});
  }
  return all;
}

/// The number of the node at a place.
std::size_t node_at(const Vector3& place, const std::vector<double>& nodes,
                    const Structure& structure) {
  for (std::size_t i = 0; i + 2 < nodes.size(); i += 3) {
    if (distance({nodes[i], nodes[i + 1], nodes[i + 2]}, place) < same_node) return i / 3;
  }
  throw std::runtime_error(
      sentence("it has no node at ({}, {}, {}), where structure {} has one of its base",
               {place[0], place[1], place[2], structure.name}));
}

}  // namespace

void add_wave_shapes(const std::string& file, const Structure& structure, GlobalMesh& mesh) try {
  if (file.empty()) return;
  const Hdf5Reader reader(file);
  const std::vector<double> nodes = reader.array("nodes");
  const std::vector<WaveShapes> all = read_shapes(reader, nodes.size() / 3);
  for (AbsorbingNode& node : mesh.absorbing) {
    if (std::ranges::count(node.incident, 0.0) == 9) continue;  // away from the base
    const std::size_t at = node_at(mesh.position(node.node), nodes, structure);
    std::vector<double> wide;
    for (auto along = node.incident.begin(); along != node.incident.end(); along += 3) {
      wide.insert(wide.end(), along, along + 3);
      for (const auto& [direction, count, values] : all) {
        for (std::size_t k = at * count; k < (at + 1) * count; ++k) {
          wide.push_back(along[static_cast<std::ptrdiff_t>(direction)] * values[k]);
        }
      }
    }
    node.incident = std::move(wide);
  }
} catch (const std::runtime_error& error) {
  throw UserError("option -motion_incoherent " + file + ": " + error.what() +
                  "; give a file that run/incoherent makes of this mesh");
}

}  // namespace pounding::interactions
