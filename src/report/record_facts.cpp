#include <algorithm>
#include <cmath>

#include "report/report.h"

namespace pounding {

Facts loop_facts(const RunStatistics& run) {
  Facts facts;
  for (const LoopReport& loop : run.loops) {
    const interactions::LinkTotals most = loop.whole();
    Json yielded = Json::array();
    for (std::size_t i = 0; i < loop.links.size(); ++i) {
      if (loop.totals[i].yielded > 0) yielded.push_back(loop.links[i]);
    }
    facts.add("loops", loop.name,
              {{"links", loop.links.size()},
               {"yielded", yielded},
               {"largest_elongation", most.largest_elongation},
               {"largest_force", most.largest_force},
               {"energy_taken", most.work}},
              "  {:-12s} {:.0f} of {links} links yielded, elongation at most "
              "{largest_elongation:.4g mm} (or mrad), force {largest_force:.4g kN} (or kN m), took "
              "{energy_taken:.4g} J\n",
              {loop.name, most.yielded});
  }
  return facts;
}

namespace {

Json values_of_yielding(const YieldSum& sum) {
  return {{"elements", sum.elements},
          {"yielded", sum.yielded},
          {"ductility", sum.ductility},
          {"element", sum.element},
          {"place", sum.place},
          {"first_time", std::isfinite(sum.first_time) ? Json(sum.first_time) : Json()},
          {"energy_lost", sum.lost}};
}

/// A line of the table of yielding.
std::string told_yielding(const std::string& name, const Json& of) {
  return told("  {:-36s} {yielded:5d} of {elements:-5d} {ductility:10.4g} {element:9d}", of,
              {name}) +
         (of["first_time"].is_null() ? told(" {:12s}", nullptr, {"-"})
                                     : told(" {first_time:12.4f}", of)) +
         told(" {energy_lost:12.4g}  at {place:.4g} m\n", of);
}

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

Facts yield_facts(const RunStatistics& run) {
  Facts facts;
  if (run.yielding.empty()) return facts;
  double lost = 0;
  int yielded = 0;
  for (const YieldReport& report : run.yielding) {
    lost += report.whole.lost;
    yielded += report.whole.yielded;
  }
  if (yielded == 0) {
    facts.say("\nnothing yielded; of the elongations of first corners there were at most\n");
  } else {
    facts.say("\nyielding, which took {:.4g} J\n", {lost});
  }
  facts.say(
      "  law, storey                          yielded        ductility   element      first s "
      "      J lost\n");
  for (const YieldReport& report : run.yielding) {
    Json of = values_of_yielding(report.whole);
    facts.text += told_yielding(report.name, of);
    for (const auto& [storey, sum] : report.storeys) {
      of["storeys"][storey] = values_of_yielding(sum);
      facts.text += told_yielding("  " + storey, of["storeys"][storey]);
    }
    facts.values["yielding"][report.name] = std::move(of);
  }
  return facts;
}

Facts contact_ratio_facts(const Scene& scene, const RunStatistics& run) {
  Facts facts;
  for (std::size_t s = 0; s < run.contact_ratios.size(); ++s) {
    const ContactRatio& ratio = run.contact_ratios[s];
    const std::string& name = scene.structures[s].name;
    facts.add("contact_ratio", name,
              {{"end", ratio.now},
               {"smallest", ratio.smallest},
               {"time_of_smallest", ratio.time},
               {"time_below_80_percent", ratio.low_duration}},
              "  {:-12s} contact ratio of its compression-only springs {end:.3f} at the end, at "
              "least {smallest:.3f} at {time_of_smallest:.4g} s, below {:.0f %} for "
              "{time_below_80_percent:.4g} s\n",
              {name, ContactRatio::low});
  }
  return facts;
}

Facts force_facts(const RunStatistics& run) {
  Facts facts;
  if (run.forces.empty()) return facts;
  facts.say("\nforce       largest kN, kN m (of shells per m) of samples      at s   element\n");
  for (const ForceReport& force : run.forces) {
    Facts components;
    for (std::size_t c = 0; c < force.components.size(); ++c) {
      const std::size_t e = force.largest(c);
      const ForcePeak& peak = force.peaks[e * force.components.size() + c];
      Json& of =
          components.values[force.components[c]] = {{"peak", peak.value}, {"time", peak.time}};
      if (!force.elements[e].empty()) of["element"] = std::stoll(force.elements[e]);
      components.text += told("  {:-18s} {peak:24.6g [kN]} {time:19.5f}   [{element}]\n", of,
                              {force.name + "." + force.components[c]});
    }
    facts.values["forces"][force.name] = components.values;
    facts.text += components.text;
    if (!force.about) continue;
    facts.values["moments_about"][force.name] = *force.about;
    facts.say("    moments about {:.6g} m\n", {*force.about});
  }
  return facts;
}

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
    const Json& of = facts.values.emplace_back(Json{{"structure", storey.structure},
                                                    {"upper", storey.upper},
                                                    {"lower", storey.lower},
                                                    {"height", storey.height},
                                                    {"peak", {x.drift, y.drift}},
                                                    {"time", {x.time, y.time}}});
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
    facts.say("the motion enters from below as a wave; displacements are absolute\n");
  }
  if (motion.descriptions().empty()) facts.say("motion: none\n");
  return facts;
}

Facts support_facts(const SupportMotion& supports) {
  Facts facts{Json::array()};
  for (std::size_t c = 0; c < supports.columns().size(); ++c) {
    const SupportMotion::Reach reach = supports.reach(c);
    const bool turns = supports.columns()[c].component >= 3;
    const Json& of = facts.values.emplace_back(Json{{"component", supports.describe(c)},
                                                    {"source", supports.source(c)},
                                                    {"peak", reach.peak},
                                                    {"largest", reach.largest},
                                                    {"end", reach.end}});
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
    const double peak = model.load_histories->peak(l, scene.end_time);
    const Json& of =
        facts.values.emplace_back(Json{{"name", load.name},
                                       {"on", load.structure + ":" + load.group},
                                       {"nodes", on.nodes},
                                       {"extent", on.extent},
                                       {"force", on.force},
                                       {"moment", on.moment},
                                       {"function", model.load_histories->describe(l)},
                                       {"peak", peak},
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
