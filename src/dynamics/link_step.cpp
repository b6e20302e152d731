#include "dynamics/link_step.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "links/law_of.h"

namespace pounding {
namespace {

constexpr int most_sweeps = 1000;
constexpr double converged = 1e-15;  ///< change of a tension over the largest

}  // namespace

LinkStep::LinkStep(const LinearSystem& system, const StructureState& state, StructureStep& step,
                   double time_step)
    : state_(state),
      step_(step),
      time_step_(time_step),
      links_(system.links->links()),
      trace_(system.links->trace()),
      held_(trace_.dofs().size()),
      before_(links_.size(), 0.0),
      now_(links_.size(), 0.0),
      after_(links_.size(), 0.0),
      free_after_(links_.size(), 0.0),
      force_(links_.size(), 0.0),
      field_(trace_.known().size(), 0.0),
      velocity_(trace_.dofs().size(), 0.0) {
  for (const Link& link : links_) {
    laws_.push_back(law_of(link.origin, time_step));
    memory_.emplace_back(laws_.back()->memory_size(), 0.0);
  }
  find_couplings();
}

void LinkStep::respond(const Link& link) {
  std::fill(field_.begin(), field_.end(), 0.0);
  for (std::size_t i = 0; i < link.place.size(); ++i) {
    if (link.place[i] >= 0) field_[link.place[i]] += link.weight[i];
  }
  std::fill(velocity_.begin(), velocity_.end(), 0.0);
  trace_.add_impulse(field_.data(), velocity_.data());
  std::vector<double> all(state_.velocity.size(), 0.0);
  for (std::size_t k = 0; k < velocity_.size(); ++k) all[trace_.dofs()[k]] = velocity_[k];
  measure(all, free_after_);
}

void LinkStep::find_couplings() {
  const double square = time_step_ * time_step_;
  std::vector<std::vector<std::size_t>> at_place(field_.size());
  for (std::size_t b = 0; b < links_.size(); ++b) {
    for (const int place : links_[b].place) {
      if (place >= 0) at_place[place].push_back(b);
    }
  }
  for (std::size_t b = 0; b < links_.size(); ++b) {
    std::vector<Coupling>& coupled = coupled_.emplace_back();
    std::map<std::size_t, double> response;  // [1/kg]
    if (std::ranges::any_of(links_[b].place,
                            [&](int k) { return k >= 0 && trace_.moves_others(k); })) {
      respond(links_[b]);
      for (std::size_t other = 0; other < links_.size(); ++other) {
        response[other] = free_after_[other];
      }
    } else {
      for (std::size_t i = 0; i < links_[b].place.size(); ++i) {
        const int place = links_[b].place[i];
        if (place < 0) continue;
        const double moved = trace_.compliance(place, place) * links_[b].weight[i];
        for (const std::size_t other : at_place[place]) {
          const auto& places = links_[other].place;
          const auto there = std::ranges::find(places, place) - places.begin();
          response[other] += links_[other].weight[there] * moved;
        }
      }
    }
    coupled.push_back({b, square * std::max(0.0, response[b])});
    for (const auto& [other, moved] : response) {
      if (other != b && moved != 0) coupled.push_back({other, square * moved});
    }
  }
}

void LinkStep::measure(const std::vector<double>& owned, std::vector<double>& elongations) {
  trace_.apply(owned.data(), field_.data(), 1);
  for (std::size_t b = 0; b < links_.size(); ++b) elongations[b] = links_[b].elongation(field_);
}

void LinkStep::begin() {
  step_.remember(trace_.dofs(), held_);
  measure(state_.displacement, now_);
  for (std::size_t b = 0; b < links_.size(); ++b) now_[b] = laws_[b]->is_relative() ? 0 : now_[b];
  measure_step(-time_step_, before_);
}

void LinkStep::measure_step(double duration, std::vector<double>& elongations) {
  measure(state_.velocity, elongations);
  for (std::size_t b = 0; b < links_.size(); ++b) {
    elongations[b] = now_[b] + duration * elongations[b];
  }
}

double LinkStep::sweep(double share) {
  double change = 0;
  for (std::size_t b = 0; b < links_.size(); ++b) {
    double free_after = free_after_[b];
    for (std::size_t k = 1; k < coupled_[b].size(); ++k) {
      free_after -= share * coupled_[b][k].compliance * force_[coupled_[b][k].link];
    }
    const double force = laws_[b]->solve(before_[b], now_[b], free_after,
                                         share * coupled_[b][0].compliance, memory_[b]);
    change = std::max(change, std::abs(force - force_[b]));
    force_[b] = force;
  }
  return change;
}

void LinkStep::pull(bool first) {
  std::fill(force_.begin(), force_.end(), 0.0);
  bool idle = true;
  for (std::size_t b = 0; b < links_.size(); ++b) {
    idle = idle && laws_[b]->is_idle(now_[b], memory_[b]);
  }
  if (idle) return;
  measure_step(time_step_, free_after_);
  const double share = first ? 0.5 : 1;
  for (int i = 0; i < most_sweeps; ++i) {
    const double change = sweep(share);
    if (change <= converged * largest_force()) break;
  }
  std::fill(field_.begin(), field_.end(), 0.0);
  for (std::size_t b = 0; b < links_.size(); ++b) {
    for (std::size_t i = 0; i < links_[b].place.size(); ++i) {
      if (links_[b].place[i] >= 0) {
        field_[links_[b].place[i]] -= links_[b].weight[i] * share * time_step_ * force_[b];
      }
    }
  }
  trace_.restrict_to_dofs(state_.velocity.data(), velocity_.data());
  trace_.add_impulse(field_.data(), velocity_.data());
  step_.correct(trace_.dofs(), held_, velocity_);
}

double LinkStep::largest_force() const {
  double largest = 0;
  for (const double force : force_) largest = std::max(largest, std::abs(force));
  return largest;
}

void LinkStep::finish(StepSums& sums) {
  measure_step(time_step_, after_);
  for (std::size_t b = 0; b < links_.size(); ++b) {
    const double held = laws_[b]->energy(before_[b], now_[b], memory_[b]);
    sums.link_energy_before += held;
    laws_[b]->remember(before_[b], now_[b], after_[b], memory_[b]);
    sums.link_loss += force_[b] * (after_[b] - before_[b]) / 2 -
                      (laws_[b]->energy(now_[b], after_[b], memory_[b]) - held);
  }
}

namespace {

std::string memory_name(int structure, const Link& link) {
  return "link " + std::to_string(structure) + " " + std::to_string(link.number);
}

}  // namespace

void LinkStep::save(int structure, SavedState& saved) const {
  for (std::size_t b = 0; b < links_.size(); ++b) {
    if (!memory_[b].empty()) saved.put(memory_name(structure, links_[b]), memory_[b]);
  }
}

void LinkStep::load(int structure, const SavedState& saved) {
  for (std::size_t b = 0; b < links_.size(); ++b) {
    if (!memory_[b].empty()) saved.get(memory_name(structure, links_[b]), memory_[b]);
  }
}

}  // namespace pounding
