#include "modal/basis_key.h"

#include <array>
#include <fstream>

#include "common/error.h"
#include "common/finite_file.h"
#include "common/hash.h"
#include "elements/element_traits.h"
#include "mesh/element_properties.h"
#include "system/matrix_system.h"

namespace pounding {
namespace {

std::string hash_of(std::span<const TracePoint> points) {
  Hash hash;
  for (const TracePoint& point : points) {
    hash.add(static_cast<double>(point.node));
    hash.add(static_cast<double>(point.component));
  }
  return hash.text();
}

void add_values(const std::vector<NodalValue>& values, Hash& hash) {
  for (const NodalValue& value : values) {
    hash.add(static_cast<double>(value.node));
    hash.add(static_cast<double>(value.component));
    hash.add(value.value);
  }
  hash.add(static_cast<double>(values.size()));
}

std::string hash_of(std::span<const NodalLoad> loads) {
  Hash hash;
  for (const NodalLoad& load : loads) {
    add_values(load.forces, hash);
  }
  return hash.text();
}

std::string hash_of(const GlobalMesh& mesh) {
  Hash hash;
  hash.add_all(mesh.coordinates);
  hash.add_all(mesh.components);
  for (const ElementSet& set : mesh.regions) {
    hash.add(set.group);
    hash.add(static_cast<double>(set.type));
    hash.add_all(set.connectivity);
    if (!set.share.empty()) hash.add_all(set.share);
  }
  return hash.text();
}

std::string hash_of(const std::vector<RigidNodes>& rigid) {
  Hash hash;
  for (const RigidNodes& nodes : rigid) {
    hash.add(static_cast<double>(nodes.components));
    hash.add_all(nodes.nodes);
    for (const TiedNode& tied : nodes.tied) {
      hash.add(static_cast<double>(tied.node));
      for (const Carrier& carrier : tied.carriers) {
        hash.add(static_cast<double>(carrier.node));
        hash.add_all(carrier.block);
      }
    }
  }
  return hash.text();
}

/// Formulations, materials, sections and whatever else makes element matrices.
std::string hash_of(const std::vector<Region>& regions) {
  Hash hash;
  hash.add(static_cast<double>(element_formulations));
  for (const Region& region : regions) {
    const ElementProperties p = element_properties(region);
    hash.add(region.group);
    hash.add(static_cast<double>(region.element));
    hash.add_all(std::array{p.young, p.poisson, p.density, p.area, p.inertia_y, p.inertia_z,
                            p.torsion, p.thickness, p.rotary_inertia_factor, p.mass});
    hash.add_all(p.z_axis);
    hash.add_all(p.rotary_inertia);
    hash.add_all(region.stiffness);
    if (region.element == ElementType::beam) {
      hash.add_all(std::array{p.shear_area_y, p.shear_area_z, p.resolved_frequency});
    }
    if (p.added_mass != 0) hash.add(p.added_mass);
    if (p.drilling_factor != 1) hash.add(p.drilling_factor);
    for (const GroundSpring& spring : p.ground_springs) {
      hash.add(spring.stiffness);
      hash.add_all(spring.motion);
    }
  }
  return hash.text();
}

/// The content of a file; nothing of none.
void add_file(const std::string& path, Hash& hash) {
  hash.add(path.empty() ? 0. : 1.);
  if (path.empty()) return;
  require_finite_file(path);
  std::ifstream file(path, std::ios::binary);
  std::string block(1 << 20, '\0');
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    hash.add(block.substr(0, static_cast<std::size_t>(file.gcount())));
  }
  if (!file.eof()) throw UserError(path + ": no such file, or it cannot be read");
}

std::string hash_of_matrices(const std::string& folder) {
  Hash hash;
  if (!folder.empty()) {
    add_file(folder + "/dofs.csv", hash);
    add_file(matrix_file(folder, "stiffness"), hash);
    add_file(matrix_file(folder, "mass"), hash);
  }
  return hash.text();
}

}  // namespace

BasisKey basis_key(const Structure& structure, const GlobalMesh& mesh,
                   const ModalRequest& request) {
  Hash clamp;
  clamp.add_all(mesh.free_components);
  Hash vectors;
  vectors.add_all(
      std::array{static_cast<double>(request.modes), request.cutoff, request.attachment ? 1. : 0.});
  if (request.candidates > request.modes) vectors.add(static_cast<double>(request.candidates));
  if (request.gravity != Vector3{0, 0, 0}) vectors.add_all(request.gravity);
  if (structure.p_delta) vectors.add("p_delta");
  if (!request.loads.empty()) vectors.add(hash_of(request.loads));
  if (structure.p_delta) vectors.add_all(request.loads_at_rest);
  if (!request.start.empty()) {
    vectors.add("start");
    add_values(request.start.displacement, vectors);
    add_values(request.start.velocity, vectors);
    vectors.add_all(request.start_displacement);
    vectors.add_all(request.start_velocity);
  }
  if (request.attachment && request.patches > 0) {
    vectors.add("patches");
    vectors.add(static_cast<double>(request.patches));
  }
  if (!request.yielding_points.empty()) vectors.add(hash_of(request.yielding_points));
  std::vector<TracePoint> places = request.other_points;
  places.insert(places.end(), request.shown_points.begin(), request.shown_points.end());
  return {{"mesh", hash_of(mesh)},
          {"elements", hash_of(structure.regions)},
          {"matrices", hash_of_matrices(structure.matrices)},
          {"clamp", clamp.text()},
          {"rigid groups", hash_of(mesh.rigid)},
          {"number of vectors", vectors.text()},
          {"contact points", hash_of(request.contact_points)},
          {"probe points", hash_of(places)}};
}

}  // namespace pounding
