#include <string>

#include "driver/subject_facts.h"

namespace pounding {
namespace {

std::string band_name(const FrequencyBand& band) {
  return sentence("{:.0f}-{:.0f}", {band.low, band.high});
}

/// rms per band, null in a band that has fewer than two frequencies.
Json band_values(const std::array<double, compared_bands.size()>& rms) {
  Json values = Json::object();
  for (std::size_t b = 0; b < compared_bands.size(); ++b) {
    values[band_name(compared_bands[b])] = rms[b] < 0 ? Json() : Json(rms[b]);
  }
  return values;
}

std::string told_bands(const std::array<double, compared_bands.size()>& rms) {
  std::string text;
  for (const double value : rms) {
    text += value < 0 ? "         -" : sentence("{:10.3g [%]}", {value});
  }
  return text;
}

}  // namespace

Facts climb_facts(const Scene& scene) {
  const FidelityClimb& climb = scene.fidelity;
  Facts facts;
  if (climb.target == 0) return facts;
  Json tried = Json::array();
  for (const TriedFidelity& one : climb.tried) {
    tried.push_back({{"modes", one.modes}, {"error", one.error}, {"wall_time", one.wall_time}});
  }
  facts.values = {
      {"target", climb.target}, {"modes", climb.modes}, {"tried", tried}, {"reason", climb.reason}};
  facts.say("fidelity target {target:.4g %}:");
  for (const TriedFidelity& one : climb.tried) {
    facts.say(" {} modes are {:.3g %} off ({:.0f} s),", {one.modes, one.error, one.wall_time});
  }
  facts.text += climb.modes > 0 ? sentence(" {} modes are tried\n", {climb.modes})
                                : " full order is taken, " + climb.reason + "\n";
  return facts;
}

Facts fidelity_facts(const Scene& scene, const RunStatistics& run) {
  Facts climb;
  if (scene.fidelity.target > 0) climb.values["fidelity_climb"] = climb_facts(scene).values;
  if (!run.fidelity) return climb;
  const FidelityEstimate& estimate = *run.fidelity;
  Json channels = Json::object();
  std::string lines;
  for (const ChannelDistance& channel : estimate.channels) {
    channels[channel.name] = {{"rms", band_values(channel.rms)},
                              {"largest", channel.largest},
                              {"largest_at", channel.at}};
    lines += sentence("  {:-24s}", {channel.name}) + told_bands(channel.rms) +
             sentence("  {:.3g [%]} at {:.4g} Hz\n", {channel.largest, channel.at});
  }
  Facts facts;
  facts.add(climb);
  facts.add("fidelity", {{"window", {estimate.start, estimate.end}},
                         {"window_reason", estimate.reason},
                         {"rms", band_values(estimate.rms)},
                         {"window_rms", band_values(estimate.window)},
                         {"spread_rms", band_values(estimate.spread)},
                         {"disturbance", estimate.disturbance},
                         {"channels", channels},
                         {"impulse", estimate.impulse},
                         {"full_impulse", estimate.full_impulse},
                         {"full_dofs", estimate.full_dofs},
                         {"full_time_step", estimate.time_step},
                         {"wall_time", estimate.wall_time},
                         {"full_run_time", estimate.full_run_time}});
  facts.say(
      "\nfloor spectra of the reduced structures beside full order ({fidelity/full_dofs} dofs), "
      "estimated by {fidelity/window:.4g} s at full order,\n"
      "  {fidelity/window_reason}, and by the motion changed by {fidelity/disturbance:.2g %}; rms "
      "of the logarithm of their ratio\n"
      "  in %, and the largest in the window\n");
  std::string head = sentence("  {:-24s}", {"Hz"});
  for (const FrequencyBand& band : compared_bands) head += sentence("{:10s}", {band_name(band)});
  const auto line = [](const char* name, const FidelityEstimate::Bands& rms) {
    return sentence("  {:-24s}", {name}) + told_bands(rms) + "\n";
  };
  facts.text += head + "\n" + lines + line("all that move", estimate.rms) +
                line("  of the window", estimate.window) +
                line("  of the disturbance", estimate.spread);
  facts.say(
      "  impulses in the window {fidelity/impulse:.5g} N s, at full order "
      "{fidelity/full_impulse:.5g}\n"
      "  the estimate took {fidelity/wall_time:.1f} s; the whole run at full order would take "
      "{fidelity/full_run_time:.0f} s\n");
  if (scene.fidelity.target > 0) {
    facts.say("  {} modes are {} the accepted {:.4g %}\n",
              {scene.fidelity.modes, estimate.rms[0] <= scene.fidelity.target ? "within" : "beyond",
               scene.fidelity.target});
  }
  return facts;
}

}  // namespace pounding
