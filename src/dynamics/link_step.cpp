#include "dynamics/link_step.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "common/dense_solver.h"
#include "common/disjoint_sets.h"
#include "common/row_products.h"
#include "interactions/laws/law_of.h"
#include "system/support_shapes.h"

namespace pounding {
namespace {

constexpr int most_sweeps = 1000;
constexpr double unstretched = 1e-9;  ///< elongation per unit of a support's motion, round-off
constexpr double converged = 1e-15;   ///< change of a tension over the largest

/// Links with a rate on one body from which on they are solved for by its motions, and how strong
/// they may be all together, dt^2 B^T M^-1 B rate, for that to keep ten digits.
constexpr std::size_t many = 2 * RigidBody::width;
constexpr double strongest = 1e6;

double product(const std::array<double, RigidBody::width>& a,
               const std::array<double, RigidBody::width>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

LinkStep::LinkStep(const LinearSystem& system, const StructureState& state, StructureStep& step,
                   const SupportStep& supports, double time_step)
    : state_(state),
      step_(step),
      supports_(supports),
      time_step_(time_step),
      links_(system.links->links()),
      trace_(system.links->trace()),
      held_(trace_.dofs().size()),
      before_(links_.size(), 0.0),
      now_(links_.size(), 0.0),
      after_(links_.size(), 0.0),
      free_after_(links_.size(), 0.0),
      force_(links_.size(), 0.0),
      push_(links_.size(), 0.0),
      field_(trace_.known().size(), 0.0),
      velocity_(trace_.dofs().size(), 0.0),
      rate_(links_.size(), 0.0) {
  step.watch(trace_.dofs(), true);
  for (const Link& link : links_) {
    laws_.push_back(interactions::law_of(link.origin, time_step));
    memory_.emplace_back(laws_.back()->memory_size(), 0.0);
  }
  if (system.supports) find_carried();
  if (are_dashpots(system)) {
    make_modes(system);
    return;
  }
  find_bodies(system);
  find_couplings();
  find_blocks();
  find_yielding();
}

void LinkStep::find_carried() {
  const std::size_t columns = supports_.acceleration.size();
  for (const Link& link : links_) {
    std::vector<double>& row = carried_.emplace_back(link.supports);
    row.resize(columns, 0.0);
    for (std::size_t i = 0; i < link.place.size(); ++i) {
      if (link.place[i] < 0) continue;
      const auto of_place = trace_.carried(static_cast<std::size_t>(link.place[i]));
      for (std::size_t c = 0; c < columns; ++c) row[c] += link.weight[i] * of_place[c];
    }
  }
  const auto is_stretched = [](const std::vector<double>& row) {
    return std::ranges::any_of(row, [](double part) { return std::abs(part) > unstretched; });
  };
  if (std::ranges::none_of(carried_, is_stretched)) carried_.clear();
}

void LinkStep::find_yielding() {
  std::map<std::int64_t, std::size_t> circles;  // by element
  std::map<std::int64_t, int> gauges;
  for (std::size_t b = 0; b < links_.size(); ++b) {
    const interactions::LinkOrigin& origin = links_[b].origin;
    if (origin.part == interactions::SpringPart::gauge) {
      gauges[links_[b].number] = static_cast<int>(b);
    }
    if (origin.part != interactions::SpringPart::stiffness || origin.region == nullptr ||
        !origin.region->nonlinear.yields(static_cast<std::size_t>(origin.component))) {
      continue;
    }
    const NonlinearSpring& spring = origin.region->nonlinear;
    std::size_t place = yielding_.size();
    if (spring.is_in_circle(static_cast<std::size_t>(origin.component))) {
      place = circles.try_emplace(links_[b].number, place).first->second;
    }
    if (place == yielding_.size()) yielding_.emplace_back();
    yielding_[place].links.push_back(b);
    yielding_[place].pressing = origin.region->stiffness[spring.circle[2]];
    // Hardening carries its part without friction; a pendulum's slope is apart from it.
    const double part = spring.radius > 0 ? 1 : 1 - spring.hardening;
    yielding_[place].friction = spring.friction * part * yielding_[place].pressing;
  }
  for (const auto& [number, place] : circles) {
    const auto gauge = gauges.find(number);
    if (gauge != gauges.end()) yielding_[place].gauge = gauge->second;
  }
}

void LinkStep::yield() {
  for (const Yielding& together : yielding_) {
    const double pressed = together.gauge < 0 ? 0 : std::max(0.0, -now_[together.gauge]);
    double square = 0;
    for (const std::size_t b : together.links) {
      square += std::pow(laws_[b]->trial(now_[b], memory_[b]), 2);
    }
    const double size = std::sqrt(square);
    const double capacity = together.gauge < 0 ? laws_[together.links.front()]->capacity()
                                               : together.friction * pressed;
    const double kept = size > capacity ? capacity / size : 1;
    for (const std::size_t b : together.links) {
      laws_[b]->yield(now_[b], kept, memory_[b]);
      laws_[b]->press(together.pressing * pressed, memory_[b]);
    }
  }
}

void LinkStep::find_bodies(const LinearSystem& system) {
  on_body_.resize(links_.size());
  if (!system.coupled_mass) return;
  std::map<LocalIndex, std::pair<int, std::span<const double, RigidBody::width>>> rows;
  int number = 0;
  for (const RigidBody& body : system.coupled_mass->bodies()) {
    for (std::size_t k = 0; k < body.dofs().size(); ++k) {
      rows.emplace(body.dofs()[k], std::pair(number, body.row(k)));
    }
    ++number;
  }
  pull_.assign(static_cast<std::size_t>(number), {});
  block_pull_ = pull_;
  for (std::size_t b = 0; b < links_.size(); ++b) {
    int body = -1;
    bool alone = true;  // it moves one body and nothing else
    Motion motion{};
    for (std::size_t i = 0; i < links_[b].place.size(); ++i) {
      if (links_[b].place[i] < 0) continue;
      const auto found = rows.find(trace_.dofs()[static_cast<std::size_t>(links_[b].place[i])]);
      alone = alone && found != rows.end() && (body < 0 || body == found->second.first);
      if (!alone) break;
      body = found->second.first;
      for (std::size_t m = 0; m < motion.size(); ++m) {
        motion[m] += links_[b].weight[i] * found->second.second[m];
      }
    }
    if (alone && body >= 0) on_body_[b] = {body, motion};
  }
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
  measure(all, {}, free_after_);
}

void LinkStep::find_couplings() {
  const double square = time_step_ * time_step_;
  std::vector<std::vector<std::size_t>> at_place(field_.size());
  for (std::size_t b = 0; b < links_.size(); ++b) {
    for (const int place : links_[b].place) {
      if (place >= 0) at_place[place].push_back(b);
    }
  }
  coupled_.resize(links_.size());
  for (std::size_t b = 0; b < links_.size(); ++b) {
    const Motion& motion = on_body_[b].motion;
    if (on_body_[b].body >= 0) coupled_[b].push_back({b, square * product(motion, motion)});
  }
  for (std::size_t b = 0; b < links_.size(); ++b) {
    if (on_body_[b].body >= 0) continue;
    std::vector<Coupling>& coupled = coupled_[b];
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
      if (other == b || moved == 0) continue;
      coupled.push_back({other, square * moved});
      if (on_body_[other].body >= 0) coupled_[other].push_back({b, square * moved});
    }
  }
}

void LinkStep::find_blocks() {
  const auto has_rate = [&](std::size_t link) { return laws_[link]->rate() > 0; };
  DisjointSets sets(links_.size());
  for (std::size_t b = 0; b < links_.size(); ++b) {
    if (!has_rate(b)) others_.push_back(b);
    for (const Coupling& coupling : coupled_[b]) {
      if (has_rate(b) && has_rate(coupling.link)) sets.join(b, coupling.link);
    }
  }
  std::map<int, std::size_t> first_on;  // link with a rate, by body
  for (std::size_t b = 0; b < links_.size(); ++b) {
    if (!has_rate(b) || on_body_[b].body < 0) continue;
    sets.join(first_on.try_emplace(on_body_[b].body, b).first->second, b);
  }
  std::map<std::size_t, std::size_t> block_of;  // by root
  std::vector<std::size_t> place(links_.size(), 0);
  for (std::size_t b = 0; b < links_.size(); ++b) {
    if (!has_rate(b)) continue;
    const auto [found, is_new] = block_of.try_emplace(sets.root(b), blocks_.size());
    if (is_new) blocks_.emplace_back();
    place[b] = blocks_[found->second].links.size();
    blocks_[found->second].links.push_back(b);
  }
  for (Block& block : blocks_) fill_block(block, place);
}

void LinkStep::fill_block(Block& block, const std::vector<std::size_t>& place) {
  const std::size_t count = block.links.size();
  block.free.assign(count, 0.0);
  block.force.assign(count, 0.0);
  block.body = on_body_[block.links.front()].body;
  double strength = 0;
  for (const std::size_t b : block.links) {
    const Motion& motion = on_body_[b].motion;
    strength += time_step_ * time_step_ * laws_[b]->rate() * product(motion, motion);
    if (on_body_[b].body != block.body) block.body = -1;
  }
  if (count < many || !(strength < strongest)) block.body = -1;
  if (block.body < 0) block.compliance.assign(count * count, 0.0);
  for (const std::size_t b : block.links) {
    std::vector<Coupling>& coupled = coupled_[b];
    const auto has_rate = [&](const Coupling& c) { return laws_[c.link]->rate() > 0; };
    for (const Coupling& coupling : coupled) {
      if (block.body < 0 && has_rate(coupling)) {
        block.compliance[place[b] * count + place[coupling.link]] = coupling.compliance;
      }
    }
    for (const std::size_t other : block.links) {
      if (block.body < 0 && on_body_[b].body >= 0 && on_body_[b].body == on_body_[other].body) {
        block.compliance[place[b] * count + place[other]] =
            time_step_ * time_step_ * product(on_body_[b].motion, on_body_[other].motion);
      }
    }
    coupled.erase(std::remove_if(coupled.begin() + 1, coupled.end(), has_rate), coupled.end());
  }
}

void LinkStep::form_inverses(double share) {
  share_ = share;
  for (Block& block : blocks_) {
    const std::size_t count = block.links.size();
    if (block.body >= 0) {
      constexpr std::size_t n = RigidBody::width;
      block.inverse.assign(n * n, 0.0);
      for (std::size_t i = 0; i < n; ++i) {
        block.inverse[i * n + i] = 1 / (share * time_step_ * time_step_);
        for (const std::size_t b : block.links) {
          const Motion& motion = on_body_[b].motion;
          for (std::size_t j = 0; j < n; ++j) {
            block.inverse[i * n + j] += motion[i] * laws_[b]->rate(share) * motion[j];
          }
        }
      }
      if (!invert_definite(block.inverse)) {
        throw std::logic_error("the compliance of dashpots on a rigid body is not positive");
      }
      continue;
    }
    block.inverse.resize(count * count);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        // Round-off of the response must not spoil the symmetry.
        block.inverse[i * count + j] =
            share * (block.compliance[i * count + j] + block.compliance[j * count + i]) / 2;
      }
      block.inverse[i * count + i] += 1 / laws_[block.links[i]]->rate(share);
    }
    if (!invert_definite(block.inverse)) {
      throw std::logic_error("the compliance of dashpots is not positive");
    }
  }
}

void LinkStep::measure(const std::vector<double>& owned, std::span<const double> supports,
                       std::vector<double>& elongations) {
  trace_.apply(owned.data(), field_.data(), 1);
  for (std::size_t b = 0; b < links_.size(); ++b) elongations[b] = links_[b].elongation(field_);
  for (std::size_t b = 0; b < carried_.size(); ++b) {
    add_columns(carried_[b], supports, &elongations[b], 1);
  }
}

void LinkStep::add_rates(double duration, std::vector<double>& elongations) const {
  for (std::size_t b = 0; b < links_.size(); ++b) elongations[b] = now_[b] + duration * rate_[b];
}

void LinkStep::begin(const Vector3& incident) {
  for (std::size_t b = 0; b < links_.size(); ++b) {
    const Vector3& along = links_[b].incident;
    push_[b] = along[0] * incident[0] + along[1] * incident[1] + along[2] * incident[2];
  }
  step_.remember(trace_.dofs(), held_);
  if (!others_.empty()) measure(state_.displacement, supports_.displacement, now_);
  if (!records_.empty()) measure(state_.displacement, supports_.displacement, recorded_);
  if (modes_) return;
  for (const Block& block : blocks_) {
    for (const std::size_t b : block.links) now_[b] = 0;
  }
  if (!rates_known_) measure(state_.velocity, supports_.velocity_before, rate_);
  add_rates(-time_step_, before_);
}

double LinkStep::left_over(std::size_t link) const {
  double after = free_after_[link];
  for (std::size_t k = 1; k < coupled_[link].size(); ++k) {
    after -= share_ * coupled_[link][k].compliance * force_[coupled_[link][k].link];
  }
  if (on_body_[link].body >= 0) {
    const bool has_rate = laws_[link]->rate() > 0;
    Motion others = pull_[on_body_[link].body];
    for (std::size_t m = 0; !has_rate && m < others.size(); ++m) {
      others[m] += block_pull_[on_body_[link].body][m] - force_[link] * on_body_[link].motion[m];
    }
    after -= share_ * time_step_ * time_step_ * product(on_body_[link].motion, others);
  }
  return after;
}

void LinkStep::solve(Block& block) {
  const std::size_t count = block.links.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t b = block.links[i];
    const double offset = laws_[b]->offset(before_[b], now_[b], share_, memory_[b]) - push_[b];
    block.free[i] = left_over(b) - before_[b] + offset / laws_[b]->rate(share_);
  }
  if (block.body >= 0) {
    solve_on_body(block);
  } else {
    multiply_rows(block.inverse.data(), count, count, block.free.data(), block.force.data(), 1);
  }
  for (std::size_t i = 0; i < count; ++i) force_[block.links[i]] = block.force[i];
  renew_pull(block);
}

void LinkStep::solve_on_body(Block& block) {
  // (share dt^2 G G^T + 1/r)^-1 = r - r G (1 / (share dt^2) + G^T r G)^-1 G^T r
  const std::size_t count = block.links.size();
  Motion sum{};
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t b = block.links[i];
    block.force[i] = laws_[b]->rate(share_) * block.free[i];
    for (std::size_t m = 0; m < sum.size(); ++m) sum[m] += block.force[i] * on_body_[b].motion[m];
  }
  Motion common{};
  multiply_rows(block.inverse.data(), sum.size(), sum.size(), sum.data(), common.data(), 1);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t b = block.links[i];
    block.force[i] -= laws_[b]->rate(share_) * product(on_body_[b].motion, common);
  }
}

void LinkStep::renew_pull(const Block& block) {
  for (const std::size_t b : block.links) {
    if (on_body_[b].body >= 0) block_pull_[on_body_[b].body] = {};
  }
  for (const std::size_t b : block.links) {
    const auto& [body, motion] = on_body_[b];
    for (std::size_t m = 0; body >= 0 && m < motion.size(); ++m) {
      block_pull_[body][m] += force_[b] * motion[m];
    }
  }
}

double LinkStep::sweep() {
  for (Block& block : blocks_) solve(block);
  double change = 0;
  for (const std::size_t b : others_) {
    const double force = laws_[b]->solve(before_[b], now_[b], left_over(b),
                                         share_ * coupled_[b][0].compliance, memory_[b]);
    change = std::max(change, std::abs(force - force_[b]));
    const auto& [body, motion] = on_body_[b];
    for (std::size_t m = 0; body >= 0 && m < motion.size(); ++m) {
      pull_[body][m] += (force - force_[b]) * motion[m];
    }
    force_[b] = force;
  }
  return change;
}

void LinkStep::pull(bool first) {
  if (modes_) {
    brake(first);
    return;
  }
  std::fill(force_.begin(), force_.end(), 0.0);
  std::fill(pull_.begin(), pull_.end(), Motion{});
  std::fill(block_pull_.begin(), block_pull_.end(), Motion{});
  bool idle = blocks_.empty();
  for (const std::size_t b : others_) idle = idle && laws_[b]->is_idle(now_[b], memory_[b]);
  if (idle) return;
  yield();
  const double share = first ? 0.5 : 1;
  if (share != share_) form_inverses(share);
  measure(state_.velocity, supports_.velocity, rate_);
  add_rates(time_step_, free_after_);
  for (int i = 0; i < most_sweeps; ++i) {
    const double change = sweep();
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

bool LinkStep::overpressed() const {
  bool any = false;
  for (std::size_t b = 0; b < links_.size(); ++b) {
    any = any || laws_[b]->was_overpressed(memory_[b]);
  }
  return any;
}

LinkStep::Bedding LinkStep::bedding() const {
  Bedding bedding;
  for (std::size_t b = 0; b < links_.size(); ++b) {
    if (!interactions::is_pressed(links_[b].origin)) continue;
    const double stiffness = links_[b].origin.share * links_[b].origin.region->stiffness[2];
    bedding.all += stiffness;
    if (after_[b] > 0) bedding.pressed += stiffness;
  }
  return bedding;
}

void LinkStep::finish(StepSums& sums) {
  if (modes_) {
    finish_modes(sums);
    return;
  }
  measure(state_.velocity, supports_.velocity, rate_);
  rates_known_ = true;
  add_rates(time_step_, after_);
  for (std::size_t b = 0; b < links_.size(); ++b) {
    const double held = laws_[b]->energy(before_[b], now_[b], memory_[b]);
    const double given = laws_[b]->given(before_[b], now_[b], memory_[b]);
    sums.link_energy_before += held;
    laws_[b]->remember(before_[b], now_[b], after_[b], share_, memory_[b]);
    const double mean = (after_[b] - before_[b]) / 2;
    sums.link_input += push_[b] * mean + given;
    sums.link_loss += (force_[b] + push_[b]) * mean -
                      (laws_[b]->energy(now_[b], after_[b], memory_[b]) - held) + given;
    double carried = 0;  // part of the mean that the supports make
    if (!carried_.empty()) add_columns(carried_[b], supports_.velocity_mean, &carried, 1);
    sums.support_input += time_step_ * carried * (force_[b] + push_[b]);
  }
  note_records();
}

}  // namespace pounding
