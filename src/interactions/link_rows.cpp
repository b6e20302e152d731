#include "interactions/link_rows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "interactions/dashpot_modes.h"
#include "solvers/law_solver.h"
#include "system/support_shapes.h"

namespace pounding::interactions {
namespace {

static_assert(std::tuple_size_v<OnBody::Motion> == RigidBody::width);

/// The links of a structure in generalised coordinates where all of them are dashpots: braked
/// together in their modes (DashpotBrake). Local.
class ModalDashpots final : public StructureLinks {
 public:
  ModalDashpots(const LinearSystem& system, const DashpotRows& dashpots, std::size_t structure,
                double time_step)
      : StructureLinks(system, structure, time_step),
        brake_({system, dashpots, time_step}),
        force_(links_.size(), 0.0),
        before_(links_.size(), 0.0),
        after_(links_.size(), 0.0) {}

  void begin(const Step& step) override {
    const ScopedTimer timer(step.profile, Phase::step);
    const SteppedStructure& structure = *step.structures[structure_];
    structure.remember(trace_.dofs(), held_);
    if (!records_.empty()) measure(structure.displacement(), recorded_);
  }
  void push(const Step& step) override {
    const ScopedTimer timer(step.profile, Phase::step);
    SteppedStructure& structure = *step.structures[structure_];
    trace_.restrict_to_dofs(structure.velocity().data(), velocity_.data());
    brake_.brake(step.share(), held_.velocity, velocity_);
    structure.correct(trace_.dofs(), held_, velocity_);
  }
  void finish(const Step& step) override {
    const std::vector<double>& velocity = step.structures[structure_]->velocity();
    step.ledger[structure_]->link_loss += brake_.loss(held_.velocity, velocity);
    if (records_.empty()) return;
    for (const std::size_t b : records_.links()) force_[b] = force(b);
    measure(held_.velocity, before_);
    measure(velocity, after_);
    for (std::size_t b = 0; b < links_.size(); ++b) {
      before_[b] *= -time_step_;
      after_[b] = (time_step_ * after_[b] - before_[b]) / 2;
    }
    note_records(recorded_, after_, force_);
  }
  double force(std::size_t link) const override {
    double rate = 0;  // b . (v- + v+)
    for (std::size_t k = 0; k < links_[link].point.size(); ++k) {
      if (links_[link].point[k] < 0) continue;
      const auto row = trace_.row(static_cast<std::size_t>(links_[link].point[k]));
      for (std::size_t i = 0; i < row.size(); ++i) {
        rate += links_[link].weight[k] * row[i] * brake_.sums()[i];
      }
    }
    return laws_[link]->rate() * time_step_ * rate;
  }

 private:
  DashpotBrake<double> brake_;
  std::vector<double> force_;
  std::vector<double> before_;  ///< e_{n-1} less e_n, of all links
  std::vector<double> after_;   ///< (e_{n+1} - e_{n-1}) / 2
};

/// Links of a structure row by row: once the step without them is made, their forces are solved for
/// (LawSolver) and v+ and u_{n+1} corrected at the dofs that they move. Contact comes after them;
/// where it acts on the nodes of a dashpot, or of a link that switches in the same step, the link's
/// work differs from that of its law by the part that contact changed, and the ledger shows it as
/// loss. Local.
class LinkRows final : public StructureLinks {
 public:
  LinkRows(const LinearSystem& system, std::size_t structure, double time_step)
      : StructureLinks(system, structure, time_step),
        carried_(carried_by_supports(system)),
        solver_(make_solver(system)),
        yields_(links_),
        elongations_(links_.size()),
        after_(links_.size(), 0.0),
        rate_(links_.size(), 0.0),
        driven_(links_.size(), 0.0),
        force_(links_.size(), 0.0),
        stretch_(links_.size(), 0.0) {
    for (const auto& law : laws_) has_rate_.push_back(law->rate() > 0 ? 1 : 0);
    for (std::size_t b = 0; b < links_.size(); ++b) {
      if (!links_[b].incident.empty()) in_waves_.push_back(b);
    }
    rates_only_ = std::ranges::all_of(has_rate_, [](char has_rate) { return has_rate != 0; });
  }

  void begin(const Step& step) override {
    const ScopedTimer timer(step.profile, Phase::step);
    const SteppedStructure& structure = *step.structures[structure_];
    rates_known_ = rates_known_ && !structure.in_modes();
    if (structure.in_modes()) return;
    auto& [before, now, free_after] = elongations_;
    for (const std::size_t b : in_waves_) {
      const std::vector<double>& along = links_[b].incident;
      driven_[b] = std::inner_product(along.begin() + 1, along.end(), step.incident.begin() + 1,
                                      along[0] * step.incident[0]);
    }
    structure.remember(trace_.dofs(), held_);
    const auto& displacement = structure.displacement();
    if (!rates_only_ || !records_.empty()) {
      measure_carried(displacement, step.supports.displacement, now);
      if (!records_.empty()) recorded_ = now;
    }
    if (!rates_known_) measure_carried(structure.velocity(), step.supports.velocity_before, rate_);
    for (std::size_t b = 0; b < links_.size(); ++b) {
      if (has_rate_[b] != 0) now[b] = 0;
      before[b] = now[b] - time_step_ * rate_[b];
    }
  }
  void push(const Step& step) override {
    const ScopedTimer timer(step.profile, Phase::step);
    SteppedStructure& structure = *step.structures[structure_];
    if (structure.in_modes()) return;
    auto& [before, now, free_after] = elongations_;
    std::fill(force_.begin(), force_.end(), 0.0);
    if (solver_.is_idle(now, memory_)) return;
    yields_.yield(laws_, now, memory_);
    measure_carried(structure.velocity(), step.supports.velocity, rate_);
    for (std::size_t b = 0; b < links_.size(); ++b) {
      free_after[b] = now[b] + time_step_ * rate_[b];
    }
    solver_.solve(step.share(), elongations_, driven_, memory_, force_);
    std::fill(field_.begin(), field_.end(), 0.0);
    for (std::size_t b = 0; b < links_.size(); ++b) {
      const auto points = weights_.columns(b);
      const auto weights = weights_.values(b);
      for (std::size_t i = 0; i < points.size(); ++i) {
        field_[points[i]] -= weights[i] * step.share() * time_step_ * force_[b];
      }
    }
    trace_.restrict_to_dofs(structure.velocity().data(), velocity_.data());
    trace_.add_impulse(field_.data(), velocity_.data());
    structure.correct(trace_.dofs(), held_, velocity_);
  }
  void finish(const Step& step) override {
    if (step.structures[structure_]->in_modes()) return;
    LedgerPart& ledger = *step.ledger[structure_];
    const auto& [before, now, free_after] = elongations_;
    measure_carried(step.structures[structure_]->velocity(), step.supports.velocity, rate_);
    rates_known_ = true;
    for (std::size_t b = 0; b < links_.size(); ++b) {
      const LinkLaw& law = *laws_[b];
      const std::span<double> memory = memory_[b];
      after_[b] = now[b] + time_step_ * rate_[b];
      const double held = law.energy(before[b], now[b], memory);
      const double given = law.given(before[b], now[b], memory);
      ledger.link_energy_before += held;
      law.remember(before[b], now[b], after_[b], step.share(), memory);
      stretch_[b] = (after_[b] - before[b]) / 2;
      ledger.link_input += driven_[b] * stretch_[b] + given;
      (law.loses_plastic_work() ? ledger.plastic_loss : ledger.link_loss) +=
          (force_[b] + driven_[b]) * stretch_[b] - (law.energy(now[b], after_[b], memory) - held) +
          given;
      if (carried_.empty()) continue;
      double carried = 0;  // part of the stretch that the supports make
      add_columns(carried_[b], step.supports.velocity_mean, &carried, 1);
      ledger.support_input += time_step_ * carried * (force_[b] + driven_[b]);
    }
    note_records(now, stretch_, force_);
  }
  void keep(const StateKeeper& state) override {
    rates_known_ = rates_known_ && state.puts();
    StructureLinks::keep(state);
  }
  Bedding bedding() const override {
    Bedding bedding;
    for (std::size_t b = 0; b < links_.size(); ++b) {
      if (!is_pressed(links_[b].origin)) continue;
      const double stiffness = links_[b].origin.share * links_[b].origin.region->stiffness[2];
      bedding.all += stiffness;
      if (after_[b] > laws_[b]->slack(memory_[b])) bedding.pressed += stiffness;
    }
    return bedding;
  }
  bool overpressed() const override {
    for (std::size_t b = 0; b < links_.size(); ++b) {
      if (laws_[b]->was_overpressed(memory_[b])) return true;
    }
    return false;
  }
  double force(std::size_t link) const override { return force_[link]; }

 private:
  LawSolver make_solver(const LinearSystem& system) {
    std::vector<OnBody> on_body = find_bodies(system);
    auto couplings = find_couplings(on_body, system.lumped_mass.size());
    return {laws_, std::move(couplings), std::move(on_body), time_step_};
  }
  std::vector<OnBody> find_bodies(const LinearSystem& system) const {
    std::vector<OnBody> on_body(links_.size());
    if (!system.coupled_mass) return on_body;
    std::map<LocalIndex, std::pair<int, std::span<const double, RigidBody::width>>> rows;
    int number = 0;
    for (const RigidBody& body : system.coupled_mass->bodies()) {
      for (std::size_t k = 0; k < body.dofs().size(); ++k) {
        rows.emplace(body.dofs()[k], std::pair(number, body.row(k)));
      }
      ++number;
    }
    for (std::size_t b = 0; b < links_.size(); ++b) {
      int body = -1;
      bool alone = true;  // it moves one body and nothing else
      OnBody::Motion motion{};
      for (std::size_t i = 0; i < links_[b].point.size(); ++i) {
        if (links_[b].point[i] < 0) continue;
        const auto found = rows.find(trace_.dofs()[static_cast<std::size_t>(links_[b].point[i])]);
        alone = alone && found != rows.end() && (body < 0 || body == found->second.first);
        if (!alone) break;
        body = found->second.first;
        for (std::size_t m = 0; m < motion.size(); ++m) {
          motion[m] += links_[b].weight[i] * found->second.second[m];
        }
      }
      if (alone && body >= 0) on_body[b] = {body, motion};
    }
    return on_body;
  }
  std::vector<std::vector<Coupling>> find_couplings(const std::vector<OnBody>& on_body,
                                                    std::size_t owned_dofs) {
    std::vector<std::vector<std::size_t>> at_point(field_.size());
    for (std::size_t b = 0; b < links_.size(); ++b) {
      for (const int point : links_[b].point) {
        if (point >= 0) at_point[point].push_back(b);
      }
    }
    std::vector<std::vector<Coupling>> couplings(links_.size());
    for (std::size_t b = 0; b < links_.size(); ++b) {
      const OnBody::Motion& m = on_body[b].motion;
      const double own = std::inner_product(m.begin(), m.end(), m.begin(), 0.0);
      if (on_body[b].body >= 0) couplings[b].push_back({b, own});
    }
    std::vector<double> moved(owned_dofs, 0.0);
    std::vector<double> all(links_.size(), 0.0);
    for (std::size_t b = 0; b < links_.size(); ++b) {
      if (on_body[b].body >= 0) continue;
      std::map<std::size_t, double> response;  // [1/kg]
      if (std::ranges::any_of(links_[b].point,
                              [&](int k) { return k >= 0 && trace_.moves_others(k); })) {
        respond(links_[b], moved, all);
        for (std::size_t other = 0; other < links_.size(); ++other) response[other] = all[other];
      } else {
        for (std::size_t i = 0; i < links_[b].point.size(); ++i) {
          const int point = links_[b].point[i];
          if (point < 0) continue;
          const double own = trace_.compliance(point, point) * links_[b].weight[i];
          for (const std::size_t other : at_point[point]) {
            const auto& points = links_[other].point;
            const auto there = std::ranges::find(points, point) - points.begin();
            response[other] += links_[other].weight[there] * own;
          }
        }
      }
      couplings[b].push_back({b, std::max(0.0, response[b])});
      for (const auto& [other, velocity] : response) {
        if (other == b || velocity == 0) continue;
        couplings[b].push_back({other, velocity});
        if (on_body[other].body >= 0) couplings[other].push_back({b, velocity});
      }
    }
    return couplings;
  }
  /// b . v of all links for impulses [N s] of one of them in a second [1/kg].
  void respond(const Link& link, std::vector<double>& all, std::vector<double>& response) {
    std::fill(field_.begin(), field_.end(), 0.0);
    for (std::size_t i = 0; i < link.point.size(); ++i) {
      if (link.point[i] >= 0) field_[link.point[i]] += link.weight[i];
    }
    std::fill(velocity_.begin(), velocity_.end(), 0.0);
    trace_.add_impulse(field_.data(), velocity_.data());
    for (std::size_t k = 0; k < velocity_.size(); ++k) all[trace_.dofs()[k]] = velocity_[k];
    measure(all, response);
  }
  /// b . u of all links, with the supports' motion that carries them along, per column.
  void measure_carried(const std::vector<double>& owned, std::span<const double> supports,
                       std::vector<double>& elongations) {
    measure(owned, elongations);
    for (std::size_t b = 0; b < carried_.size(); ++b) {
      add_columns(carried_[b], supports, &elongations[b], 1);
    }
  }

  std::vector<std::vector<double>> carried_;  ///< see carried_by_supports
  LawSolver solver_;
  YieldGroups yields_;
  std::vector<char> has_rate_;         ///< per link
  std::vector<std::size_t> in_waves_;  ///< links that a wave from below drives
  bool rates_only_ = false;            ///< every link has one
  bool rates_known_ = false;           ///< rate_ is that of v-
  Elongations elongations_;
  std::vector<double> after_;    ///< e_{n+1}
  std::vector<double> rate_;     ///< b . v
  std::vector<double> driven_;   ///< of the wave from below, against N_n [N]
  std::vector<double> force_;    ///< N_n [N]
  std::vector<double> stretch_;  ///< (e_{n+1} - e_{n-1}) / 2
};

}  // namespace

std::unique_ptr<StructureLinks> make_links(const LinearSystem& system, std::size_t structure,
                                           double time_step) {
  if (const auto dashpots = dashpot_rows(system)) {
    return std::make_unique<ModalDashpots>(system, *dashpots, structure, time_step);
  }
  return std::make_unique<LinkRows>(system, structure, time_step);
}

}  // namespace pounding::interactions
