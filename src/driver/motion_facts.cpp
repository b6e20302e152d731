#include "driver/subject_facts.h"

namespace pounding {

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
