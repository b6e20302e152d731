#include "interactions/filler_rows.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace pounding::interactions {
namespace {

std::vector<Constraint> filled(const Interface& interface) {
  std::vector<Constraint> found;
  std::ranges::copy_if(interface.constraints, std::back_inserter(found),
                       [](const Constraint& c) { return c.filler.area > 0; });
  return found;
}

std::vector<FillerPairs::Pair> pairs_of(const Interface& interface) {
  std::vector<FillerPairs::Pair> pairs;
  for (std::size_t r = 0; r < interface.constraints.size(); ++r) {
    const Constraint& c = interface.constraints[r];
    if (c.filler.area > 0) pairs.push_back({c.contact, r, c.filler, c.place});
  }
  return pairs;
}

/// Terms of all rows where stops give way or faces are crushed: whoever knows a contact knows their
/// forces then, which its histories and its catalogue hold.
std::vector<ConstraintTerm> terms_beside(const Interface& interface) {
  std::vector<ConstraintTerm> terms;
  if (std::ranges::none_of(interface.constraints,
                           [](const Constraint& c) { return c.filler.strikes(); })) {
    return terms;
  }
  for (const Constraint& c : interface.constraints) {
    terms.insert(terms.end(), c.terms.begin(), c.terms.end());
  }
  return terms;
}

constexpr double round_off = 1e-12;  ///< of a crushed depth, over the thickness

std::vector<std::unique_ptr<LinkLaw>> filler_laws(const FillerPairs& pairs,
                                                  std::span<const Contact> contacts,
                                                  double time_step) {
  std::vector<std::unique_ptr<LinkLaw>> laws;
  for (const FillerPairs::Pair& pair : pairs.all()) {
    const Contact& contact = contacts[pair.contact];
    if (contact.is_elastic()) {
      laws.push_back(std::make_unique<TensionLaw>(contact.stop->stiffness,
                                                  contact.stop->dashpot / (2 * time_step)));
    } else {
      laws.push_back(
          std::make_unique<FillerLaw>(*contact.filler, pair.part.thickness, pair.part.area));
    }
  }
  return laws;
}

}  // namespace

FillerPairs::FillerPairs(MPI_Comm comm, const Interface& interface,
                         std::span<const LinearSystem> systems, std::span<const Mesh> meshes)
    : CoupledRows(comm, filled(interface), systems, meshes, terms_beside(interface)),
      pairs_(pairs_of(interface)) {
  count_from_rest(systems);
}

void FillerPairs::count_from_rest(std::span<const LinearSystem> systems) {
  for (std::size_t s = 0; s < systems.size(); ++s) {
    const std::vector<double> none(systems[s].lumped_mass.size(), 0.0);
    const std::vector<double>& rest = systems[s].rest_displacement;
    set_displacement(s, rest.empty() ? none.data() : rest.data(), {});
    set_velocity(s, none.data(), {});
  }
  if (!rows().member()) return;
  std::vector<double> compression(pairs_.size());
  std::vector<double> rate(pairs_.size());
  gather(compression, rate);
  for (std::size_t r = 0; r < pairs_.size(); ++r) {
    pairs_[r].part.clearance += compression[r] + pairs_[r].part.clearance;
  }
}

void FillerPairs::gather(std::span<double> compression, std::span<double> rate) {
  CoupledRows::gather(compression, rate);
  for (std::size_t r = 0; r < pairs_.size(); ++r) {
    compression[r] = -compression[r] - pairs_[r].part.clearance;
    rate[r] = -rate[r];
  }
}

FillerRows::FillerRows(MPI_Comm comm, const Interface& interface, std::span<const Contact> contacts,
                       std::span<const LinearSystem> systems, std::span<const Mesh> meshes,
                       double time_step)
    : LawRows(
          comm, time_step, [&] { return FillerPairs(comm, interface, systems, meshes); },
          [&](const FillerPairs& pairs) { return filler_laws(pairs, contacts, time_step); }),
      row_loss_(laws_.size(), 0.0),
      totals_(contacts.size()),
      contact_force_(contacts.size(), 0.0) {}

FillerRows::~FillerRows() = default;

void FillerRows::begin(const Step& step) {
  if (!rows_.rows().member()) return;
  const ScopedTimer timer(step.profile, Phase::contact);
  take_state(step, step.supports.displacement, step.supports.velocity_before);
  close_step_before();
  for (std::size_t r = 0; r < laws_.size(); ++r) {
    laws_[r]->yield(elongations_.now[r], 1, memory_[r]);
  }
  made_ = true;
}

void FillerRows::close_step_before() {
  const auto& [before, now, free_after] = elongations_;
  loss_ = plastic_loss_ = 0;
  for (std::size_t r = 0; r < laws_.size(); ++r) {
    const double held = laws_[r]->energy(before[r], now[r], memory_[r]);
    if (made_) {
      const double taken = force_[r] * time_step_ * (rate_[r] + rate_before_[r]) / 2;
      const double loss = taken - (held - held_[r]);
      (laws_[r]->loses_plastic_work() ? plastic_loss_ : loss_) += loss;
      row_loss_[r] = loss;
      totals_[rows_.all()[r].contact].loss += loss;
    }
    held_[r] = held;
  }
  for (std::size_t k = 0; made_ && k < records_.links().size(); ++k) {
    const std::size_t r = records_.links()[k];
    records_.add_work(k, force_[r] * time_step_ * (rate_[r] + rate_before_[r]) / 2);
  }
}

void FillerRows::push(const Step& step) {
  if (!rows_.rows().member()) return;
  const ScopedTimer timer(step.profile, Phase::contact);
  std::ranges::fill(force_, 0.0);
  support_input_ = 0;
  duration_ = step.share() * time_step_;
  if (solver_.is_idle(elongations_.now, memory_)) return;
  respond(step, step.supports.velocity);
  for (std::size_t s = 0; s < step.structures.size(); ++s) {
    support_input_ -= rows_.support_work(s, step.supports.velocity_mean);
  }
  note_peaks();
}

void FillerRows::note_peaks() {
  std::fill(contact_force_.begin(), contact_force_.end(), 0.0);
  for (std::size_t r = 0; r < laws_.size(); ++r) {
    const auto& [contact, row, part, place] = rows_.all()[r];
    FillerTotals& totals = totals_[contact];
    contact_force_[contact] += force_[r];
    if (part.is_spring()) continue;
    totals.peak_pressure = std::max(totals.peak_pressure, force_[r] / part.area);
    totals.crushed_strain = std::max(totals.crushed_strain, memory_[r][1] / part.thickness);
    if (memory_[r][1] > std::max(totals.crushed_depth, round_off * part.thickness)) {
      totals.crushed_depth = memory_[r][1];
      totals.crushed_place = place;
    }
  }
  for (std::size_t c = 0; c < totals_.size(); ++c) {
    totals_[c].peak_force = std::max(totals_[c].peak_force, contact_force_[c]);
  }
}

void FillerRows::finish(const Step& step) {
  if (!rows_.rows().member()) return;
  LedgerPart& ledger = *step.ledger.front();
  for (std::size_t r = 0; r < laws_.size(); ++r) {
    laws_[r]->remember(0, elongations_.now[r], 0, 1, memory_[r]);
    if (counts_) ledger.link_energy_before += held_[r];
  }
  for (std::size_t k = 0; k < records_.links().size(); ++k) {
    const std::size_t r = records_.links()[k];
    records_.note(k, elongations_.now[r], force_[r], laws_[r]->has_yielded(memory_[r]));
  }
  if (counts_) {
    ledger.link_loss_before += loss_;
    ledger.plastic_loss_before += plastic_loss_;
  }
  ledger.support_input += support_input_;
}

bool FillerRows::strikes() const {
  for (std::size_t r = 0; r < laws_.size(); ++r) {
    if (rows_.all()[r].part.strikes() && (force_[r] > 0 || row_loss_[r] != 0)) return true;
  }
  return false;
}

void FillerRows::add_strikes(std::span<double> impulses, std::span<double> works) const {
  for (std::size_t r = 0; r < laws_.size(); ++r) {
    const FillerPairs::Pair& pair = rows_.all()[r];
    if (!pair.part.strikes()) continue;
    impulses[pair.row] += duration_ * force_[r];
    works[pair.row] -= row_loss_[r];
  }
}

std::vector<std::string> FillerRows::record_names() const {
  std::vector<std::string> names;
  for (const std::size_t r : records_.links()) {
    names.push_back("record of filler row " + std::to_string(r));
  }
  return names;
}

void FillerRows::keep(const StateKeeper& state) {
  if (state.puts() && !counts_) return;
  state.rows("fillers", laws_.size(), [&](std::size_t r, const auto& take) {
    double crushed = memory_[r].empty() ? 0 : memory_[r][0];
    take(crushed, force_[r], rate_[r], held_[r]);
    if (!state.puts()) std::ranges::fill(memory_[r], crushed);
  });
  state.rows("filler_totals", totals_.size(), [&](std::size_t c, const auto& take) {
    FillerTotals& t = totals_[c];
    take(t.peak_pressure, t.peak_force, t.crushed_strain, t.loss, t.crushed_depth,
         t.crushed_place[0], t.crushed_place[1]);
  });
  if (rows_.rows().member()) records_.keep(record_names(), state);
  made_ = made_ || !state.puts();
}

}  // namespace pounding::interactions
