#include "interactions/links_in_modes.h"

#include <algorithm>
#include <numeric>

#include "common/parallel.h"
#include "laws/dashpot_law.h"
#include "system/links.h"

namespace pounding::interactions {
namespace {

std::vector<std::unique_ptr<LinkLaw>> laws_of_all(const AllLinks& links, double time_step) {
  std::vector<std::unique_ptr<LinkLaw>> laws;
  for (const LinkOrigin& origin : links.origins) laws.push_back(law_of(origin, time_step));
  return laws;
}

}  // namespace

LinksInModes::LinksInModes(const LinearSystem& system, const LinearSystem& modes,
                           const AllLinks& links, double time_step)
    : system_(system),
      modes_(modes),
      rows_(links.rows),
      time_step_(time_step),
      laws_(laws_of_all(links, time_step)),
      memory_(laws_),
      offset_(laws_.size(), 0.0) {
  for (std::size_t b = 0; b < laws_.size(); ++b) {
    strengths_.push_back(2 * time_step * laws_[b]->rate());
    const bool dashpot = dynamic_cast<const DashpotLaw*>(laws_[b].get()) != nullptr;
    if (!dashpot) mindful_.push_back(b);
  }
  rate_.resize(mindful_.size());
  if (empty()) return;
  brake_.emplace(DashpotModes(modes, {links.rows, strengths_}, time_step));
  auto own = static_cast<std::int64_t>(system.links ? system.links->links().size() : 0);
  std::int64_t before = 0;
  MPI_Exscan(&own, &before, 1, MPI_INT64_T, MPI_SUM, system.comm);
  first_ = rank_of(system.comm) == 0 ? 0 : static_cast<std::size_t>(before);
}

void LinksInModes::gather() {
  const std::vector<double> own(own_memory_.begin(), own_memory_.end());
  std::ranges::copy(gather_rows(system_.comm, own), memory_.values().begin());
}

void LinksInModes::give_back() const {
  auto place = own_memory_.begin();
  for (std::size_t b = first_; place != own_memory_.end(); ++b) {
    place = std::ranges::copy(memory_[b], place).out;
  }
}

double LinksInModes::rate(std::size_t link, std::span<const double> velocity) const {
  const double* const row = &rows_[link * velocity.size()];
  return std::inner_product(velocity.begin(), velocity.end(), row, 0.0);
}

double LinksInModes::held(std::size_t link, double rate) const {
  return laws_[link]->energy(-time_step_ * rate, 0, memory_[link]);
}

void LinksInModes::push(std::span<const double> before, std::span<double> velocity) {
  energy_ = 0;
  for (std::size_t k = 0; k < mindful_.size(); ++k) {
    const std::size_t b = mindful_[k];
    rate_[k] = rate(b, before);
    energy_ += held(b, rate_[k]);
    offset_[b] = laws_[b]->offset(-time_step_ * rate_[k], 0, 1, memory_[b]);
    const double* const row = &rows_[b * velocity.size()];
    for (std::size_t i = 0; i < velocity.size(); ++i) {
      velocity[i] -= time_step_ * modes_.inverse_mass[i] * offset_[b] * row[i];
    }
  }
  brake_->brake(1, before, velocity);
  loss_ = brake_->loss(before, velocity);
  for (std::size_t k = 0; k < mindful_.size(); ++k) {
    const std::size_t b = mindful_[k];
    const double after = rate(b, velocity);
    loss_ += offset_[b] * time_step_ * (rate_[k] + after) / 2 + held(b, rate_[k]);
    laws_[b]->remember(-time_step_ * rate_[k], 0, time_step_ * after, 1, memory_[b]);
    loss_ -= laws_[b]->energy(0, time_step_ * after, memory_[b]);
  }
}

double LinksInModes::force(std::size_t link) const {
  const std::size_t b = first_ + link;
  return strengths_[b] / 2 * rate(b, brake_->sums()) + offset_[b];
}

double LinksInModes::energy_in_modes(std::span<const double> velocity) const {
  double energy = 0;
  for (const std::size_t b : mindful_) energy += held(b, rate(b, velocity));
  return energy;
}

double LinksInModes::energy_of_own(std::span<const double> velocity) const {
  double energy = 0;
  for (std::size_t own = 0; system_.links && own < system_.links->links().size(); ++own) {
    const Link& link = system_.links->links()[own];
    double rate = 0;
    for (std::size_t i = 0; i < link.point.size(); ++i) {
      if (link.point[i] < 0) continue;
      const LocalIndex dof = system_.links->dofs()[static_cast<std::size_t>(link.point[i])];
      rate += link.weight[i] * velocity[static_cast<std::size_t>(dof)];
    }
    energy += held(first_ + own, rate);
  }
  return energy;
}

}  // namespace pounding::interactions
