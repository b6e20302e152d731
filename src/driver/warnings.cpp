#include "driver/warnings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "stability/stable_time_step.h"

namespace pounding {

std::vector<std::string> sliver_warnings(const LinearSystem& system) {
  std::vector<std::string> warnings;
  for (const Sliver& sliver : system.slivers) {
    std::ostringstream text;
    text.precision(4);
    text << "structure " << system.name << ": sliver: " << sliver.element << " allows by itself "
         << sliver.time_step << " s, the median of its group " << sliver.median << " s ("
         << sliver.count << " such elements in it); mend the mesh";
    warnings.push_back(text.str());
  }
  return warnings;
}

std::vector<std::string> damping_warnings(const Structure& structure, const ModalResult& modal) {
  constexpr double doubtful_ratio = 0.5;
  constexpr double highest = 50;  // Hz
  std::vector<double> frequencies;
  for (const Mode& mode : modal.modes) {
    const bool vibrates = mode.location.empty();  // else its frequency is round-off
    if (vibrates && (frequencies.empty() || mode.frequency <= highest)) {
      frequencies.push_back(mode.frequency);
    }
  }
  if (frequencies.empty()) frequencies = {1, highest};
  std::vector<std::string> warnings;
  const auto look_at = [&](const std::string& owner, const Rayleigh& damping) {
    for (const double frequency : frequencies) {
      const double ratio = damping_ratio(damping, 2 * std::numbers::pi * frequency);
      if (!(ratio > doubtful_ratio) || !(frequency > 0)) continue;
      std::ostringstream text;
      text.precision(4);
      text << owner << ": alpha " << damping.alpha << " 1/s and beta " << damping.beta << " s damp "
           << 100 * ratio << " % of critical at " << frequency
           << " Hz; are they meant? -damping_ratio with two frequencies is surer";
      warnings.push_back(text.str());
      return;
    }
  };
  const bool by_mode = structure.modal && !structure.modal->damping_ratios.empty();
  const std::optional<UniformDamping>& uniform = structure.uniform_damping;
  constexpr double large_ripple = 0.2;
  if (uniform && uniform->ripple > large_ripple) {
    std::ostringstream text;
    text.precision(3);
    text << "structure " << structure.name << ": " << uniform->filters.size()
         << " filters hold the uniform damping within " << 100 * uniform->ripple
         << " % of its ratio only; give more -" << structure.name
         << "_damping_filters, or a narrower band";
    warnings.push_back(text.str());
  }
  for (const Mode& mode : uniform ? modal.modes : std::vector<Mode>()) {
    const double found = uniform->ratio_at(2 * std::numbers::pi * mode.frequency);
    const bool inside = mode.frequency >= uniform->lowest && mode.frequency <= uniform->highest;
    constexpr double doubtful_part = 0.8;
    if (mode.location.empty() && !inside && found < doubtful_part * uniform->ratio) {
      std::ostringstream text;
      text.precision(3);
      text << "structure " << structure.name << ": a mode of " << mode.frequency
           << " Hz lies outside of the band of its uniform damping and has " << 100 * found
           << " % of critical instead of " << 100 * uniform->ratio << " %; give a wider -"
           << structure.name << "_damping_band";
      warnings.push_back(text.str());
      break;
    }
  }
  if (!by_mode && !uniform) look_at("structure " + structure.name, structure.damping);
  for (const Region& region : structure.regions) {
    if (region.damping && !by_mode) {
      look_at("structure " + structure.name + ", group " + region.group, *region.damping);
    }
  }
  return warnings;
}

std::vector<std::string> shift_warnings(const LinearSystem& system, const ModalResult& modal) {
  constexpr double highest = 33;  // Hz
  constexpr double doubtful = 0.1;
  if (!system.uniform_damping) return {};
  double worst = doubtful;
  std::ostringstream text;
  for (const Mode& mode : modal.modes) {
    if (!mode.location.empty() || !(mode.frequency > 0) || mode.frequency > highest) continue;
    const double moved = system.uniform_damping->moved(mode.frequency);
    const double shift = moved / mode.frequency - 1;
    if (!(std::abs(shift) > worst)) continue;
    worst = std::abs(shift);
    text.str("");
    text.precision(3);
    text << "structure " << system.name << ": uniform damping of "
         << 100 * system.uniform_damping->ratio << " % moves its mode of " << mode.frequency
         << " Hz by " << 100 * shift << " % to " << moved << " Hz, since modes keep their place at "
         << system.uniform_damping->reference << " Hz; give -" << system.name
         << "_damping_reference where it matters most";
  }
  return text.str().empty() ? std::vector<std::string>() : std::vector{text.str()};
}

std::vector<std::string> mechanism_warnings(const Scene& scene, const Model& model) {
  std::vector<std::string> warnings;
  for (std::size_t s = 0; s < model.buildings.size(); ++s) {
    const std::vector<Mode>& modes = model.buildings[s].modal.modes;
    const auto count =
        std::ranges::count_if(modes, [](const Mode& mode) { return !mode.location.empty(); });
    const Connectivity& connectivity = model.buildings[s].findings.connectivity;
    if (count == 0 || !connectivity.wholly_held() || scene.structures[s].allow_loose) continue;
    const auto first =
        std::ranges::find_if(modes, [](const Mode& mode) { return !mode.location.empty(); });
    std::ostringstream text;
    text << "structure " << scene.structures[s].name << ": " << count
         << " of its lowest modes have no stiffness (0 Hz), the first moves most at "
         << first->location << "; look for hinges, missing elements and supports";
    warnings.push_back(text.str());
  }
  return warnings;
}

std::vector<std::string> displacement_warnings(double largest, double model_size) {
  constexpr double small = 0.05;                                      // of the model
  if (!(largest > small * model_size) || model_size == 0) return {};  // 0: a point
  std::ostringstream text;
  text.precision(3);
  text << "displacements reach " << largest << " m in a model of " << model_size
       << " m; the theory is one of small displacements";
  return {text.str()};
}

std::vector<std::string> contact_warnings(double residual) {
  constexpr double solved = 1e-8;
  if (!(residual > solved)) return {};
  std::ostringstream text;
  text.precision(3);
  text << "the contact problem of some step was not solved to the end: complementarity residual "
       << residual << " of the largest closing velocity (below " << solved
       << " is as good as exact); look at contacts that hold the same place twice, and at friction "
          "of bodies wedged between each other";
  return {text.str()};
}

std::vector<std::string> slide_warnings(const Scene& scene, const RunStatistics& statistics) {
  std::vector<std::string> warnings;
  for (std::size_t c = 0; c < statistics.slides.size(); ++c) {
    const Slide& slide = statistics.slides[c];
    if (slide.since < 0) continue;
    std::ostringstream text;
    text.precision(4);
    const std::string& name = scene.contacts[c].name;
    text << "contact " << name << ": its faces slid along each other by up to " << slide.distance
         << " m, more than ";
    if (scene.contacts[c].sliding > 0) {
      text << "-" << name << "_sliding " << scene.contacts[c].sliding
           << " m, from t = " << slide.since
           << " s on; what lies farther is not looked for: give more";
    } else {
      text
          << "half of the facet there (" << slide.facet_size << " m), from t = " << slide.since
          << " s on; nodes stay with the facets that they face at the start, so that impacts after "
             "that may hit what has moved away, or miss; -"
          << name << "_sliding finds pairs anew";
    }
    warnings.push_back(text.str());
  }
  return warnings;
}

std::vector<std::string> pendulum_warnings(const RunStatistics& statistics) {
  std::vector<std::string> warnings;
  for (const std::string& structure : statistics.overpressed) {
    warnings.push_back("structure " + structure +
                       ": more pressed on a friction pendulum than hardening times stiffness times "
                       "its radius, and its slope was cut there; give a larger hardening");
  }
  return warnings;
}

}  // namespace pounding
