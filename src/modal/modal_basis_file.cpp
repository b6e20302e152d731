#include "modal/modal_basis_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "common/error.h"
#include "common/hash.h"
#include "common/types.h"
#include "elements/element_traits.h"
#include "io/hdf5_file.h"
#include "io/hdf5_reader.h"
#include "io/schema.h"
#include "mesh/element_properties.h"
#include "system/matrix_system.h"

namespace pounding {
namespace {

constexpr const char* format = "pounding modal basis";

/// Attributes are those of a dataset, since a group that holds nothing else does not come to be.
constexpr const char* key_holder = "squared_frequency";

std::string difference(const Hdf5Reader& file, const BasisKey& key) {
  std::string names;
  for (const auto& [name, hash] : key) {
    if (file.text(key_holder, name) != hash) names += (names.empty() ? "" : ", ") + name;
  }
  return names;
}

constexpr double most_coordinates = 1e9;  // an int holds them
constexpr double largest_number = 9e15;   // whole numbers above are not distinguished
constexpr double last_component = component_names.size() - 1.0;

/// The value, if it is a whole number from 0 to `largest`; else throws std::runtime_error.
double whole(double value, double largest) {
  if (!(value >= 0 && value <= largest && value == std::floor(value))) {
    throw std::runtime_error("a number that must be whole");
  }
  return value;
}

ModalBasis read_arrays(const Hdf5Reader& file, std::size_t loads, bool start) {
  ModalBasis basis;
  basis.modes = static_cast<int>(whole(file.number("/", "modes"), most_coordinates));
  basis.attachment_vectors =
      static_cast<int>(whole(file.number("/", "attachment_vectors"), most_coordinates));
  basis.residual_vectors =
      static_cast<int>(whole(file.number("/", "residual_vectors"), most_coordinates));
  basis.full_dofs = static_cast<GlobalIndex>(whole(file.number("/", "full_dofs"), largest_number));
  basis.independent_dofs =
      static_cast<GlobalIndex>(whole(file.number("/", "independent_dofs"), largest_number));
  basis.largest_without_residual = file.number("/", "largest_without_residual");
  basis.total_mass = file.number("/", "total_mass");
  basis.mass = file.number("/", "mass");
  basis.squared_frequency = file.array("squared_frequency");
  if (basis.residual_vectors > 0) {
    basis.residual_squared_frequency = file.array("residual_squared_frequency");
  }
  for (const double number : file.array("mode_numbers")) {
    basis.mode_numbers.push_back(static_cast<int>(whole(number, most_coordinates)));
  }
  basis.participation = file.array("participation");
  const std::vector<double> centre = file.array("centre_of_mass");
  const std::vector<double> inertia = file.array("inertia");
  const std::vector<double> points = file.array("points");
  basis.rows = file.array("rows");
  if (loads > 0) basis.load_parts = file.array("load_parts");
  if (start) basis.start_parts = file.array("start_parts");
  const std::size_t size = basis.size();
  const auto modes = std::ranges::count_if(basis.mode_numbers, [](int n) { return n > 0; });
  if (size == 0 || basis.mode_numbers.size() != size || modes != basis.modes ||
      basis.participation.size() != 6 * size || centre.size() != 3 || inertia.size() != 6 ||
      points.size() % 2 != 0 || basis.rows.size() != points.size() / 2 * size ||
      basis.load_parts.size() != loads * size ||
      basis.start_parts.size() != (start ? 2 * size : 0) ||
      basis.residual_squared_frequency.size() != static_cast<std::size_t>(basis.residual_vectors) ||
      basis.modes + basis.attachment_vectors + basis.residual_vectors != static_cast<int>(size)) {
    throw std::runtime_error("sizes that do not belong together");
  }
  for (const auto* values : std::initializer_list<const std::vector<double>*>{
           &basis.squared_frequency, &basis.residual_squared_frequency, &basis.participation,
           &centre, &inertia, &points, &basis.rows, &basis.load_parts, &basis.start_parts}) {
    if (!std::ranges::all_of(*values, [](double value) { return std::isfinite(value); })) {
      throw std::runtime_error("a value is not finite");
    }
  }
  if (!(basis.squared_frequency.front() >= 0) || !std::ranges::is_sorted(basis.squared_frequency) ||
      !(basis.mass > 0) || !(basis.total_mass > 0)) {
    throw std::runtime_error("frequencies or masses that cannot be");
  }
  std::copy(centre.begin(), centre.end(), basis.centre_of_mass.begin());
  std::copy(inertia.begin(), inertia.end(), basis.inertia.begin());
  for (std::size_t i = 0; i < points.size(); i += 2) {
    basis.points.push_back({static_cast<GlobalIndex>(whole(points[i], largest_number)),
                            static_cast<int>(whole(points[i + 1], last_component))});
  }
  return basis;
}

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
    if (!nodes.rows.empty()) hash.add_all(nodes.rows);
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

void write_modal_basis(const std::string& path, const BasisKey& key, const ModalBasis& basis) {
  Hdf5File file(path + ".new", Hdf5File::Kind::sealed);
  file.write_attribute("/", "format", format);
  schema::write(file, schema::basis);
  file.write_attribute("/", "modes", basis.modes);
  file.write_attribute("/", "attachment_vectors", basis.attachment_vectors);
  file.write_attribute("/", "residual_vectors", basis.residual_vectors);
  file.write_attribute("/", "full_dofs", static_cast<double>(basis.full_dofs));
  file.write_attribute("/", "independent_dofs", static_cast<double>(basis.independent_dofs));
  file.write_attribute("/", "largest_without_residual", basis.largest_without_residual);
  file.write_attribute("/", "total_mass", basis.total_mass);
  file.write_attribute("/", "mass", basis.mass);
  file.write_array("squared_frequency", 0, basis.squared_frequency);
  if (basis.residual_vectors > 0) {
    file.write_array("residual_squared_frequency", 0, basis.residual_squared_frequency);
  }
  for (const auto& [name, hash] : key) file.write_attribute(key_holder, name, hash);
  file.write_array("mode_numbers", 0,
                   std::vector<double>(basis.mode_numbers.begin(), basis.mode_numbers.end()));
  file.write_array("participation", basis.size(), basis.participation);
  file.write_array("centre_of_mass", 0, basis.centre_of_mass);
  file.write_array("inertia", 0, basis.inertia);
  std::vector<double> points;
  for (const TracePoint& point : basis.points) {
    points.insert(points.end(),
                  {static_cast<double>(point.node), static_cast<double>(point.component)});
  }
  file.write_array("points", 2, points);
  file.write_array("rows", basis.size(), basis.rows);
  if (!basis.load_parts.empty()) file.write_array("load_parts", basis.size(), basis.load_parts);
  if (!basis.start_parts.empty()) {
    file.write_array("start_parts", basis.size(), basis.start_parts);
  }
  file.close();
  file.move_to(path);
}

StoredBasis read_modal_basis(const std::string& path, const BasisKey& key, std::size_t loads,
                             bool start) {
  const Hdf5Reader file(path, Hdf5Reader::Kind::sealed);
  try {
    if (file.text("/", "format") != format) throw std::runtime_error("another format");
    schema::require(file, schema::basis);
    StoredBasis stored;
    stored.differs = difference(file, key);
    if (stored.differs.empty()) stored.basis = read_arrays(file, loads, start);
    return stored;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": no modal basis, or a damaged one (" + error.what() + ")");
  }
}

BasisKey basis_key(const Structure& structure, const GlobalMesh& mesh,
                   const ModalRequest& request) {
  Hash clamp;
  clamp.add_all(mesh.free_components);
  Hash vectors;
  vectors.add_all(
      std::array{static_cast<double>(request.modes), request.cutoff, request.attachment ? 1. : 0.});
  if (request.residual) vectors.add("residual");
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
