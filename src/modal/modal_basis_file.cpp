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

constexpr const char* wrong_sizes = "sizes that do not belong together";
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

void from_file(const std::vector<double>& numbers, std::vector<double>& values) {
  values = numbers;
}
template <std::size_t size>
void from_file(const std::vector<double>& numbers, std::array<double, size>& values) {
  if (numbers.size() != size) throw std::runtime_error(wrong_sizes);
  std::ranges::copy(numbers, values.begin());
}
void from_file(const std::vector<double>& numbers, std::vector<int>& values) {
  for (const double number : numbers) {
    values.push_back(static_cast<int>(whole(number, most_coordinates)));
  }
}
void from_file(const std::vector<double>& numbers, std::vector<TracePoint>& points) {
  if (numbers.size() % 2 != 0) throw std::runtime_error(wrong_sizes);
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    points.push_back({static_cast<GlobalIndex>(whole(numbers[i], largest_number)),
                      static_cast<int>(whole(numbers[i + 1], last_component))});
  }
}

std::vector<double> to_file(const auto& values) {
  return {values.begin(), values.end()};
}
std::vector<double> to_file(const std::vector<TracePoint>& points) {
  std::vector<double> numbers;
  for (const TracePoint& point : points) {
    numbers.insert(numbers.end(),
                   {static_cast<double>(point.node), static_cast<double>(point.component)});
  }
  return numbers;
}

ModalBasis read_members(const Hdf5Reader& file, const ModalRequest& request) {
  const std::size_t loads = request.loads.size();
  const std::size_t columns = request.supports.size();
  ModalBasis basis;
  const std::vector<std::string> arrays = file.names("/");
  ModalBasis::describe(basis, [&](const char* name, auto& value, ModalBasis::Shape shape) {
    using Value = std::remove_reference_t<decltype(value)>;
    if constexpr (std::is_floating_point_v<Value>) {
      value = file.number("/", name);
    } else if constexpr (std::is_integral_v<Value>) {
      value = static_cast<Value>(
          whole(file.number("/", name), sizeof value == 4 ? most_coordinates : largest_number));
    } else if (!shape.maybe || std::ranges::find(arrays, name) != arrays.end()) {
      const std::vector<double> numbers = file.array(name);
      if (!std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); })) {
        throw std::runtime_error("a value is not finite");
      }
      from_file(numbers, value);
    }
  });
  const std::size_t size = basis.size();
  const auto modes = std::ranges::count_if(basis.mode_numbers, [](int n) { return n > 0; });
  if (size == 0 || basis.mode_numbers.size() != size || modes != basis.modes ||
      basis.participation.size() != 6 * size || basis.rows.size() != basis.points.size() * size ||
      basis.load_parts.size() != loads * size ||
      basis.support_participation.size() != columns * size ||
      basis.support_rows.size() != columns * basis.points.size() ||
      basis.start_parts.size() != (request.start.empty() ? 0 : 2 * size) ||
      basis.residual_squared_frequency.size() != static_cast<std::size_t>(basis.residual_vectors) ||
      basis.modes + basis.attachment_vectors + basis.residual_vectors != static_cast<int>(size)) {
    throw std::runtime_error(wrong_sizes);
  }
  if (!(basis.squared_frequency.front() >= 0) || !std::ranges::is_sorted(basis.squared_frequency) ||
      !(basis.mass > 0) || !(basis.total_mass > 0)) {
    throw std::runtime_error("frequencies or masses that cannot be");
  }
  return basis;
}

std::string hash_of(std::span<const TracePoint> points) {
  Hash hash;
  for (const TracePoint& point : points) {
    hash.add(point.node, point.component);
  }
  return hash.text();
}

void add_values(const std::vector<NodalValue>& values, Hash& hash) {
  for (const NodalValue& value : values) {
    hash.add(value.node, value.component, value.value);
  }
  hash.add(values.size());
}

std::string hash_of(std::span<const NodalLoad> loads) {
  Hash hash;
  for (const NodalLoad& load : loads) {
    add_values(load.forces, hash);
  }
  return hash.text();
}

/// Columns of the supports' motion, and the parts of the structure on the supports.
std::string hash_of(std::span<const SupportColumn> columns, const GlobalMesh& mesh) {
  Hash hash;
  for (const SupportColumn& column : columns) {
    hash.add(column.support, column.component);
    if (column.component >= 3) hash.add(column.point);
  }
  hash.add(mesh.ground_support);
  for (const SupportedNode& node : mesh.supported) {
    hash.add(node.node, node.support);
  }
  return hash.text();
}

std::string hash_of(const GlobalMesh& mesh) {
  Hash hash;
  hash.add(mesh.coordinates, mesh.components);
  for (const ElementSet& set : mesh.regions) {
    hash.add(set.group, set.type, set.connectivity);
    if (!set.share.empty()) hash.add(set.share);
  }
  return hash.text();
}

std::string hash_of(const std::vector<RigidNodes>& rigid) {
  Hash hash;
  for (const RigidNodes& nodes : rigid) {
    hash.add(nodes.components, nodes.nodes);
    if (!nodes.rows.empty()) hash.add(nodes.rows);
    for (const TiedNode& tied : nodes.tied) {
      hash.add(tied.node);
      for (const Carrier& carrier : tied.carriers) {
        hash.add(carrier.node, carrier.block);
      }
    }
  }
  return hash.text();
}

std::string hash_of(const std::vector<WaterBody>& waters) {
  Hash hash;
  for (const WaterBody& water : waters) {
    hash.add(water.density, water.nodes, water.columns, water.laplacian);
    for (const Vector3& area : water.area) hash.add(area);
  }
  return hash.text();
}

/// Formulations, materials, sections and whatever else makes element matrices.
std::string hash_of(const std::vector<Region>& regions) {
  Hash hash;
  hash.add(element_formulations);
  for (const Region& region : regions) {
    const ElementProperties p = element_properties(region);
    hash.add(region.group, region.element);
    hash.add(std::array{p.young, p.poisson, p.density, p.area, p.inertia_y, p.inertia_z, p.torsion,
                        p.thickness, p.rotary_inertia_factor, p.mass});
    hash.add(p.z_axis, p.rotary_inertia, region.stiffness);
    if (region.element == ElementType::beam) {
      hash.add(std::array{p.shear_area_y, p.shear_area_z, p.resolved_frequency});
    }
    if (p.added_mass != 0) hash.add(p.added_mass);
    if (p.drilling_factor != 1) hash.add(p.drilling_factor);
    for (const GroundSpring& spring : p.ground_springs) {
      hash.add(spring.stiffness, spring.motion);
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
  ModalBasis::describe(basis, [&](const char* name, const auto& value, ModalBasis::Shape shape) {
    if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(value)>>) {
      file.write_attribute("/", name, static_cast<double>(value));
    } else if (!(shape.maybe && value.empty())) {
      file.write_array(name,
                       shape.columns == ModalBasis::each_coordinate ? basis.size() : shape.columns,
                       to_file(value));
    }
  });
  for (const auto& [name, hash] : key) file.write_attribute(key_holder, name, hash);
  file.close();
  file.move_to(path);
}

StoredBasis read_modal_basis(const std::string& path, const BasisKey& key,
                             const ModalRequest& request) {
  const Hdf5Reader file(path, Hdf5Reader::Kind::sealed);
  try {
    if (file.text("/", "format") != format) throw std::runtime_error("another format");
    schema::require(file, schema::basis);
    StoredBasis stored;
    stored.differs = difference(file, key);
    if (stored.differs.empty()) stored.basis = read_members(file, request);
    return stored;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": no modal basis, or a damaged one (" + error.what() + ")");
  }
}

BasisKey basis_key(const Structure& structure, const GlobalMesh& mesh,
                   const ModalRequest& request) {
  Hash clamp;
  clamp.add(mesh.free_components);
  Hash vectors;
  vectors.add(
      std::array{static_cast<double>(request.modes), request.cutoff, request.attachment ? 1. : 0.});
  if (request.residual) vectors.add("residual");
  if (request.switched_part > 0) {
    vectors.add("switched", request.switched_part);
  }
  if (request.candidates > request.modes) vectors.add(static_cast<double>(request.candidates));
  if (request.gravity != Vector3{0, 0, 0}) vectors.add(request.gravity);
  if (structure.p_delta) vectors.add("p_delta");
  if (!request.loads.empty()) vectors.add(hash_of(request.loads));
  if (structure.p_delta) vectors.add(request.loads_at_rest);
  if (!request.start.empty()) {
    vectors.add("start");
    add_values(request.start.displacement, vectors);
    add_values(request.start.velocity, vectors);
    vectors.add(request.start_displacement, request.start_velocity);
  }
  if (request.attachment && request.patches > 0) {
    vectors.add("patches", request.patches);
  }
  for (const Region& region : structure.regions) {
    if (region.damping_factor == 1) continue;
    vectors.add(region.group, region.damping_factor);
  }
  if (!request.supports.empty()) vectors.add(hash_of(request.supports, mesh));
  if (!request.yielding_points.empty()) vectors.add(hash_of(request.yielding_points));
  std::vector<TracePoint> places = request.other_points;
  places.insert(places.end(), request.shown_points.begin(), request.shown_points.end());
  return {{"mesh", hash_of(mesh)},
          {"elements", hash_of(structure.regions) +
                           (structure.numbers == Numbers::in_single ? " in 32 bits" : "")},
          {"water", hash_of(mesh.water)},
          {"matrices", hash_of_matrices(structure.matrices)},
          {"clamp", clamp.text()},
          {"rigid groups", hash_of(mesh.rigid)},
          {"number of vectors", vectors.text()},
          {"contact points", hash_of(request.contact_points)},
          {"probe points", hash_of(places)}};
}

}  // namespace pounding
