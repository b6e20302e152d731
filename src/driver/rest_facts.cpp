#include "driver/subject_facts.h"

namespace pounding {
namespace {

/// Load of one contact at rest.
struct ContactLoad {
  int points = 0;    ///< of its pairs
  int closed = 0;    ///< of them, those that carry
  double force = 0;  ///< [N]
};

std::vector<ContactLoad> contact_loads(const Scene& scene, const Model& model) {
  std::vector<ContactLoad> loads(scene.contacts.size());
  for (std::size_t row = 0; row < model.equilibrium->contact_force.size(); ++row) {
    const double force = model.equilibrium->contact_force[row];
    ContactLoad& load = loads[model.interface.constraints[row].contact];
    load.force += force;
    load.closed += force > 0 ? 1 : 0;
    ++load.points;
  }
  return loads;
}

Facts structure_rest_facts(const Scene& scene, const Model& model, std::size_t s) {
  const StructureRest& of = model.equilibrium->structures[s];
  Facts facts{{{"method", of.method},
               {"weight", of.weight},
               {"load", of.load},
               {"support", of.support},
               {"contact", of.contact},
               {"settlement", of.settlement},
               {"largest_displacement", of.largest_displacement},
               {"place", of.place},
               {"imbalance", of.imbalance}}};
  facts.say(
      "  structure {}, {method}\n"
      "    weight                 {weight:.6g} N\n"
      "[    loads                  {load:.6g} N\n]"
      "    supports push it by    {support:.6g} N\n",
      {model.systems[s].name});
  if (!scene.structures[s].clamps.empty()) {
    facts.say("      with the loads on held nodes, which recorded reactions are without\n");
  }
  if (!scene.contacts.empty()) facts.say("    contacts push it by    {contact:.6g} N\n");
  facts.say("    settles by             {settlement:.4g mm} in the mean");
  if (!of.place.empty()) facts.say(", at most {largest_displacement:.4g mm} at {place}");
  facts.say(model.systems[s].generalised
                ? "\n"
                : "\n    their sum is zero within {imbalance:.1e} of the largest\n");
  return facts;
}

}  // namespace

Facts rest_facts(const Scene& scene, const Model& model) {
  const Equilibrium& rest = *model.equilibrium;
  Facts facts{{{"iterations", rest.iterations},
               {"residual", rest.residual},
               {"rows_tried", rest.rows_tried},
               {"acting_links", rest.acting_links},
               {"idle_links", rest.idle_links},
               {"gravity_potential", rest.gravity_potential}}};
  facts.say(
      "\nstatic equilibrium: {iterations} iterations, {residual:.1e} of the weight left, "
      "{rows_tried} contact points and links tried\n");
  Facts structures;
  for (std::size_t s = 0; s < rest.structures.size(); ++s) {
    structures.add(scene.structures[s].name, structure_rest_facts(scene, model, s));
  }
  facts.add("structures", structures);
  Facts contacts;
  const std::vector<ContactLoad> loads = contact_loads(scene, model);
  for (std::size_t c = 0; c < loads.size(); ++c) {
    const std::string& name = scene.contacts[c].name;
    contacts.add(name, Json{{"points", loads[c].closed}, {"force", loads[c].force}});
    contacts.say("  contact {}: {} of {} points carry {:.6g} N\n",
                 {name, loads[c].closed, loads[c].points, loads[c].force});
  }
  facts.add("contacts", contacts);
  if (rest.acting_links + rest.idle_links > 0) {
    facts.say(
        "  tension-only bars and compression-only springs: {acting_links} act, {idle_links} do "
        "not\n");
  }
  return facts;
}

}  // namespace pounding
