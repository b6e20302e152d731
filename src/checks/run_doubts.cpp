#include "checks/run_doubts.h"

#include <algorithm>
#include <cmath>

#include "common/facts.h"
#include "motion/signal_treatment.h"

namespace pounding {
namespace {

void doubt_slides(const Scene& scene, const RunStatistics& statistics, Doubts doubts) {
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
    doubts.add("contact " + name, "its faces slid along each other by up to {:.4g} m, more than {}",
               {slide.distance, limit});
  }
}

void doubt_closings(const Scene& scene, const RunStatistics& statistics, Doubts doubts) {
  const std::string scaled = scaled_by_closing(scene);
  const bool closes = std::ranges::any_of(
      statistics.closings, [](const JointClosing& joint) { return std::isfinite(joint.factor); });
  if (scaled == "motion" || statistics.all_impacts.episodes > 0 || !closes) return;
  doubts.say(
      "closing factors are of {} together, since one run cannot part them: the "
      "motion alone closes a joint sooner where the others hold it open, later where "
      "they close it{}; -motion_level shows",
      {scaled, scene.preload ? "" : "; -preload static takes constant ones out"});
}

void doubt_pendulums(const RunStatistics& statistics, Doubts doubts) {
  for (const std::string& structure : statistics.overpressed) {
    doubts.add("structure " + structure,
               "more pressed on a friction pendulum than hardening times stiffness times "
               "its radius, and its slope was cut there; give a larger hardening");
  }
}

void doubt_spills(const RunStatistics& statistics, Doubts doubts) {
  const Json& findings = statistics.findings.values;
  if (!findings.contains("pools")) return;
  for (const auto& [name, waves] : findings["pools"].items()) {
    if (waves["wave_height"] <= waves["freeboard"]) continue;
    doubts.add("pool " + name,
               "its waves rise to {:.3g} m, over the freeboard of {:.3g} m, at {:.4g} s: it "
               "spills, and linear waves no longer hold",
               {waves["wave_height"], waves["freeboard"], waves["time"]});
  }
}

void doubt_coarse_spectra(const Scene& scene, std::span<const TargetSpectrum> capacities,
                          Doubts doubts) {
  constexpr double widest = 1.1 * (1 + 1e-6);  // as Regulatory Guide 1.122 has it
  for (std::size_t i = 0; i < capacities.size(); ++i) {
    const Equipment& item = scene.equipment[i];
    std::array<double, 2> worst{1, 1};
    double before = 0;
    for (const double frequency : scene.spectra.frequencies) {
      if (frequency < capacities[i].frequency.front() ||
          frequency > capacities[i].frequency.back() || frequency < item.band[0] ||
          frequency > item.band[1]) {
        continue;
      }
      if (before > 0 && frequency / before > worst[1] / worst[0]) worst = {before, frequency};
      before = frequency;
    }
    if (worst[1] / worst[0] <= widest) continue;
    doubts.add("equipment " + item.name,
               "its floor's spectrum has no frequency between {:.4g} and {:.4g} Hz "
               "(-spectra_frequencies), where a peak that turns its verdict is not seen; give "
               "them 10 % apart or closer",
               {worst[0], worst[1]});
  }
}

/// A sampled peak above so many times the stated one is that of an impulse within a sample.
constexpr double doubtful_ratio = 2;

/// How many times the largest sampled peak of a probe exceeds its largest stated one.
double excess(const StatedPeaks& peaks, const Recorder& recorder, std::size_t probe) {
  double sampled = 0;
  double stated = 0;
  for (std::size_t channel = 3 * probe; channel < 3 * probe + 3; ++channel) {
    sampled = std::max(sampled, recorder.peaks()[channel].acceleration);
    stated = std::max(stated, peaks.acceleration[channel]);
  }
  return stated > 0 ? sampled / stated : 1;
}

void doubt_sampled_peaks(const Scene& scene, const StatedPeaks& peaks, const Recorder& recorder,
                         Doubts doubts) {
  constexpr std::size_t named = 3;
  std::vector<std::string> names;
  double most = 1;
  bool reduced = false;
  for (std::size_t p = 0; p < recorder.probes().size(); ++p) {
    const double times = excess(peaks, recorder, p);
    if (!(times > doubtful_ratio)) continue;
    names.push_back(recorder.probes()[p].name);
    most = std::max(most, times);
    reduced = reduced || scene.structures[recorder.probes()[p].structure].modal.has_value();
  }
  if (names.empty()) return;
  std::string text = names.size() == 1 ? "probe " : "probes ";
  for (std::size_t i = 0; i < std::min(named, names.size()); ++i) {
    text += (i > 0 ? ", " : "") + names[i];
  }
  if (names.size() > named) text += sentence(" and {} more", {names.size() - named});
  doubts.add(text,
             "sampled accelerations reach {:.4g} times the peak below {:.4g} Hz; that sampled "
             "value goes with 1/output_interval where an impulse acts beside the probe{}, so take "
             "the other",
             {most, peaks.frequency, reduced ? " or its structure is reduced" : ""});
}

}  // namespace

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

void add_pass_doubts(const Scene& scene, std::span<const OtherPass> passes, Doubts doubts) {
  for (std::size_t c = 0; c < passes.size(); ++c) {
    const OtherPass& other = passes[c];
    if (!(other.depth > std::min(OtherPass::deep, OtherPass::deep_part * other.facet_size))) {
      continue;
    }
    const std::string& name = scene.contacts[c].name;
    doubts.add("contact " + name,
               "in one pass nodes of its primary went up to {:.3g mm} into facets of the "
               "secondary of {:.3g} m, at ({:.4g}, {:.4g}) m, t = {:.4g} s: impacts are "
               "missed or late there; give -{}_passes 2",
               {other.depth, other.facet_size, other.place[0], other.place[1], other.time, name});
  }
}

std::string scaled_by_closing(const Scene& scene) {
  const bool loads = std::ranges::any_of(scene.loads, [&](const Load& load) {
    return !scene.preload || load.function.kind != LoadFunction::Kind::constant;
  });
  const bool weight = std::ranges::any_of(scene.structures, [&](const Structure& structure) {
    return !scene.preload && structure.gravity != Vector3{};
  });
  return std::string("motion") + (loads ? " and loads" : "") + (weight ? " and weight" : "");
}

std::vector<std::string> lowered_peak_warnings(const Scene& scene, double interval,
                                               double time_step) {
  const double frequency = stated_frequency(scene, interval);
  const double needed = low_pass_limit / scene.spectra.peak_frequency;
  if (scene.probes.empty() || !(frequency < scene.spectra.peak_frequency * (1 - 1e-9))) return {};
  return {sentence(
      "peak accelerations are those below {:.4g} Hz, not {:.4g} Hz: samples every {:.4g} s hold no "
      "more; give {}-output_interval {:.4g} or less, or a lower -peak_frequency",
      {frequency, scene.spectra.peak_frequency, interval,
       time_step > needed ? "-time_step and " : "", needed})};
}

std::vector<std::string> run_doubts(const Scene& scene, const Model& model,
                                    const RunStatistics& run, const Recorder& recorder,
                                    std::span<const TargetSpectrum> capacities) {
  std::vector<std::string> lines =
      displacement_warnings(recorder.largest_displacement(), model.interface.model_size);
  const Doubts doubts(lines);
  doubts.add(contact_warnings(run.complementarity_residual));
  doubt_slides(scene, run, doubts);
  add_pass_doubts(scene, run.other_passes, doubts);
  doubt_coarse_spectra(scene, capacities, doubts);
  doubt_closings(scene, run, doubts);
  doubt_pendulums(run, doubts);
  doubt_spills(run, doubts);
  doubts.add(lowered_peak_warnings(scene, recorder.interval(), model.time_step));
  if (run.all_impacts.episodes > 0) doubt_sampled_peaks(scene, run.peaks, recorder, doubts);
  return lines;
}

}  // namespace pounding
