#include "statics/unilateral_rows.h"

#include <algorithm>
#include <cmath>

#include "common/parallel.h"
#include "laws/law_of.h"

namespace pounding {
namespace {

/// Law of a link, whether or not K holds its tangent already.
std::unique_ptr<interactions::LinkLaw> law_at_rest(const Link& link) {
  interactions::LinkOrigin origin = link.origin;
  origin.in_stiffness = false;
  constexpr double any_step = 1;  // s: nothing at rest depends on it
  return interactions::law_of(origin, any_step);
}

/// Whether a link yields by friction or on a circle, with others.
bool slides(const interactions::LinkOrigin& origin) {
  return origin.region != nullptr && is_spring(origin.region->element) &&
         (origin.region->nonlinear.friction > 0 ||
          origin.region->nonlinear.is_in_circle(static_cast<std::size_t>(origin.component)));
}

constexpr double on_its_line = 1e-13;  ///< round-off of a force

bool is_one_way_link(const Link& link) {
  return link.origin.region != nullptr && is_one_way(*link.origin.region) &&
         !link.origin.region->nonlinear.yields(static_cast<std::size_t>(link.origin.component));
}

}  // namespace

UnilateralRows::UnilateralRows(MPI_Comm comm, std::span<const interactions::Constraint> contacts,
                               std::span<const char> open, std::span<const LinearSystem> systems,
                               std::span<const Mesh> meshes)
    : comm_(comm),
      contacts_(static_cast<int>(contacts.size())),
      compliance_(contacts.size(), 0.0),
      open_(open.begin(), open.end()),
      rows_(comm, all_constraints(contacts, systems), systems, meshes) {}

std::vector<interactions::Constraint> UnilateralRows::all_constraints(
    std::span<const interactions::Constraint> contacts, std::span<const LinearSystem> systems) {
  std::vector<interactions::Constraint> constraints(contacts.begin(), contacts.end());
  for (std::size_t s = 0; s < systems.size(); ++s) add_links(s, systems[s], constraints);
  open_.resize(constraints.size(), 0);
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    initial_.push_back(std::max(0.0, constraints[i].initial_gap));
    if (initial_[i] == interactions::open_gap) open_[i] = 1;
  }
  return constraints;
}

void UnilateralRows::add_links(std::size_t structure, const LinearSystem& system,
                               std::vector<interactions::Constraint>& constraints) {
  if (!system.links) return;
  const std::size_t points = Link{}.point.size();
  std::vector<double> mine;  // per link c, slack, and of each point node, component, coefficient
  for (const LinkTerms& bar : link_terms(system)) {
    if (!bar.one_way) continue;
    mine.insert(mine.end(), {1 / bar.stiffness, bar.link->origin.region->nonlinear.slack});
    for (std::size_t i = 0; i < points; ++i) {
      const int number = bar.link->point[i];
      const TracePoint point = number < 0 ? TracePoint{} : system.links->points()[number];
      mine.insert(mine.end(),
                  {static_cast<double>(point.node), static_cast<double>(point.component),
                   number < 0 ? 0.0 : -bar.link->weight[i]});
    }
  }
  const std::vector<double> all = gather_rows(comm_, mine);
  for (auto value = all.begin(); value != all.end();) {
    compliance_.push_back(*value++);
    interactions::Constraint& constraint = constraints.emplace_back();
    constraint.initial_gap = *value++;
    for (std::size_t i = 0; i < points; ++i, value += 3) {
      if (value[2] == 0) continue;
      constraint.terms.push_back({static_cast<int>(structure), static_cast<GlobalIndex>(value[0]),
                                  static_cast<int>(value[1]), value[2]});
    }
  }
}

std::vector<double> UnilateralRows::responses(std::span<const std::vector<double>> displacement) {
  std::vector<double> changes(compliance_.size(), 0.0);
  if (rows_.members() == 0) return changes;
  if (rows_.member()) {
    std::vector<double> gathered(rows_.dofs());
    for (std::size_t s = 0; s < displacement.size(); ++s) {
      rows_.set(s, 0, 1, displacement[s].data(), {});
    }
    rows_.gather(1, gathered);
    for (int i = 0; i < size(); ++i) changes[i] = rows_.rows().apply(i, gathered);
  }
  MPI_Bcast(changes.data(), size(), MPI_DOUBLE, rows_.root(), comm_);
  return changes;
}

std::vector<double> UnilateralRows::openings(std::span<const std::vector<double>> displacement) {
  std::vector<double> openings = responses(displacement);
  for (std::size_t i = 0; i < openings.size(); ++i) openings[i] += initial_[i];
  return openings;
}

void UnilateralRows::add_force(int row, double f, std::span<std::vector<double>> forces) const {
  for (std::size_t s = 0; s < forces.size(); ++s) rows_.add_force(row, f, s, forces[s]);
}

std::vector<LinkTerms> link_terms(const LinearSystem& system, bool all) {
  std::vector<LinkTerms> bars;
  if (!system.links) return bars;
  std::vector<double> field(system.lumped_mass.size(), 0.0);
  const Trace& trace = system.links->trace();
  for (const Link& link : system.links->links()) {
    const double stiffness = law_at_rest(link)->tangent();
    if (!all && !(stiffness > 0)) continue;
    LinkTerms& bar = bars.emplace_back(LinkTerms{&link, stiffness, is_one_way_link(link)});
    for (std::size_t i = 0; i < link.point.size(); ++i) {
      if (link.point[i] >= 0) {
        trace.add_force(static_cast<std::size_t>(link.point[i]), link.weight[i], field);
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

RestLinks::RestLinks(const LinearSystem& system) : terms_(link_terms(system, true)) {
  for (const LinkTerms& link : terms_) laws_.push_back(law_at_rest(*link.link));
  if (system.links) groups_.emplace(system.links->links());
}

RestLinks::Rest RestLinks::rest_at(const std::vector<double>& displacement) const {
  Rest rest{{}, interactions::LawMemory(laws_)};
  for (const LinkTerms& link : terms_) rest.now.push_back(link.elongation(displacement));
  if (groups_) groups_->yield(laws_, rest.now, rest.memory);
  return rest;
}

bool RestLinks::add_forces(const std::vector<double>& displacement, std::span<double> force) const {
  bool any = false;
  const Rest rest = rest_at(displacement);
  for (std::size_t b = 0; b < terms_.size(); ++b) {
    const LinkTerms& link = terms_[b];
    if (link.one_way || !(link.stiffness > 0) || !slides(link.link->origin)) continue;
    const double now = rest.now[b];
    const double straight = link.stiffness * now;
    const double more = laws_[b]->force(now, now, now, rest.memory[b]) - straight;
    if (!(std::abs(more) > on_its_line * std::abs(straight))) continue;
    any = true;
    for (std::size_t k = 0; k < link.dofs.size(); ++k) {
      force[link.dofs[k]] += more * link.coefficients[k];
    }
  }
  return any;
}

std::optional<RestLinks::Slid> RestLinks::slid(const std::vector<double>& displacement) const {
  Rest rest = rest_at(displacement);
  for (std::size_t b = 0; b < terms_.size(); ++b) {
    if (!slides(terms_[b].link->origin)) continue;
    const double now = rest.now[b];
    const double force = laws_[b]->force(now, now, now, rest.memory[b]);
    laws_[b]->remember(now, now, now, 1, rest.memory[b]);
    if (laws_[b]->has_yielded(rest.memory[b])) return Slid{terms_[b].link, std::abs(force)};
  }
  return std::nullopt;
}

}  // namespace pounding
