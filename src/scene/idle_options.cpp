#include "scene/idle_options.h"

#include <algorithm>
#include <set>

#include "scene/option_values.h"

namespace pounding {
namespace {

using Names = OptionReader::Names;

/// Collects options without effect.
class IdleOptions {
 public:
  IdleOptions(const OptionReader& options, const Scene& scene) : options_(options), scene_(scene) {
    for (const auto& [name, value] : options.in_force()) in_force_.insert(name);
  }

  void look_at_run() {
    const bool shaken = std::ranges::any_of(
        scene_.motion, [](const auto& component) { return component.has_value(); });
    const bool moved = shaken || !scene_.supports.empty();
    needs("loops_at", !scene_.loops.empty(), "loops");
    for (const char* option : {"fields_start", "fields_end", "fields_format"}) {
      needs(option, scene_.fields_interval > 0, "fields_interval");
    }
    for (const char* option : {"gap_interval", "gap_tolerance", "impact_merge_time", "force_window",
                               "struck_areas", "struck_edges"}) {
      needs(option, !scene_.contacts.empty(), "contacts");
    }
    needs("preload_solver", scene_.preload || !scene_.supports.empty(), "preload");
    needs("allow_unstable", scene_.time_step > 0, "time_step");
    const bool switched_off = std::ranges::any_of(direction_names, [&](const char* axis) {
      return options_.given("motion_<x|y|z>_record", {axis});
    });
    for (const char* option : {"motion_level", "resampling"}) {
      look(option, {}, moved || switched_off, "there is no motion (-motion_x_record, ...)");
    }
    for (const char* option : {"spectra_damping", "spectra_frequencies", "peak_frequency"}) {
      needs(option, moved || !scene_.probes.empty(), "probes");
    }
    look("write_modes", {}, scene_.modes > 0, "-modes is 0");
    look("courant", {}, scene_.time_step == 0, "-time_step is the step");
    const bool all_own = std::ranges::all_of(scene_.structures, [&](const Structure& structure) {
      return options_.given("<structure>_gravity", {structure.name});
    });
    look("gravity", {}, !all_own, "every structure has a gravity of its own");
  }

  void look_at(const Structure& structure) {
    const Names names{structure.name};
    const auto is_given = [&](const char* damping) {
      return options_.changed(std::string("<structure>_") + damping, names);
    };
    const bool damped = !structure.matrices.empty() || is_given("damping_alpha") ||
                        is_given("damping_beta") || is_given("damping_ratio") ||
                        is_given("damping_uniform") || is_given("modal_damping");
    look("<structure>_damping_factor", names, damped,
         "the structure has no damping of its own, which it would multiply");
    for (const Region& region : structure.regions) {
      if (region.element != ElementType::soil) look_at(structure, region);
    }
  }

  void look_at(const Structure& structure, const Region& region) {
    const Names names{structure.name, region.group};
    const bool rates = std::ranges::any_of(region.dashpot, [](double rate) { return rate > 0; });
    for (const char* option : {"dashpot_exponent", "dashpot_stiffness", "series_stiffness"}) {
      look(std::string("<structure>_<group>_") + option, names, rates,
           "it goes with -" + option_name("<structure>_<group>_dashpot", names) +
               ", which is not given or 0");
    }
    look("<structure>_<group>_hardening", names, region.nonlinear.yields(),
         "nothing yields; it goes with -" + option_name("<structure>_<group>_yield_force", names));
  }

  void look_at(const Support& support) {
    const bool own =
        support.embedment ||
        std::ranges::any_of(support.motion, [](const auto& motion) { return motion.has_value(); });
    const bool moves = own || support.delay > 0 || support.factor != Vector3{1, 1, 1};
    const Names names{support.name};
    if (moves || options_.given("<support>_delay", names) ||
        options_.given("<support>_factor", names) || options_.given("<support>_embedment", names)) {
      return;
    }
    add("<support>_groups", names,
        "the support moves as all the ground does: it has no delay, factor, embedment or motion of "
        "its own");
  }

  /// Options of listed names that no reader has taken.
  void look_at_unread(const ListedNames& listed) {
    const auto look_at_names = [&](OptionBlock block, const std::vector<Names>& owners) {
      for (const OptionRow& row : option_table()) {
        if (row.block != block) continue;
        for (const Names& names : owners) {
          const std::string name = option_name(row.pattern, names);
          if (in_force_.contains(name)) continue;
          look(row.pattern, names, false, "nothing here asks for it");
        }
      }
    };
    const auto alone = [](const std::vector<std::string>& list) {
      std::vector<Names> owners;
      for (const std::string& name : list) owners.push_back({name});
      return owners;
    };
    std::vector<Names> regions;
    for (const Structure& structure : scene_.structures) {
      for (const Region& region : structure.regions) {
        if (region.element != ElementType::soil) regions.push_back({structure.name, region.group});
      }
    }
    look_at_names(OptionBlock::run, {Names{}});
    look_at_names(OptionBlock::spectra, {Names{}});
    look_at_names(OptionBlock::region, regions);
    for (const auto& [block, names] : listed) look_at_names(block, alone(names));
  }

  std::vector<std::string> lines() const { return lines_; }

 private:
  std::string value(std::string_view pattern, const Names& names) const {
    return trimmed(options_.database().at(option_name(pattern, names)));
  }

  void add(std::string_view pattern, const Names& names, const std::string& why) {
    const std::string shown =
        options_.given(pattern, names) ? " " + shown_value(value(pattern, names)) : std::string();
    lines_.push_back("option -" + option_name(pattern, names) + shown + " has no effect: " + why);
  }

  void look(std::string_view pattern, const Names& names, bool has_effect, const std::string& why) {
    if (!has_effect && options_.changed(pattern, names)) add(pattern, names, why);
  }

  /// An option of the run that goes with another one. Given, that one was switched off on purpose.
  void needs(std::string_view option, bool has_effect, std::string_view other) {
    look(option, {}, has_effect || options_.given(other),
         "it goes with -" + std::string(other) + ", which is not given");
  }

  const OptionReader& options_;
  const Scene& scene_;
  std::set<std::string> in_force_;
  std::vector<std::string> lines_;
};

}  // namespace

std::vector<std::string> idle_options(const OptionReader& options, const Scene& scene,
                                      const ListedNames& listed) {
  IdleOptions idle(options, scene);
  idle.look_at_run();
  for (const Structure& structure : scene.structures) idle.look_at(structure);
  for (const Support& support : scene.supports) idle.look_at(support);
  idle.look_at_unread(listed);
  return idle.lines();
}

}  // namespace pounding
