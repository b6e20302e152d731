#include "interactions/inelastic_elements.h"

#include <algorithm>
#include <array>
#include <utility>

#include "common/parallel.h"
#include "system/law_forces.h"
#include "system/support_shapes.h"

namespace pounding::interactions {
InelasticElements::InelasticElements(std::size_t structure, const Mesh& mesh,
                                     const LinearSystem& system, double time_step,
                                     std::vector<RegionLaw> laws)
    : structure_(structure),
      mesh_(mesh),
      system_(system),
      time_step_(time_step),
      laws_(std::move(laws)),
      state_(0) {
  const bool apart = laws_.front().apart;
  const std::vector<char> acted_on = dofs_of_laws(laws_, apart, mesh);
  for (LocalIndex dof = 0; dof < mesh.owned_dofs; ++dof) {
    if (acted_on[dof] != 0) dofs_.push_back(dof);
  }
  if (apart) trace_.emplace(system, mesh, points_of(mesh, dofs_), true);
  for (const RegionLaw& entry : laws_) {
    std::size_t first = 0;
    for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
      const ElementBlock& block = mesh.blocks[b];
      if (block.region != entry.region) continue;
      Group& group = groups_.emplace_back();
      group.block = b;
      group.first = first;
      first += block.count();
      group.layout = element_layout(block.type);
      group.law = entry.law.get();
      group.memory.assign(block.count() * entry.law->memory_size(), 0.0);
      find_slots(group);
      for (std::size_t e = 0; e < block.count(); ++e) {
        for (std::size_t p = 0; group.counted[e] != 0 && p < entry.law->parts().size(); ++p) {
          parts_.push_back({groups_.size() - 1, e, p});
        }
      }
    }
  }
  if (!trace_) find_ghosts();
  displacement_.assign(mesh.dof_count + held_.size(), 0.0);
  force_ = displacement_;
  find_carried();
  now_.assign(dofs_.size(), 0.0);
  before_ = acting_ = after_ = now_;
  state_ = Before(dofs_.size());
  if (!trace_) return;
  stepped_ = Before(trace_->dofs().size());
  velocity_.assign(trace_->dofs().size(), 0.0);
}

InelasticElements::~InelasticElements() = default;

void InelasticElements::find_slots(Group& group) {
  const ElementBlock& block = mesh_.blocks[group.block];
  const auto acts = [&](std::size_t e, std::size_t i) {
    return group.law->acts_on(group.first + e, i);
  };
  for (std::size_t i = 0; i < static_cast<std::size_t>(group.layout.size()); ++i) {
    bool any = false;
    for (std::size_t e = 0; e < block.count(); ++e) any = any || acts(e, i);
    if (any) group.acting.push_back({i});
    if (any && is_grounded(block.type) && system_.supports) group.acting.push_back({i, true});
  }
  const auto components = static_cast<std::size_t>(group.layout.components);
  const auto nodes = static_cast<std::size_t>(group.layout.nodes);
  for (std::size_t e = 0; e < block.count(); ++e) {
    for (const auto& [i, ground] : group.acting) {
      const LocalIndex node = block.connectivity[e * nodes + i / components];
      const auto component = static_cast<int>(i % components);
      group.slots.push_back(acts(e, i) ? slot_of(node, component, ground) : -1);
    }
  }
  group.counted = block.counted;
  for (std::size_t e = 0; trace_ && e < block.count(); ++e) {
    const auto first = group.slots.begin() + static_cast<std::ptrdiff_t>(e * group.acting.size());
    group.counted[e] =
        std::any_of(first, first + static_cast<std::ptrdiff_t>(group.acting.size()),
                    [&](LocalIndex slot) { return slot >= 0 && slot < mesh_.owned_dofs; });
  }
}

double InelasticElements::carried_by(const SupportColumn& column, const HeldDof& held) const {
  return held.ground ? ground_displacement(column, mesh_, held.node, held.component)
                     : support_displacement(column, mesh_, held.node, held.component);
}

LocalIndex InelasticElements::slot_of(LocalIndex node, int component, bool ground) {
  const LocalIndex dof = ground ? -1 : mesh_.dof(node, component);
  if (dof >= 0 || !system_.supports) return dof;
  const HeldDof held{node, component, ground};
  const auto moves = [&](const SupportColumn& column) { return carried_by(column, held) != 0; };
  if (std::ranges::none_of(system_.supports->columns, moves)) return -1;
  const auto found = std::ranges::find(held_, held);
  const auto slot = static_cast<LocalIndex>(found - held_.begin());
  if (found == held_.end()) held_.push_back(held);
  return static_cast<LocalIndex>(mesh_.dof_count) + slot;
}

void InelasticElements::find_ghosts() {
  for (const Group& group : groups_) {
    for (const LocalIndex slot : group.slots) {
      const bool is_ghost =
          slot >= mesh_.owned_dofs && slot < static_cast<LocalIndex>(mesh_.dof_count);
      if (is_ghost) ghosts_.push_back(slot);
    }
  }
  std::ranges::sort(ghosts_);
  ghosts_.erase(std::unique(ghosts_.begin(), ghosts_.end()), ghosts_.end());
  const std::vector<GlobalIndex> all = ghost_dofs(mesh_);
  std::vector<GlobalIndex> needed;
  for (const LocalIndex ghost : ghosts_) needed.push_back(all[ghost - mesh_.owned_dofs]);
  halo_ = std::make_unique<Halo>(mesh_.comm, mesh_.first_owned_dof, mesh_.owned_dofs, needed);
}

void InelasticElements::take_ghosts(std::vector<double>& values) const {
  for (std::size_t g = 0; g < ghosts_.size(); ++g) {
    values[ghosts_[g]] = halo_->ghosts()[halo_->slot(g)];
  }
}

void InelasticElements::find_carried() {
  if (!system_.supports) return;
  const SupportShapes& supports = *system_.supports;
  for (std::size_t c = 0; c < supports.columns.size(); ++c) {
    std::vector<double>& carried = carried_.emplace_back(mesh_.dof_count + held_.size(), 0.0);
    if (trace_) {
      for (std::size_t k = 0; k < dofs_.size(); ++k) carried[dofs_[k]] = trace_->carried(k)[c];
    } else {
      std::vector<double> owned = supports.shape[c];
      owned.resize(mesh_.owned_dofs, 0.0);
      halo_->begin(owned);
      std::ranges::copy(owned, carried.begin());
      halo_->end();
      take_ghosts(carried);
    }
    for (std::size_t k = 0; k < held_.size(); ++k) {
      carried[mesh_.dof_count + k] = carried_by(supports.columns[c], held_[k]);
    }
  }
}

void InelasticElements::exchange(const Step& step, double back) {
  const SteppedStructure& structure = *step.structures[structure_];
  const stiffness::StiffnessArgument moved{structure.displacement().data(),
                                           structure.velocity().data(), -back};
  if (halo_) halo_->begin(moved);
  for (std::size_t k = 0; k < dofs_.size(); ++k) {
    displacement_[dofs_[k]] = state_.displacement[k] - back * state_.velocity[k];
  }
  if (halo_) {
    halo_->end();
    take_ghosts(displacement_);
  }
  if (carried_.empty()) return;
  std::fill_n(displacement_.begin() + static_cast<std::ptrdiff_t>(mesh_.dof_count), held_.size(),
              0.0);
  for (std::size_t c = 0; c < carried_.size(); ++c) {
    const double along = step.supports.displacement[c] - back * step.supports.velocity_before[c];
    for (const LocalIndex dof : dofs_) displacement_[dof] += along * carried_[c][dof];
    for (std::size_t i = mesh_.owned_dofs; i < displacement_.size(); ++i) {
      displacement_[i] += along * carried_[c][i];
    }
  }
}

double InelasticElements::respond() {
  double offset = 0;
  for (const LocalIndex dof : dofs_) force_[dof] = 0;
  std::fill(force_.begin() + static_cast<std::ptrdiff_t>(mesh_.dof_count), force_.end(), 0.0);
  std::array<double, max_element_size> g{};
  for (Group& group : groups_) {
    std::array<double, max_element_size> u{};
    const std::size_t size = group.layout.size();
    const std::size_t acting = group.acting.size();
    const std::size_t numbers = group.law->memory_size();
    for (std::size_t e = 0; e < group.counted.size(); ++e) {
      const LocalIndex* const slot = group.slots.data() + e * acting;
      for (std::size_t k = 0; k < acting; ++k) {
        const auto& [dof, ground] = group.acting[k];
        const double own = slot[k] < 0 ? 0 : displacement_[slot[k]];
        u[dof] = ground ? u[dof] - own : own;
      }
      const ElementLaw::Response response =
          group.law->respond(group.first + e, {u.data(), size},
                             {group.memory.data() + e * numbers, numbers}, {g.data(), size});
      if (!response.acts) continue;
      const bool counted = group.counted[e] != 0;
      if (counted) offset += response.offset;
      for (std::size_t k = 0; k < acting; ++k) {
        const bool held = slot[k] >= static_cast<LocalIndex>(mesh_.dof_count);
        const bool own = held ? counted : slot[k] >= 0 && slot[k] < mesh_.owned_dofs;
        const auto& [dof, ground] = group.acting[k];
        if (own) force_[slot[k]] += ground ? -g[dof] : g[dof];
      }
      std::fill_n(g.begin(), size, 0.0);
    }
  }
  return offset;
}

void InelasticElements::attach(std::span<SteppedStructure* const> structures) {
  if (trace_) structures[structure_]->watch(trace_->dofs(), true);
}

void InelasticElements::begin(const Step& step) {
  const ScopedTimer timer(step.profile, Phase::step);
  SteppedStructure& structure = *step.structures[structure_];
  if (trace_) {
    structure.remember(trace_->dofs(), stepped_);
    measure(structure.displacement(), state_.displacement);
    measure(structure.velocity(), state_.velocity);
  } else {
    structure.remember(dofs_, state_);
  }
  if (step.number == 0) {  // g_{-1}, of which no history is kept
    std::vector<std::vector<double>> kept;
    for (const Group& group : groups_) kept.push_back(group.memory);
    exchange(step, time_step_);
    held_energy_ = -respond();
    for (std::size_t k = 0; k < dofs_.size(); ++k) {
      now_[k] = force_[dofs_[k]];
      held_energy_ += now_[k] * (state_.displacement[k] + carried(step, dofs_[k]).now) / 2;
    }
    for (std::size_t g = 0; g < groups_.size(); ++g) groups_[g].memory = kept[g];
  }
  before_ = now_;
  for (std::size_t k = 0; k < taken_.size(); ++k) {
    taken_[k] = state_of(parts_[records_.links()[k]]).taken;
  }
  exchange(step, 0);
  offset_ = respond();
  for (std::size_t k = 0; k < taken_.size(); ++k) {
    const PartState part = state_of(parts_[records_.links()[k]]);
    records_.note(k, part.elongation, part.force, part.ductility > 1);
    records_.add_work(k, part.taken - taken_[k]);
  }
  const double lag = trace_ ? 0 : system_.damping.beta / time_step_;
  for (std::size_t k = 0; k < dofs_.size(); ++k) {
    now_[k] = force_[dofs_[k]];
    acting_[k] = now_[k] + lag * (now_[k] - before_[k]);
  }
  if (!trace_) structure.act(dofs_, acting_, step.number == 0);
}

void InelasticElements::push(const Step& step) {
  if (!trace_ || std::ranges::all_of(now_, [](double force) { return force == 0; })) return;
  const ScopedTimer timer(step.profile, Phase::step);
  SteppedStructure& structure = *step.structures[structure_];
  for (std::size_t k = 0; k < dofs_.size(); ++k) after_[k] = -step.share() * time_step_ * now_[k];
  trace_->restrict_to_dofs(structure.velocity().data(), velocity_.data());
  trace_->add_impulse(after_.data(), velocity_.data());
  structure.correct(trace_->dofs(), stepped_, velocity_);
}

InelasticElements::Carried InelasticElements::carried(const Step& step, std::size_t slot) const {
  Carried sum;
  for (std::size_t c = 0; c < carried_.size(); ++c) {
    const double shape = carried_[c][slot];
    sum.now += shape * step.supports.displacement[c];
    sum.next += shape * (step.supports.displacement[c] + time_step_ * step.supports.velocity[c]);
    sum.way += shape * time_step_ * step.supports.velocity_mean[c];
  }
  return sum;
}

double InelasticElements::held_by_supports(const Step& step) const {
  double energy = 0;
  for (std::size_t slot = mesh_.dof_count; slot < force_.size(); ++slot) {
    energy += force_[slot] * carried(step, slot).next / 2;
  }
  return energy;
}

void InelasticElements::finish(const Step& step) {
  const std::vector<double>& velocity = step.structures[structure_]->velocity();
  if (trace_) {
    measure(velocity, after_);
  } else {
    for (std::size_t k = 0; k < dofs_.size(); ++k) after_[k] = velocity[dofs_[k]];
  }
  double work = 0, input = 0, damped = 0, held = held_by_supports(step) - offset_;
  for (std::size_t k = 0; k < dofs_.size(); ++k) {
    const auto [now, next, by_supports] = carried(step, dofs_[k]);
    const double moved = time_step_ * after_[k];
    const double way = (moved + time_step_ * state_.velocity[k]) / 2;
    work += now_[k] * way;
    input += now_[k] * by_supports;
    damped += (acting_[k] - now_[k]) * way;
    held += now_[k] * (state_.displacement[k] + moved + next) / 2;
  }
  for (std::size_t slot = mesh_.dof_count; slot < force_.size(); ++slot) {
    input += force_[slot] * carried(step, slot).way;
  }
  LedgerPart& ledger = *step.ledger[structure_];
  ledger.link_energy_before += held_energy_;
  ledger.plastic_loss += work + input - (held - held_energy_);
  held_energy_ = held;
  ledger.damping_loss += damped;
  ledger.support_input += input;
}

std::span<const double> InelasticElements::memory_of(const Part& part) const {
  const Group& group = groups_[part.group];
  const std::size_t numbers = group.law->memory_size();
  return {group.memory.data() + part.element * numbers, numbers};
}

double InelasticElements::ductility(const Part& part) const {
  const Group& group = groups_[part.group];
  return group.law->ductility(group.first + part.element, part.number, memory_of(part));
}

PartState InelasticElements::state_of(const Part& part) const {
  const Group& group = groups_[part.group];
  return group.law->part(group.first + part.element, part.number, memory_of(part));
}

void InelasticElements::record(std::vector<std::size_t> parts) {
  records_.watch(std::move(parts));
  taken_.assign(records_.links().size(), 0.0);
}

std::vector<std::string> InelasticElements::record_names() const {
  std::vector<std::string> names;
  for (const std::size_t k : records_.links()) {
    const Part& part = parts_[k];
    names.push_back("record of " + mesh_.structure + " " +
                    std::to_string(block_of(part).tags[part.element]) + " " + name_of(part));
  }
  return names;
}

std::string InelasticElements::name_of(const Group& group, const char* numbers) const {
  const ElementBlock& block = mesh_.blocks[group.block];
  return "inelastic " + mesh_.structure + " " + block.group + " " +
         std::string(traits_of(block.type).name) + " " + numbers;
}

void InelasticElements::put_history(const Group& group, const StateKeeper& state) const {
  const ElementBlock& block = mesh_.blocks[group.block];
  const std::size_t numbers = group.law->memory_size();
  std::vector<double> rows;
  for (std::size_t e = 0; e < block.count(); ++e) {
    if (group.counted[e] == 0) continue;
    rows.push_back(static_cast<double>(block.tags[e]));
    const auto begin = group.memory.begin() + static_cast<std::ptrdiff_t>(e * numbers);
    rows.insert(rows.end(), begin, begin + static_cast<std::ptrdiff_t>(numbers));
  }
  std::vector<double> all = gather_rows(mesh_.comm, rows);
  state.table(name_of(group, "history"), all, numbers + 1);
}

void InelasticElements::take_history(Group& group, const SavedState& saved) const {
  const ElementBlock& block = mesh_.blocks[group.block];
  const std::size_t numbers = group.law->memory_size();
  const std::string name = name_of(group, "history");
  const std::vector<double>& rows = saved.table(name, numbers + 1);
  std::vector<std::pair<double, std::size_t>> lines;  // of the row of each element in the file
  for (std::size_t r = 0; r < rows.size(); r += numbers + 1) lines.emplace_back(rows[r], r + 1);
  std::ranges::sort(lines);
  for (std::size_t e = 0; e < block.count(); ++e) {
    if (trace_ && group.counted[e] == 0) continue;
    const auto tag = static_cast<double>(block.tags[e]);
    const auto found = std::ranges::lower_bound(lines, std::pair(tag, std::size_t{0}));
    if (found == lines.end() || found->first != tag) saved.refuse_values(name);
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(found->second), numbers,
                group.memory.begin() + static_cast<std::ptrdiff_t>(e * numbers));
  }
}

void InelasticElements::keep(const StateKeeper& state) {
  for (Group& group : groups_) {
    state.puts() ? put_history(group, state) : take_history(group, state.state());
  }
  state.sums(energy_name(), {&held_energy_, 1});
  if (!trace_) {
    std::vector<double> force(mesh_.owned_dofs, 0.0);
    for (std::size_t k = 0; k < dofs_.size(); ++k) force[dofs_[k]] = now_[k];
    state.dofs(structure_, "inelastic_force", force);
    for (std::size_t k = 0; k < dofs_.size(); ++k) now_[k] = force[dofs_[k]];
  }
  records_.keep(record_names(), state);
}

}  // namespace pounding::interactions
