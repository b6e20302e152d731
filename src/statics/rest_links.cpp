#include "statics/rest_links.h"

#include <cmath>
#include <utility>

namespace pounding {
namespace {

constexpr double on_its_line = 1e-13;  ///< round-off of a force

}  // namespace

RestLinks::RestLinks(const LinearSystem& system) {
  for (LinkTerms& link : link_terms(system)) {
    auto law = law_at_rest(*link.link);
    if (link.one_way || !law->loses_plastic_work() || slides(link.link->origin)) continue;
    terms_.push_back(std::move(link));
    laws_.push_back(std::move(law));
  }
}

bool RestLinks::add_forces(const std::vector<double>& displacement, std::span<double> force) const {
  bool any = false;
  for (std::size_t b = 0; b < terms_.size(); ++b) {
    const LinkTerms& link = terms_[b];
    const double elongation = link.elongation(displacement);
    std::vector<double> memory(laws_[b]->memory_size(), 0.0);
    laws_[b]->rest(elongation, memory);
    const double straight = link.stiffness * elongation;
    const double more = laws_[b]->force(elongation, elongation, elongation, memory) - straight;
    if (!(std::abs(more) > on_its_line * std::abs(straight))) continue;
    any = true;
    for (std::size_t k = 0; k < link.dofs.size(); ++k) {
      force[link.dofs[k]] += more * link.coefficients[k];
    }
  }
  return any;
}

}  // namespace pounding
