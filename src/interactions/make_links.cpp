#include "interactions/make_links.h"

#include <memory>
#include <span>
#include <vector>

#include "interactions/dashpot_modes.h"
#include "interactions/link_rows.h"
#include "interactions/structure_links.h"

namespace pounding::interactions {
namespace {

/// The links of a structure in generalised coordinates where all of them are dashpots: braked
/// together in their modes (DashpotBrake). Local.
class ModalDashpots final : public StructureLinks {
 public:
  ModalDashpots(const LinearSystem& system, const DashpotRows& dashpots, std::size_t structure,
                double time_step);

  void begin(const Step& step) override;
  void push(const Step& step) override;
  void finish(const Step& step) override;
  double force(std::size_t link) const override;

 private:
  DashpotBrake<double> brake_;
  std::vector<double> force_;
  std::vector<double> before_;  ///< e_{n-1} less e_n, of all links
  std::vector<double> after_;   ///< (e_{n+1} - e_{n-1}) / 2
};

ModalDashpots::ModalDashpots(const LinearSystem& system, const DashpotRows& dashpots,
                             std::size_t structure, double time_step)
    : StructureLinks(system, structure, time_step),
      brake_({system, dashpots, time_step}),
      force_(links_.size(), 0.0),
      before_(links_.size(), 0.0),
      after_(links_.size(), 0.0) {}

double ModalDashpots::force(std::size_t link) const {
  double rate = 0;  // b . (v- + v+)
  for (std::size_t k = 0; k < links_[link].place.size(); ++k) {
    if (links_[link].place[k] < 0) continue;
    const auto row = trace_.row(static_cast<std::size_t>(links_[link].place[k]));
    for (std::size_t i = 0; i < row.size(); ++i) {
      rate += links_[link].weight[k] * row[i] * brake_.sums()[i];
    }
  }
  return laws_[link]->rate() * time_step_ * rate;
}

void ModalDashpots::begin(const Step& step) {
  const ScopedTimer timer(step.profile, Phase::step);
  const SteppedStructure& structure = *step.structures[structure_];
  structure.remember(trace_.dofs(), held_);
  if (!records_.empty()) measure(structure.displacement(), recorded_);
}

void ModalDashpots::push(const Step& step) {
  const ScopedTimer timer(step.profile, Phase::step);
  SteppedStructure& structure = *step.structures[structure_];
  trace_.restrict_to_dofs(structure.velocity().data(), velocity_.data());
  brake_.brake(step.share(), held_.velocity, velocity_);
  structure.correct(trace_.dofs(), held_, velocity_);
}

void ModalDashpots::finish(const Step& step) {
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

}  // namespace

std::unique_ptr<StructureLinks> make_links(const LinearSystem& system, std::size_t structure,
                                           double time_step) {
  if (const auto dashpots = dashpot_rows(system)) {
    return std::make_unique<ModalDashpots>(system, *dashpots, structure, time_step);
  }
  return std::make_unique<LinkRows>(system, structure, time_step);
}

}  // namespace pounding::interactions
