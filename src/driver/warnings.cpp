#include "driver/warnings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "driver/facts.h"
#include "stability/stable_time_step.h"

namespace pounding {
namespace {

/// Rayleigh damping above half of the critical one at one of these frequencies [Hz].
void doubt_rayleigh(const std::string& owner, const Rayleigh& damping,
                    const std::vector<double>& frequencies, std::vector<std::string>& warnings) {
  constexpr double doubtful_share = 0.5;
  for (const double frequency : frequencies) {
    const double ratio = damping_ratio(damping, 2 * std::numbers::pi * frequency);
    if (!(ratio > doubtful_share) || !(frequency > 0)) continue;
    warnings.push_back(sentence(
        "{}: alpha {:.4g} 1/s and beta {:.4g} s damp {:.4g %} of critical at {:.4g} Hz; are they "
        "meant? -damping_ratio with two frequencies is surer",
        {owner, damping.alpha, damping.beta, ratio, frequency}));
    return;
  }
}

/// Uniform damping whose filters are too few, or whose band is too narrow for the modes.
void doubt_uniform(const Structure& structure, const std::vector<Mode>& modes,
                   std::vector<std::string>& warnings) {
  constexpr double large_ripple = 0.2;
  constexpr double doubtful_part = 0.8;
  const UniformDamping& uniform = *structure.uniform_damping;
  const std::string& name = structure.name;
  if (uniform.ripple > large_ripple) {
    warnings.push_back(sentence(
        "structure {}: {} filters hold the uniform damping within {:.3g %} of its ratio only; give "
        "more -{}_damping_filters, or a narrower band",
        {name, uniform.filters.size(), uniform.ripple, name}));
  }
  for (const Mode& mode : modes) {
    const double found = uniform.ratio_at(2 * std::numbers::pi * mode.frequency);
    const bool inside = mode.frequency >= uniform.lowest && mode.frequency <= uniform.highest;
    if (!mode.location.empty() || inside || found >= doubtful_part * uniform.ratio) continue;
    warnings.push_back(sentence(
        "structure {}: a mode of {:.3g} Hz lies outside of the band of its uniform damping and has "
        "{:.3g %} of critical instead of {:.3g %}; give a wider -{}_damping_band",
        {name, mode.frequency, found, uniform.ratio, name}));
    return;
  }
}

}  // namespace

std::vector<std::string> sliver_warnings(const LinearSystem& system) {
  std::vector<std::string> warnings;
  for (const Sliver& sliver : system.slivers) {
    warnings.push_back(sentence(
        "structure {}: sliver: {} allows by itself {:.4g} s, the median of its group {:.4g} s ({} "
        "such elements in it); mend the mesh",
        {system.name, sliver.element, sliver.time_step, sliver.median, sliver.count}));
  }
  return warnings;
}

std::vector<std::string> damping_warnings(const Structure& structure, const ModalResult& modal) {
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
  const bool by_mode = structure.modal && !structure.modal->damping_ratios.empty();
  const std::string owner = "structure " + structure.name;
  if (structure.uniform_damping) {
    doubt_uniform(structure, modal.modes, warnings);
  } else if (!by_mode) {
    doubt_rayleigh(owner, structure.damping, frequencies, warnings);
  }
  for (const Region& region : structure.regions) {
    if (!region.damping || by_mode) continue;
    doubt_rayleigh(owner + ", group " + region.group, *region.damping, frequencies, warnings);
  }
  return warnings;
}

std::vector<std::string> shift_warnings(const LinearSystem& system, const ModalResult& modal) {
  constexpr double highest = 33;  // Hz
  double worst = 0.1;
  if (!system.uniform_damping) return {};
  const UniformDamping& uniform = *system.uniform_damping;
  std::vector<std::string> warnings;
  for (const Mode& mode : modal.modes) {
    if (!mode.location.empty() || !(mode.frequency > 0) || mode.frequency > highest) continue;
    const double moved = uniform.moved(mode.frequency);
    const double shift = moved / mode.frequency - 1;
    if (!(std::abs(shift) > worst)) continue;
    worst = std::abs(shift);
    warnings = {sentence(
        "structure {}: uniform damping of {:.3g %} moves its mode of {:.3g} Hz by {:.3g %} to "
        "{:.3g} Hz, since modes keep their place at {:.3g} Hz; give -{}_damping_reference where it "
        "matters most",
        {system.name, uniform.ratio, mode.frequency, shift, moved, uniform.reference,
         system.name})};
  }
  return warnings;
}

std::vector<std::string> mechanism_warnings(const Scene& scene, const Model& model) {
  std::vector<std::string> warnings;
  const auto has_no_stiffness = [](const Mode& mode) { return !mode.location.empty(); };
  for (std::size_t s = 0; s < model.buildings.size(); ++s) {
    const std::vector<Mode>& modes = model.buildings[s].modal.modes;
    const auto count = std::ranges::count_if(modes, has_no_stiffness);
    const Connectivity& connectivity = model.buildings[s].findings.connectivity;
    if (count == 0 || !connectivity.wholly_held() || scene.structures[s].allow_loose) continue;
    warnings.push_back(sentence(
        "structure {}: {} of its lowest modes have no stiffness (0 Hz), the first moves most at "
        "{}; look for hinges, missing elements and supports",
        {scene.structures[s].name, count,
         std::ranges::find_if(modes, has_no_stiffness)->location}));
  }
  return warnings;
}

std::vector<std::string> displacement_warnings(double largest, double model_size) {
  constexpr double small = 0.05;                                      // of the model
  if (!(largest > small * model_size) || model_size == 0) return {};  // 0: a point
  return {
      sentence("displacements reach {:.3g} m in a model of {:.3g} m; the theory is one of small "
               "displacements",
               {largest, model_size})};
}

std::vector<std::string> contact_warnings(double residual) {
  constexpr double solved = 1e-8;
  if (!(residual > solved)) return {};
  return {sentence(
      "the contact problem of some step was not solved to the end: complementarity residual "
      "{:.3g} of the largest closing velocity (below {:.3g} is as good as exact); look at contacts "
      "that hold the same place twice, and at friction of bodies wedged between each other",
      {residual, solved})};
}

std::vector<std::string> slide_warnings(const Scene& scene, const RunStatistics& statistics) {
  std::vector<std::string> warnings;
  for (std::size_t c = 0; c < statistics.slides.size(); ++c) {
    const Slide& slide = statistics.slides[c];
    if (slide.since < 0) continue;
    const std::string& name = scene.contacts[c].name;
    const double sliding = scene.contacts[c].sliding;
    const std::string limit =
        sliding > 0
            ? sentence(
                  "-{}_sliding {:.4g} m, from t = {:.4g} s on; parts farther off are not "
                  "looked for: give more",
                  {name, sliding, slide.since})
            : sentence(
                  "half of the facet there ({:.4g} m), from t = {:.4g} s on; nodes stay with "
                  "the facets that they face at the start, so that impacts after that may "
                  "hit what has moved away, or miss; -{}_sliding finds pairs anew",
                  {slide.facet_size, slide.since, name});
    warnings.push_back(
        sentence("contact {}: its faces slid along each other by up to {:.4g} m, more than {}",
                 {name, slide.distance, limit}));
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
