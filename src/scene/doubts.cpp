#include "scene/doubts.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "common/doubts.h"

namespace pounding {
namespace {

/// Plausible range of a quantity, and the meaning that its user may have had.
struct Plausible {
  const char* what;
  double low;
  double high;
  const char* unit;
  const char* hint;
};

/// Drilling factor of shells that yield above which it carries shear that they do not.
constexpr double most_beside_yielding = 0.1;

constexpr Plausible young{"young", 1e8, 1e12, "Pa", "is it in MPa or GPa?"};
constexpr Plausible density{"density", 100, 25000, "kg/m3", "is it in t/m3 or kN/m3?"};
constexpr Plausible poisson{"poisson", 0, 0.48, "-", "elements lock near 0.5"};
constexpr Plausible thickness{"thickness", 1e-3, 10, "m", "is it in mm?"};
constexpr Plausible bar_area{"area", 1e-6, 10, "m2", "is it in mm2 or cm2?"};
constexpr Plausible mass_per_area{"mass_per_area", 1, 1e5, "kg/m2", "is it in t/m2?"};
constexpr Plausible mass_per_length{"mass_per_length", 0.1, 1e6, "kg/m", "is it in t/m?"};
constexpr Plausible filler_pressure{"its largest pressure", 1e3, 1e9, "Pa", "is it in MPa or kPa?"};
constexpr Plausible crushing_strength{"its strength", 1e5, 1e9, "Pa", "is it in MPa or kPa?"};
constexpr Plausible contact_friction{"friction", 0, 1.5, "-",
                                     "it is a coefficient; is it in percent or degrees?"};
constexpr Plausible bearing_friction{"sliding_friction", 0, 1, "-",
                                     "it is a coefficient; is it in percent or degrees?"};
constexpr Plausible soil_velocity{"soil_vs", 20, 5000, "m/s", "is it in km/s?"};
constexpr Plausible soil_density{"soil_density", 500, 4000, "kg/m3", "is it in t/m3 or kN/m3?"};
constexpr Plausible soil_embedment{"soil_embedment", 0, 100, "m", "is it in mm?"};
constexpr Plausible pendulum_radius{"pendulum_radius", 0.3, 50, "m", "is it in mm?"};
constexpr Plausible delay{"delay", 0, 10, "s", "is it in ms?"};
constexpr Plausible likely_gravity{"gravity", 1.5, 30, "m/s2", "is it in g or cm/s2?"};
constexpr Plausible gyration{"radius of gyration", 1e-3, 20, "m",
                             "do area and inertias have one unit of length?"};

/// Looks at values; a material or section that several groups share is looked at once.
class SceneDoubts : public Doubts {
 public:
  using Doubts::Doubts;

  void look_at(const std::string& owner, const Plausible& range, double value) const {
    if (value >= range.low && value <= range.high) return;
    add(owner, "{} {} {} is outside {} to {} {}; {}",
        {range.what, value, range.unit, range.low, range.high, range.unit, range.hint});
  }

  void look_at(const Material& material) {
    const std::string owner = "material " + material.name;
    if (!seen_.insert(owner).second) return;
    look_at(owner, young, material.young);
    if (material.density > 0) {
      look_at(owner, density, material.density);
    } else {
      add(owner, "no density, its beams and bars weigh nothing but their mass_per_length");
    }
    look_at(owner, poisson, material.poisson);
  }

  void look_at(const Section& section) {
    const std::string owner = "section " + section.name;
    if (!seen_.insert(owner).second) return;
    look_at(owner + ", sqrt(inertia_y / area)", gyration,
            std::sqrt(section.inertia_y / section.area));
    look_at(owner + ", sqrt(inertia_z / area)", gyration,
            std::sqrt(section.inertia_z / section.area));
  }

 private:
  std::set<std::string> seen_;
};

void look_at_region(const std::string& structure, const Region& region, SceneDoubts& doubts) {
  const std::string owner = structure + ", group " + region.group;
  doubts.look_at(owner, bearing_friction, region.nonlinear.friction);
  if (region.nonlinear.radius > 0) {
    doubts.look_at(owner, pendulum_radius, region.nonlinear.radius);
  }
  const bool dashpot_alone = is_bar(region.element) && !(region.area > 0);
  if (!has_extent(region.element) || dashpot_alone) return;
  if (const std::string_view caution = traits_of(region.element).caution; !caution.empty()) {
    doubts.add(owner, "{}", {caution});
  }
  doubts.look_at(region.material);
  if (region.section) {
    doubts.look_at(*region.section);
  }
  if (is_shell(region.element)) {
    doubts.look_at(owner, thickness, region.thickness);
  }
  if (is_shell(region.element) && has_element_law(region) &&
      region.drilling_factor > most_beside_yielding) {
    doubts.add(owner,
               "it yields or cracks, and the stiffness against turning about its normal does not: "
               "it carries shear along edges that do not turn; give drilling_factor 0.01");
  }
  if (is_bar(region.element)) {
    doubts.look_at(owner, bar_area, region.area);
  }
  if (region.added_mass > 0) {
    doubts.look_at(owner, is_shell(region.element) ? mass_per_area : mass_per_length,
                   region.added_mass);
  }
}

void look_at_contact(const Contact& contact, SceneDoubts& doubts) {
  const std::string owner = "contact " + contact.name;
  doubts.look_at(owner, contact_friction, contact.friction);
  if (contact.crushes()) {
    doubts.look_at(owner + ", crushing", crushing_strength, contact.filler->table.back().pressure);
  } else if (contact.filler) {
    doubts.look_at(owner + ", filler", filler_pressure, contact.filler->table.back().pressure);
  }
}

void look_at_support(const Scene& scene, const Support& support, SceneDoubts& doubts) {
  const std::string owner = "support " + support.name;
  doubts.look_at(owner, delay, support.delay);
  if (support.delay > 0 && support.delay >= scene.end_time) {
    doubts.add(owner,
               "the motion arrives after {} s, the run ends at {} s: it is at rest all the time",
               {support.delay, scene.end_time});
  }
}

/// Strength and direction of gravity.
void look_at_direction(const Structure& structure, SceneDoubts& doubts) {
  const auto& [x, y, z] = structure.gravity;
  const double strength = std::hypot(x, y, z);
  if (strength == 0) return;
  doubts.look_at("structure " + structure.name, likely_gravity, strength);
  if (z > 0) {
    doubts.add("structure " + structure.name, "its gravity acts upwards, along z; -z is downwards");
  }
}

/// Gravity without a static start: a held structure that gets its weight at once swings about its
/// sag.
void look_at_gravity(const Structure& structure, SceneDoubts& doubts) {
  bool dropped = false;
  for (std::size_t d = 0; d < 3; ++d) {
    dropped = dropped || (structure.gravity[d] != 0 && is_held(structure, d));
  }
  if (!dropped) return;
  doubts.add("structure " + structure.name,
             "gravity acts at once at t = 0 on a structure that is held: a drop test, it swings "
             "about its sagging by as much again; give -preload static, leave gravity out, or let "
             "this die away before -spectra_start and the motion");
}

/// A region that holds by the pressure on it, where no weight does; dashpots in series with springs
/// whose structure starts displaced; springs that yield in modes.
void look_at_links(const Structure& structure, const Region& region, SceneDoubts& doubts) {
  const std::string owner = "structure " + structure.name + ", group " + region.group;
  const auto across = static_cast<std::size_t>(region.nonlinear.circle[2]);
  if (region.nonlinear.friction > 0 && structure.gravity[across] == 0) {
    doubts.add(owner,
               "slides, but no gravity acts along {}, across its plane: it holds only by the "
               "pressure of the motion; give -gravity and -preload static",
               {std::string(1, "xyz"[across])});
  }
  if (has_series(region) && structure.starts_displaced()) {
    doubts.add(owner,
               "its dashpots in series with springs start let go, as long after the displacement "
               "was given: these springs carry nothing of it");
  }
  if (structure.modal && structure.modal->damping_ratios.empty() && structure.damping.beta > 0 &&
      region.nonlinear.yields()) {
    doubts.add(owner,
               "yields in modes, whose stiffness damping (beta) acts on it as well: it moves less "
               "than at full order; give -{}_modal_damping or -{}_model full",
               {structure.name, structure.name});
  }
  if (region.compression_only && is_spring(region.element) && !(structure.gravity[2] < 0)) {
    doubts.add(owner,
               "pushes up only, but no gravity presses down on it: it lifts off at once and holds "
               "nothing; give -gravity and -preload static");
  }
}

}  // namespace

bool is_held(const Structure& structure, std::size_t direction) {
  const auto clamps = [&](const Clamp& clamp) { return (clamp.components >> direction & 1) != 0; };
  const auto carries = [&](const Region& region) {
    return is_grounded(region.element) && region.stiffness[direction] > 0;
  };
  return structure.soil || std::ranges::any_of(structure.clamps, clamps) ||
         std::ranges::any_of(structure.regions, carries);
}

std::vector<std::string> scene_doubts(const Scene& scene) {
  std::vector<std::string> lines;
  SceneDoubts doubts(lines);
  for (const Structure& structure : scene.structures) {
    for (const Region& region : structure.regions) {
      look_at_region("structure " + structure.name, region, doubts);
      look_at_links(structure, region, doubts);
    }
    if (structure.soil && structure.soil->table.empty()) {
      doubts.look_at("structure " + structure.name, soil_velocity,
                     structure.soil->ground.shear_velocity);
      doubts.look_at("structure " + structure.name, soil_density, structure.soil->ground.density);
      doubts.look_at("structure " + structure.name, soil_embedment, structure.soil->embedment);
    }
    look_at_direction(structure, doubts);
    if (!scene.preload) look_at_gravity(structure, doubts);
  }
  for (const Contact& contact : scene.contacts) look_at_contact(contact, doubts);
  for (const Support& support : scene.supports) look_at_support(scene, support, doubts);
  return lines;
}

}  // namespace pounding
