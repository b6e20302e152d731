#include "scene/scene_reader.h"

#include <algorithm>
#include <cctype>
#include <numbers>
#include <set>

#include "common/error.h"
#include "scene/contact_reader.h"
#include "scene/doubts.h"
#include "scene/equipment_reader.h"
#include "scene/held_nodes_reader.h"
#include "scene/idle_options.h"
#include "scene/load_reader.h"
#include "scene/modal_reader.h"
#include "scene/motion_reader.h"
#include "scene/option_blocks.h"
#include "scene/option_reader.h"
#include "scene/option_values.h"
#include "scene/pool_reader.h"
#include "scene/resolved_options.h"
#include "scene/standard_parts.h"
#include "scene/stiffness_factor.h"
#include "scene/structure_reader.h"
#include "scene/support_reader.h"
#include "scene/unknown_options.h"

namespace pounding {
namespace {

using Names = OptionReader::Names;

/// Reads a scene block by block, in the order of the table.
class SceneReader {
 public:
  explicit SceneReader(const OptionsDatabase& database) : options_(database) {}

  ReadScene read() {
    for (const OptionOwner& owner : option_owners()) {
      if (!owner.list.empty()) listed_[owner.block] = read_names(owner.list);
    }
    require_apart(listed_.at(OptionBlock::structure));
    refuse_unknown_options(options_.database(), listed_);
    mention_structures_left_out();
    read_run();
    read_structures();
    for (const std::string& name : listed_.at(OptionBlock::contact)) {
      scene_.contacts.push_back(read_contact(options_, scene_, name));
    }
    for (std::size_t d = 0; d < 3; ++d) {
      scene_.motion[d] = read_motion(options_, direction_names[d]);
      if (!scene_.motion[d]) continue;
      (scene_.motion[d]->pga > 0 ? scene_.motion[d]->pga : scene_.motion[d]->scale) *= level_;
    }
    check_absorbing(options_, scene_);
    for (const std::string& name : listed_.at(OptionBlock::support)) {
      scene_.supports.push_back(read_support(options_, name));
    }
    check_supports(options_, scene_);
    for (const Support& support : scene_.supports) refuse_beside_water(support);
    for (const std::string& name : listed_.at(OptionBlock::load)) {
      scene_.loads.push_back(read_load(options_, scene_, name));
      group_points(scene_, name + "_on", scene_.loads.back().structure, scene_.loads.back().group);
    }
    for (const Structure& structure : scene_.structures) require_forces_at_rest(structure);
    for (const std::string& name : listed_.at(OptionBlock::probe)) {
      scene_.probes.push_back(read_probe(name));
    }
    for (const std::string& name : listed_.at(OptionBlock::span)) {
      scene_.spans.push_back({name, "", ""});
      options_.read(scene_.spans.back(), {name});
    }
    read_loops();
    for (const std::string& name : listed_.at(OptionBlock::force)) {
      scene_.forces.push_back(read_force(options_, scene_, name));
    }
    check_switched(options_, scene_, !ensemble_.empty());
    read_spectra();
    for (const std::string& name : listed_.at(OptionBlock::equipment)) {
      scene_.equipment.push_back(read_equipment(options_, scene_, name));
    }
    for (const auto& doubts : {idle_options(options_, scene_, listed_), scene_doubts(scene_)}) {
      scene_.warnings.insert(scene_.warnings.end(), doubts.begin(), doubts.end());
    }
    scene_.mesh_options = mesh_options(options_.in_force(), scene_);
    check_pieces();
    return {scene_, resolved_values(options_), stiffness_factors_, ensemble_};
  }

 private:
  void read_structures() {
    const std::vector<Pool> pools = read_pools(options_, listed_.at(OptionBlock::pool));
    for (const std::string& name : listed_.at(OptionBlock::structure)) {
      scene_.structures.push_back(read_structure(options_, name));
      take_pools(options_, pools, scene_.structures.back());
      stiffness_factors_.push_back(read_stiffness_factor(options_, scene_.structures.back()));
      if (!options_.given("<structure>_gravity", {name})) {
        scene_.structures.back().gravity = {0, 0, -gravity_};
      }
      require_one_start(scene_.structures.back());
      require_own_basis(scene_.structures.back());
      require_full_order(scene_.structures.back());
    }
    for (const Pool& pool : pools) {
      named_structure(options_, scene_, "<pool>_structure", {pool.name}, pool.structure);
    }
  }

  /// Gravity is a magnitude: its direction is given for single structures only.
  double read_gravity() {
    if (options_.given("gravity")) {
      const auto number = parse_real(options_.database().at("gravity"));
      options_.refuse_if(number && *number < 0, "gravity", {},
                         "it acts along -z, and this is how strong it is: leave the sign out "
                         "(other directions: -<structure>_gravity x,y,z)");
    }
    return options_.real("gravity");
  }

  void read_run() {
    options_.read(scene_);
    if (options_.given("fidelity_target")) {
      scene_.fidelity.target = options_.real("fidelity_target");
    }
    options_.refuse_if(
        scene_.certificate.mesh && scene_.certificate.window == 0 && scene_.fidelity.target == 0,
        "fidelity_mesh", {}, "goes with -fidelity_window, which is not given");
    gravity_ = read_gravity();
    options_.read(scene_.struck);
    for (auto* list : {&scene_.law_cycles, &scene_.struck.areas, &scene_.struck.edges}) {
      std::erase(*list, 0.0);
    }
    ensemble_ = options_.path("ensemble");
    level_ = options_.real("motion_level");
  }

  /// A list of the user's names, none of them used before. Two that differ in upper and lower case
  /// only would be taken for each other.
  std::vector<std::string> read_names(std::string_view pattern) {
    std::vector<std::string> list = options_.list(pattern);
    for (const std::string& name : list) {
      if (const auto fault = name_fault(name)) options_.refuse(pattern, {}, *fault);
      std::string lower = name;
      std::ranges::transform(lower, lower.begin(),
                             [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      options_.refuse_if(!used_names_.insert(lower).second, pattern, {},
                         "'" + name + "' names something else already (upper or lower case alike)");
    }
    return list;
  }

  /// Meshes are cut into a folder, for structures at full order.
  void check_pieces() const {
    options_.refuse_if(scene_.write_mesh_pieces > 0 && scene_.mesh_pieces.empty(),
                       "write_mesh_pieces", {}, "give the folder for them (-mesh_pieces)");
    options_.refuse_if(scene_.write_mesh_pieces > 0 && scene_.dry_run, "write_mesh_pieces", {},
                       "it writes; not with -dry_run");
    if (!scene_.mesh_pieces.empty() &&
        std::ranges::any_of(scene_.structures,
                            [](const Structure& s) { return s.basis() != nullptr; })) {
      options_.refuse("mesh_pieces", {},
                      "a structure is reduced, and its basis needs the whole mesh");
    }
  }

  /// A run starts from the equilibrium or from a given place.
  void require_one_start(const Structure& structure) const {
    if (!scene_.preload) return;
    const std::string why = "the run starts from the static equilibrium; not with -preload static";
    options_.refuse_if(structure.initial_displacement != Vector3{0, 0, 0},
                       "<structure>_initial_displacement", {structure.name}, why);
    for (const Region& region : structure.regions) {
      options_.forbid("<structure>_<group>_initial_displacement", {structure.name, region.group},
                      why);
    }
  }

  /// P-Delta is about the axial forces of weight and loads at rest.
  void require_forces_at_rest(const Structure& structure) const {
    if (!structure.p_delta) return;
    const bool loaded = std::ranges::any_of(scene_.loads, [&](const Load& load) {
      return load.structure == structure.name &&
             (load.function.kind == LoadFunction::Kind::constant ||
              load.function.kind == LoadFunction::Kind::table);
    });
    options_.refuse_if(!scene_.preload || (structure.gravity == Vector3{0, 0, 0} && !loaded),
                       "<structure>_p_delta", {structure.name},
                       "it is about the axial forces at rest: give -preload static, and -gravity "
                       "or loads that act before the run");
  }

  /// Matrices and shapes are written of structures at full order only.
  void require_full_order(const Structure& structure) const {
    const std::string why =
        "structure " + structure.name + " is reduced; not with -" + structure.name + "_model modal";
    if (structure.modal && scene_.write_modes) options_.refuse("write_modes", {}, why);
    options_.refuse_if(structure.modal && !scene_.export_matrices.empty(), "export_matrices", {},
                       why);
    options_.refuse_if(structure.mass_scaling > 0 && !scene_.export_matrices.empty(),
                       "export_matrices", {},
                       "structure " + structure.name + " has scaled mass, which is not diagonal");
    for (const Pool& pool : structure.pools) {
      options_.refuse_if(!pool.is_tank() && !scene_.export_matrices.empty(), "export_matrices", {},
                         "not with -" + pool.name + "_water, whose mass is not diagonal");
    }
  }

  /// Water with cells follows the ground as one.
  void refuse_beside_water(const Support& support) const {
    for (const SupportedGroup& group : support.groups) {
      for (const Pool& pool : named_structure(options_, scene_, "", {}, group.structure).pools) {
        options_.refuse_if(!pool.is_tank(), "<pool>_water", {pool.name},
                           "not with -supports " + support.name + ", which moves structure " +
                               group.structure + " apart from its ground");
      }
    }
  }

  /// A name forgotten in the list of structures looks like a scene that takes some of another's.
  void mention_structures_left_out() {
    for (const std::string& name : complete_names(options_.database(), OptionBlock::structure)) {
      if (std::ranges::count(listed_.at(OptionBlock::structure), name) == 0) {
        scene_.warnings.push_back("structure " + name +
                                  " is defined and left out: it is not in -structures");
      }
    }
  }

  /// tower_slab_element belongs to the group slab of tower: no structure may be tower_slab.
  void require_apart(const std::vector<std::string>& structures) const {
    for (const std::string& longer : structures) {
      for (const std::string& shorter : structures) {
        options_.refuse_if(longer.starts_with(shorter + "_"), "structures", {},
                           "'" + longer + "' begins with '" + shorter +
                               "_', so that their options cannot be told apart");
      }
    }
  }

  /// A file holds the basis of one structure.
  void require_own_basis(const Structure& structure) const {
    for (const Structure& other : scene_.structures) {
      options_.refuse_if(structure.basis() != nullptr && !structure.basis()->basis_file.empty() &&
                             other.basis() != nullptr && other.name != structure.name &&
                             other.basis()->basis_file == structure.basis()->basis_file,
                         "<structure>_modal_basis", {structure.name},
                         "that is the file of structure " + other.name);
    }
  }

  Probe read_probe(const std::string& name) {
    Probe probe;
    probe.name = name;
    options_.read(probe, {name});
    named_structure(options_, scene_, "<probe>_structure", {name}, probe.structure);
    const bool at = !probe.points.empty();
    refuse_if(at == !probe.group.empty(), "probe " + name + ": give " + (at ? "only " : "") +
                                              "one of -" + name + "_at and -" + name + "_group");
    options_.refuse_if(probe.floor && !probe.average, "<probe>_floor", {name},
                       "a floor is one record; not with -" + name + "_average false");
    return probe;
  }

  void read_loops() {
    std::vector<Vector3> points;
    if (options_.given("loops_at")) points = options_.points("loops_at");
    for (const std::string& item : options_.list("loops")) {
      const std::vector<std::string> words = split(item, ':');
      if (words.size() == 2 && !words[0].empty() && !words[1].empty()) {
        named_structure(options_, scene_, "loops", {}, words[0]);
        scene_.loops.push_back({item, words[0], words[1], "", points});
        continue;
      }
      const auto contact = std::ranges::find(scene_.contacts, item, &Contact::name);
      options_.refuse_if(contact == scene_.contacts.end(), "loops", {},
                         "'" + item + "' is neither structure:group nor a contact");
      options_.refuse_if(
          !contact->filler && !contact->is_elastic(), "loops", {},
          "contact " + item + " has no filler, nothing to crush, and is no stop with a stiffness");
      scene_.loops.push_back({item, "", "", item, points});
    }
  }

  /// The frequency up to which beams are to be right.
  void resolve_frequency(double highest) {
    for (Structure& structure : scene_.structures) {
      for (Region& region : structure.regions) {
        if (is_beam(region.element)) region.resolved_frequency = 2 * std::numbers::pi * highest;
      }
    }
  }

  void read_spectra() {
    options_.read(scene_.spectra);
    const auto frequencies = parse_increasing(options_.text("spectra_frequencies"));
    options_.refuse_if(
        !frequencies || !option_row("spectra_frequencies").range.contains(frequencies->front()),
        "spectra_frequencies", {});
    options_.refuse_if(!are_of_oscillators(*frequencies), "spectra_frequencies", {},
                       "not between 1e-6 and 1e6 Hz");
    scene_.spectra.frequencies = *frequencies;
    resolve_frequency(frequencies->back());
    if (scene_.spectra.peak_frequency == 0) scene_.spectra.peak_frequency = frequencies->back();
    const double last_start =
        scene_.end_time - 2 * std::max(scene_.output_interval, scene_.time_step);
    options_.refuse_if(scene_.spectra.start > 0 && !(scene_.spectra.start <= last_start),
                       "spectra_start", {}, "the run ends before two samples are left");
  }

  OptionReader options_;
  Scene scene_;
  ListedNames listed_;
  double gravity_ = 0;  ///< of structures without their own [m/s2]
  std::string ensemble_;
  std::vector<double> stiffness_factors_;
  double level_ = 1;  ///< of the motion along all axes [-]
  std::set<std::string> used_names_;
};

}  // namespace

ReadScene read_scene(const OptionsDatabase& database) {
  return SceneReader(with_standard_parts(database)).read();
}

}  // namespace pounding
