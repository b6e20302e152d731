#include "statics/link_terms.h"

#include "interactions/laws/law_of.h"

namespace pounding {
namespace {

bool is_one_way_link(const Link& link) {
  return !link.origin.section && link.origin.region != nullptr && is_one_way(*link.origin.region) &&
         !link.origin.region->nonlinear.yields(static_cast<std::size_t>(link.origin.component));
}

}  // namespace

std::unique_ptr<interactions::LinkLaw> law_at_rest(const Link& link) {
  interactions::LinkOrigin origin = link.origin;
  origin.in_stiffness = false;
  constexpr double any_step = 1;  // s: nothing at rest depends on it
  return interactions::law_of(origin, any_step);
}

bool slides(const interactions::LinkOrigin& origin) {
  if (origin.section || origin.region == nullptr || !is_spring(origin.region->element)) {
    return false;
  }
  const NonlinearSpring& law = origin.region->nonlinear;
  return law.friction > 0 || law.is_in_circle(static_cast<std::size_t>(origin.component));
}

std::vector<LinkTerms> link_terms(const LinearSystem& system) {
  std::vector<LinkTerms> bars;
  if (!system.links) return bars;
  std::vector<double> field(system.lumped_mass.size(), 0.0);
  const Trace& trace = system.links->trace();
  for (const Link& link : system.links->links()) {
    const double stiffness = law_at_rest(link)->tangent();
    if (!(stiffness > 0)) continue;
    LinkTerms& bar = bars.emplace_back(LinkTerms{&link, stiffness, is_one_way_link(link)});
    for (std::size_t i = 0; i < link.place.size(); ++i) {
      if (link.place[i] >= 0) {
        trace.add_force(static_cast<std::size_t>(link.place[i]), link.weight[i], field);
      }
    }
    for (const LocalIndex dof : trace.dofs()) {
      if (field[dof] == 0) continue;
      bar.dofs.push_back(dof);
      bar.coefficients.push_back(field[dof]);
      field[dof] = 0;
    }
  }
  return bars;
}

}  // namespace pounding
