#include <algorithm>

#include "common/facts_of.h"
#include "report/report.h"

namespace pounding {

namespace {

/// Peak of each spectrum of a probe in one direction.
std::string told_spectra(const std::vector<ProbeSpectrum>& spectra, const std::string& probe,
                         const std::string& direction) {
  std::string text;
  for (const ProbeSpectrum& spectrum : spectra) {
    if (spectrum.probe != probe || spectrum.direction != direction) continue;
    const auto peak =
        std::ranges::max_element(spectrum.points, {}, &SpectrumPoint::pseudo_acceleration);
    text += sentence(" {:14.2f} at {:.4g} ({:g %})",
                     {peak->pseudo_acceleration, peak->frequency, spectrum.damping_ratio});
  }
  return text;
}

}  // namespace

Facts drift_facts(const StoreyDrifts& drifts) {
  Facts facts{Json::array()};
  if (!drifts.storeys().empty()) {
    facts.say(
        "\nstorey                                 height m   drift x %      at s   drift y %      "
        "at s\n");
  }
  for (std::size_t s = 0; s < drifts.storeys().size(); ++s) {
    const Storey& storey = drifts.storeys()[s];
    const auto& [x, y] = drifts.peaks()[s];
    Json& of = facts.values.emplace_back(FACTS_OF(storey, structure, upper, lower, height));
    of.update({{"peak", {x.drift, y.drift}}, {"time", {x.time, y.time}}});
    facts.text += told(
        "  {:-36s} {height:8.3f} {peak/0:11.4f [%]} {time/0:9.4f} {peak/1:11.4f [%]} "
        "{time/1:9.4f}\n",
        of, {storey.upper + " over " + storey.lower});
  }
  return facts;
}

Facts probe_facts(const Scene& scene, const RunStatistics& run, const Recorder& recorder,
                  const std::vector<ProbeSpectrum>& spectra) {
  Facts facts{{{"peak_frequency", run.peaks.frequency}, {"probes", Json::object()}}};
  if (!recorder.channels().empty() && scene.spectra.start > 0) {
    facts.say("\npeaks and spectra from {} s on, the oscillators at rest then\n",
              {scene.spectra.start});
  }
  if (!recorder.channels().empty()) {
    facts.say(
        "\npeak accelerations below {peak_frequency:.4g} Hz, and as sampled every {:.4g} s, where "
        "an impulse counts by 1/interval"
        "\nprobe          peak acceleration m/s2   as sampled   peak displacement mm   spectrum "
        "peak m/s2 at Hz\n",
        {recorder.interval()});
  }
  for (std::size_t p = 0; p < recorder.probes().size(); ++p) {
    const ResolvedProbe& probe = recorder.probes()[p];
    Json& of =
        facts.values["probes"][probe.name] = {{"structure", scene.structures[probe.structure].name},
                                              {"position", probe.position},
                                              {"nodes", probe.nodes.size()}};
    for (std::size_t channel = 3 * p; channel < 3 * p + 3; ++channel) {
      const double stated = run.peaks.acceleration[channel];
      const auto& sampled = recorder.peaks()[channel];
      of["peak_acceleration"].push_back(stated);
      of["sampled_peak_acceleration"].push_back(sampled.acceleration);
      of["peak_displacement"].push_back(sampled.displacement);
      facts.say("  {:-18s} {:14.3f} {:15.3f} {:17.3f [mm]}{}\n",
                {recorder.channels()[channel], stated, sampled.acceleration, sampled.displacement,
                 told_spectra(spectra, probe.name, direction_names[channel % 3])});
    }
  }
  return facts;
}

Facts motion_facts(const GroundMotion& motion) {
  Facts facts{{{"x", nullptr}, {"y", nullptr}, {"z", nullptr}}, "\n"};
  for (const MotionDescription& d : motion.descriptions()) {
    Json& of = facts.values[d.direction];
    of = {{"file", d.source},
          {"format", d.layout},
          {"points", d.points},
          {"time_step", d.time_step},
          {"duration", d.duration},
          {"scaled", d.scaling},
          {"pga", d.pga},
          {"pga_in_g", d.pga / standard_gravity},
          {"treatment", d.treatment},
          {"end_velocity", d.end_velocity},
          {"end_displacement", d.end_displacement}};
    if (!d.component.empty()) of["component"] = d.component;
    if (d.start != 0 || d.file_start != 0) {
      of["sets_in_at"] = d.start;
      of["file_start"] = d.file_start;
    }
    if (d.factor != 0) of["factor"] = d.factor;
    if (!d.unit.empty()) {
      of["unit"] = d.unit;
      of["file_peak"] = d.file_peak;
      of["file_peak_in_g"] = d.file_peak / standard_gravity;
    }
    facts.text += told(
        "motion {}: {file}[, component {component}]\n"
        "  {format}[, in {unit}], {points} points every {time_step} s, {duration} s"
        "[, peak {file_peak:.4g} m/s2 ({file_peak_in_g:.4g} g)]"
        "[\n  sets in at {sets_in_at} s: its times begin at {file_start} s, t = 0 is {} s of them]"
        "\n  scaled: {scaled}; pga {pga:.4g} m/s2 ({pga_in_g:.4g} g)\n",
        of, {d.direction, motion.origin()});
  }
  if (motion.from_below()) {
    facts.text += sentence(
        "the motion enters from below as a wave[, which parts in {} shapes]; displacements are "
        "absolute\n",
        {motion.incident().size() - 3});
  }
  if (motion.descriptions().empty()) facts.say("motion: none\n");
  return facts;
}

Facts support_facts(const SupportMotion& supports) {
  Facts facts{Json::array()};
  for (std::size_t c = 0; c < supports.columns().size(); ++c) {
    const SupportMotion::Reach reach = supports.reach(c);
    const bool turns = supports.columns()[c].component >= 3;
    Json& of = facts.values.emplace_back(FACTS_OF(reach, peak, largest, end));
    of.update({{"component", supports.describe(c)}, {"source", supports.source(c)}});
    facts.text += told("{component}: {source}; against the ground at most {peak:.4g} ", of);
    facts.text +=
        told(turns ? "rad/s2 and {largest:.4g} rad\n" : "m/s2 and {largest:.4g mm}\n", of);
  }
  return facts;
}

Facts load_facts(const Scene& scene, const Model& model) {
  Facts facts{Json::array()};
  for (std::size_t l = 0; l < scene.loads.size(); ++l) {
    const Load& load = scene.loads[l];
    const NodalLoad& on = model.loads[l];
    Json& of = facts.values.emplace_back(FACTS_OF(on, nodes, extent, force, moment));
    of.update({{"name", load.name},
               {"on", load.structure + ":" + load.group},
               {"function", model.load_histories->describe(l)},
               {"peak", model.load_histories->peak(l, scene.end_time)},
               {"at_rest", model.load_histories->before_start(l)}});
    facts.text += told(
        "load {name}: on {nodes} nodes of {on}, force {force:.6g} N[, moment about the origin "
        "{moment:.6g} N m]\n"
        "  times {function}, at most {peak:.4g}[; {at_rest:.4g} before the run]\n",
        of);
  }
  return facts;
}

}  // namespace pounding
