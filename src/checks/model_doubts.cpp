#include "checks/model_doubts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "common/error.h"
#include "common/matrix3.h"
#include "mesh/mesh.h"

namespace pounding {
namespace {

constexpr double level_mat = 1;        ///< height over which nodes of a mat may lie [m]
constexpr double level_part = 0.1;     ///< or this part of its longer side
constexpr double long_spring = 5;      ///< between two nodes; a device is shorter [m]
constexpr double skew_spring = 0.5;    ///< likewise, of one that lies along no axis [m]
constexpr double wide_gap = 1;         ///< joints of buildings are narrower [m]
constexpr double wide_part = 0.05;     ///< and narrower than this part of the model
constexpr double narrow_floor = 0.15;  ///< extent in plan over that of the widest floor
constexpr double small_mass = 50;      ///< of a part of a building [kg]
constexpr double small_part = 1e-4;    ///< and over that of the building
constexpr double slow = 3;             ///< first frequency times longest side [m/s]
constexpr double light = 2;            ///< mass over the volume of the box around it [kg/m3]

void doubt_mat(const Structure& structure, const GlobalMesh& mesh, Doubts doubts) {
  if (!structure.soil) return;
  const BoundingBox box = bounding_box(mesh, mesh.groups.at(structure.soil->mat).nodes);
  const double height = box.high[2] - box.low[2];
  const double side = std::max(box.high[0] - box.low[0], box.high[1] - box.low[1]);
  if (!(height > std::max(level_mat, level_part * side))) return;
  doubts.add("structure " + structure.name,
             "the nodes of its mat on soil, group {}, lie from z = {} to {} m, and all of "
             "them move as one rigid body; -{}_soil_mat takes the group of the mat alone",
             {structure.soil->mat, box.low[2], box.high[2], structure.name});
}

/// A spring acts along the axes, and gives no moment for its length.
void doubt_springs(const Structure& structure, const GlobalMesh& mesh, Doubts doubts) {
  for (const ElementSet& set : mesh.regions) {
    if (traits_of(set.type).family != ElementFamily::spring) continue;
    if (structure.regions[static_cast<std::size_t>(set.region)].of_water) continue;
    constexpr double along = 0.999;  // cosine
    double longest = 0;
    bool doubted = false;
    for (std::size_t i = 0; i + 1 < set.connectivity.size(); i += 2) {
      const Vector3 line =
          minus(mesh.position(set.connectivity[i + 1]), mesh.position(set.connectivity[i]));
      const double length = norm(line);
      longest = std::max(longest, length);
      const bool skew =
          std::ranges::none_of(line, [&](double part) { return std::abs(part) >= along * length; });
      doubted = doubted || length > (skew ? skew_spring : long_spring);
    }
    if (!doubted) continue;
    doubts.add(
        "structure " + structure.name + ", group " + set.group,
        "a spring of {:.4g} m; it acts along the axes whatever its direction, and its length "
        "gives no moment; a bar acts along its line, is one meant?",
        {longest});
  }
}

/// The two faces of a contact, along their normal.
class JointDoubts {
 public:
  JointDoubts(const Scene& scene, std::span<const GlobalMesh> meshes, const Contact& contact,
              const interactions::InterfaceReport& report, double model_size)
      : scene_(scene),
        meshes_(meshes),
        contact_(contact),
        report_(report),
        model_size_(model_size) {}

  void doubt(Doubts doubts) const {
    const double smallest = report_.geometric_gap[0];
    if (!(smallest > 0) || is_of_beams(contact_.secondary) || is_of_beams(contact_.primary)) return;
    if (const std::string between = what_lies_between(); !between.empty()) {
      doubts.add("contact " + contact_.name,
                 "between its faces, up to {:.4g} m apart, lies {}: it goes through a building; "
                 "name the faces that look at each other across the joint",
                 {report_.geometric_gap[1], between});
    } else if (smallest > std::max(wide_gap, wide_part * model_size_) && stands_still()) {
      doubts.add("contact " + contact_.name,
                 "its faces are at least {:.4g} m apart in the meshes{}; are they the ones that "
                 "look at each other across the joint?",
                 {smallest, contact_.gap.is_of_meshes() ? ", which no building moves" : ""});
    }
  }

 private:
  const GlobalMesh& mesh_of(const ContactSide& side) const {
    return meshes_[structure_number(scene_, side.structure)];
  }
  const std::vector<GlobalIndex>& nodes_of(const ContactSide& side) const {
    return mesh_of(side).groups.at(side.group).nodes;
  }

  /// Lines of beams are a building around them, so that faces before them may be far.
  bool is_of_beams(const ContactSide& side) const {
    const std::vector<GlobalIndex>& nodes = nodes_of(side);
    const std::set<GlobalIndex> face(nodes.begin(), nodes.end());
    for (const ElementSet& set : mesh_of(side).regions) {
      const ElementTraits& traits = traits_of(set.type);
      if (!has_extent(set.type) || joins_two_nodes(set.type) || traits.stiffness == nullptr) {
        continue;
      }
      if (std::ranges::any_of(set.connectivity,
                              [&](GlobalIndex node) { return face.contains(node); })) {
        return false;
      }
    }
    return true;
  }

  /// Bodies in flight may come from far.
  bool stands_still() const {
    return std::ranges::none_of(scene_.structures, [](const Structure& structure) {
      return structure.starts_in_motion() || structure.allow_loose;
    });
  }

  /// A node in the space that the two faces look at each other across; empty: there is none.
  std::string what_lies_between() const {
    const Vector3& normal = report_.normal;
    double behind = -1e300;
    double ahead = 1e300;
    const GlobalMesh& mesh = mesh_of(contact_.secondary);
    const GlobalMesh& other_mesh = mesh_of(contact_.primary);
    const BoundingBox face = bounding_box(mesh, nodes_of(contact_.secondary));
    const BoundingBox other = bounding_box(other_mesh, nodes_of(contact_.primary));
    for (const GlobalIndex node : nodes_of(contact_.secondary)) {
      behind = std::max(behind, dot(normal, mesh.position(node)));
    }
    for (const GlobalIndex node : nodes_of(contact_.primary)) {
      ahead = std::min(ahead, dot(normal, other_mesh.position(node)));
    }
    const double margin =
        1e-3 * (ahead - behind) + std::max(report_.half_thickness[0], report_.half_thickness[1]);
    for (std::size_t s = 0; s < meshes_.size(); ++s) {
      for (GlobalIndex node = 0; node < meshes_[s].node_count(); ++node) {
        const Vector3 x = meshes_[s].position(node);
        const double along = dot(normal, x);
        bool inside = along > behind + margin && along < ahead - margin;
        for (const int t : report_.tangent_axes) {
          const auto axis = static_cast<std::size_t>(t);
          const double slack = 1e-6 * model_size_;
          inside = inside && x[axis] >= std::max(face.low[axis], other.low[axis]) - slack &&
                   x[axis] <= std::min(face.high[axis], other.high[axis]) + slack;
        }
        if (inside) return "structure " + scene_.structures[s].name + " at " + place_text(x);
      }
    }
    return "";
  }

  const Scene& scene_;
  std::span<const GlobalMesh> meshes_;
  const Contact& contact_;
  const interactions::InterfaceReport& report_;
  double model_size_;
};

/// Extent in plan of the nodes of a mesh at one height [m].
double extent_at(const GlobalMesh& mesh, double height, double tolerance) {
  BoundingBox box;
  for (GlobalIndex node = 0; node < mesh.node_count(); ++node) {
    const Vector3 x = mesh.position(node);
    if (std::abs(x[2] - height) <= tolerance) box.include(x);
  }
  return std::hypot(std::max(0.0, box.high[0] - box.low[0]),
                    std::max(0.0, box.high[1] - box.low[1]));
}

/// Floors reach about as far as the building; a cabinet on one of them does not.
void doubt_floors(const Scene& scene, std::span<const GlobalMesh> meshes,
                  std::span<const ResolvedProbe> probes, Doubts doubts) {
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const BoundingBox box = bounding_box({&meshes[s], 1});
    const double tolerance = 0.01 * (box.high[2] - box.low[2]);
    std::vector<std::pair<const ResolvedProbe*, double>> floors;
    double widest = 0;
    for (const ResolvedProbe& probe : probes) {
      const auto asked = std::ranges::find(scene.probes, probe.name, &Probe::name);
      if (probe.structure != static_cast<int>(s) || asked == scene.probes.end() || !asked->floor) {
        continue;
      }
      floors.emplace_back(&probe, extent_at(meshes[s], probe.position[2], tolerance));
      widest = std::max(widest, floors.back().second);
    }
    for (const auto& [probe, extent] : floors) {
      if (!(extent < narrow_floor * widest)) continue;
      doubts.add("probe " + probe->name,
                 "a floor at z = {:.4g} m, where {} reaches over {:.4g} m in plan, and over "
                 "{:.4g} m at its widest floor; drifts are between floors, not of what stands "
                 "on them: leave -{}_floor out there",
                 {probe->position[2], scene.structures[s].name, extent, widest, probe->name});
    }
  }
}

/// Places on a face that are smaller than the parts of its pairs, over which forces are even.
void doubt_struck_places(const Scene& scene, const interactions::Interface& interface,
                         Doubts doubts) {
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    double area = 0, length = 0;  // largest of a pair
    for (const interactions::Constraint& row : interface.constraints) {
      if (row.contact != static_cast<int>(c)) continue;
      const auto [s, t] = row.patch;
      area = std::max(area, (s[1] - s[0]) * (t[1] - t[0]));
      length = std::max(length, s[1] - s[0]);
    }
    const auto doubt = [&](const char* option, const std::vector<double>& sizes, double of_pair) {
      if (sizes.empty() || std::ranges::min(sizes) >= of_pair * (1 - 1e-6)) return;
      doubts.add("contact " + scene.contacts[c].name + ", " + option,
                 "one pair presses up to {:.3g} of its face, more than {:.3g}: within it the mesh "
                 "spreads the force evenly",
                 {of_pair, std::ranges::min(sizes)});
    };
    doubt("struck_areas in m2", scene.struck.areas, area);
    doubt("struck_edges in m", scene.struck.edges, length);
  }
}

}  // namespace

void add_place_doubts(const Scene& scene, std::span<const GlobalMesh> meshes,
                      const interactions::Interface& interface,
                      std::span<const ResolvedProbe> probes, Doubts doubts) {
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    doubt_mat(scene.structures[s], meshes[s], doubts);
    doubt_springs(scene.structures[s], meshes[s], doubts);
  }
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    if (scene.contacts[c].primary.is_wall() || scene.contacts[c].stop) continue;
    JointDoubts(scene, meshes, scene.contacts[c], interface.reports[c], interface.model_size)
        .doubt(doubts);
  }
  doubt_floors(scene, meshes, probes, doubts);
  doubt_struck_places(scene, interface, doubts);
}

void add_frequency_doubts(const Scene& scene, std::span<const ResolvedProbe> probes,
                          const Building& building, Doubts doubts) {
  const std::string& structure = building.structure->name;
  const MeshWaves& waves = building.findings.waves;
  const double asked = scene.spectra.frequencies.back();
  const auto beyond = [&](double end) {
    std::string of;
    for (const ResolvedProbe& probe : probes) {
      if (scene.structures[static_cast<std::size_t>(probe.structure)].name != structure) continue;
      if (of.empty() && end < asked) of = "the spectra of its probes go";
      for (const Equipment& item : scene.equipment) {
        if (item.probe == probe.name && end < std::min(item.band[1], asked)) {
          of = "the spectra of its probes and the band of " + item.name + " go";
        }
      }
    }
    return of;
  };
  const bool reduced = building.basis && scene.certificate.window == 0 &&
                       building.basis->modes < building.basis->independent_dofs;
  const double modes = reduced ? highest_mode(*building.basis) : asked;
  if (const std::string of = beyond(modes); !of.empty()) {
    doubts.add("structure " + structure,
               "its modes end at {:.4g} Hz, {} to {:.4g} Hz: above its modes it follows "
               "statically, and floor spectra there are no results; give more "
               "-{}_modal_vectors, or measure the error with -fidelity_window",
               {modes, of, asked, structure});
  }
  const double carried = waves.frequency > 0 ? waves.frequency : asked;
  if (const std::string of = beyond(carried); !of.empty()) {
    doubts.add("structure " + structure,
               "its mesh carries waves up to {:.3g} Hz, by elements of {:.3g} m of {}, {} to "
               "{:.4g} Hz: above, they are those of the mesh; a finer one shows by how much",
               {carried, waves.element_size, waves.group, of, asked});
  }
}

double highest_mode(const ModalBasis& basis) {
  double square = 0;
  for (std::size_t i = 0; i < basis.size(); ++i) {
    if (basis.mode_numbers[i] > 0) square = std::max(square, basis.squared_frequency[i]);
  }
  return std::sqrt(square) / (2 * std::numbers::pi);
}

void add_mass_doubts(MPI_Comm comm, const Building& building, Doubts doubts) {
  const Structure& structure = *building.structure;
  const double total = building.system->total_mass;
  for (const Region& region : structure.regions) {
    if (!(region.mass > 0 && region.mass < std::min(small_mass, small_part * total))) continue;
    doubts.add("structure " + structure.name + ", group " + region.group,
               "mass {:.4g} kg is nothing in a structure of {:.4g} kg; is it in t?",
               {region.mass, total});
  }
  if (structure.matrices.empty()) return;
  const Vector3 sides = bounding_box(comm, *building.mesh).sides();
  const double longest = std::ranges::max(sides);
  const double volume = sides[0] * sides[1] * sides[2];
  const double frequency = building.modal.first_frequency();
  if (frequency > 0 && frequency * longest < slow) {
    doubts.add("structure " + structure.name,
               "by the matrices of {} its first frequency is {:.4g} Hz, in a model of {:.4g} "
               "m; is the stiffness in N/m (not N/mm), and the mass in kg?",
               {structure.matrices, frequency, longest});
  }
  if (std::ranges::min(sides) > 0.1 * longest && total < light * volume) {
    doubts.add("structure " + structure.name,
               "by the matrices of {} its mass is {:.4g} kg, in a box of {:.4g} m3; is it in "
               "kg (not t)?",
               {structure.matrices, total, volume});
  }
}

}  // namespace pounding
