#include "interactions/soil_rows.h"

#include <algorithm>
#include <array>

#include "laws/dashpot_law.h"

namespace pounding::interactions {
namespace {

std::vector<std::unique_ptr<LinkLaw>> soil_laws(std::span<const SoilRow> rows, double time_step) {
  std::vector<std::unique_ptr<LinkLaw>> laws;
  for (const SoilRow& row : rows) {
    if (row.impedance.is_spring()) {
      laws.push_back(std::make_unique<SpringLaw>(row.impedance.stiffness));
    } else {
      laws.push_back(std::make_unique<SoilLaw>(row.impedance, time_step));
    }
  }
  return laws;
}

}  // namespace

CoupledRows make_soil_rows(MPI_Comm comm, const Interface& interface,
                           std::span<const LinearSystem> systems, std::span<const Mesh> meshes) {
  std::vector<Constraint> constraints(interface.soil.size());
  for (std::size_t r = 0; r < constraints.size(); ++r) {
    constraints[r].terms = interface.soil[r].terms;
  }
  return {comm, constraints, systems, meshes};
}

SoilRows::SoilRows(MPI_Comm comm, const Interface& interface, std::span<const LinearSystem> systems,
                   std::span<const Mesh> meshes, double time_step)
    : LawRows(
          comm, time_step, [&] { return make_soil_rows(comm, interface, systems, meshes); },
          [&](const CoupledRows&) { return soil_laws(interface.soil, time_step); }) {}

void SoilRows::begin(const Step& step) {
  if (!rows_.rows().member()) return;
  const ScopedTimer timer(step.profile, Phase::step);
  take_state(step, {}, {});
  for (std::size_t r = 0; r < laws_.size(); ++r) {  // no law but a spring's sees how far they are
    if (laws_[r]->is_explicit()) continue;
    elongations_.now[r] = 0;
    elongations_.before[r] = elongations_.now[r] - time_step_ * rate_[r];
  }
  close_step_before(step.number == 1 ? 0.5 : 1);
  made_ = true;
}

void SoilRows::close_step_before(double share) {
  const auto& [before, now, free_after] = elongations_;
  loss_ = 0;
  for (std::size_t r = 0; r < laws_.size(); ++r) {
    const double stretch = time_step_ * (rate_[r] + rate_before_[r]) / 2;
    if (made_) {
      laws_[r]->remember(-time_step_ * rate_before_[r], 0, time_step_ * rate_[r], share,
                         memory_[r]);
    }
    const double held = laws_[r]->energy(before[r], now[r], memory_[r]);
    if (made_) loss_ += force_[r] * stretch - (held - held_[r]);
    held_[r] = held;
  }
}

void SoilRows::push(const Step& step) {
  if (!rows_.rows().member()) return;
  const ScopedTimer timer(step.profile, Phase::step);
  respond(step, {});
}

void SoilRows::finish(const Step& step) {
  if (!counts_) return;
  LedgerPart& ledger = *step.ledger.front();
  for (const double held : held_) ledger.link_energy_before += held;
  ledger.link_loss_before += loss_;
}

void SoilRows::keep(const StateKeeper& state) {
  if (state.puts() && !counts_) return;
  state.rows("soil between mats", laws_.size(), [&](std::size_t r, const auto& take) {
    std::array<double, 2> memory{};  // the most that a law has
    std::ranges::copy(memory_[r], memory.begin());
    take(memory[0], memory[1], force_[r], rate_[r], held_[r]);
    std::copy_n(memory.begin(), memory_[r].size(), memory_[r].begin());
  });
  made_ = made_ || !state.puts();
}

}  // namespace pounding::interactions
