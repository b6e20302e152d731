#include "interactions/inelastic_elements.h"

#include <algorithm>
#include <array>
#include <utility>

#include "common/gather_rows.h"
#include "elements/element_traits.h"
#include "mesh/ghost_dofs.h"

namespace pounding::interactions {
InelasticElements::InelasticElements(std::size_t structure, const Mesh& mesh,
                                     const LinearSystem& system, double time_step,
                                     std::vector<RegionLaw> laws)
    : structure_(structure),
      mesh_(mesh),
      system_(system),
      time_step_(time_step),
      laws_(std::move(laws)),
      halo_(std::make_unique<Halo>(mesh.comm, mesh.first_owned_dof, mesh.owned_dofs,
                                   ghost_dofs(mesh))),
      displacement_(mesh.dof_count, 0.0),
      force_(mesh.owned_dofs, 0.0),
      state_(0) {
  for (LocalIndex dof = 0; dof < mesh.owned_dofs; ++dof) {
    if (system.inelastic[dof] != 0) dofs_.push_back(dof);
  }
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
      for (std::size_t e = 0; e < block.count(); ++e) {
        for (std::size_t p = 0; block.counted[e] != 0 && p < entry.law->parts().size(); ++p) {
          parts_.push_back({groups_.size() - 1, e, p});
        }
      }
      for (const LocalIndex node : block.connectivity) {
        for (int c = 0; c < group.layout.components; ++c) {
          group.places.push_back(mesh.dof(node, c));
        }
      }
    }
  }
  now_.assign(dofs_.size(), 0.0);
  before_ = acting_ = now_;
  state_ = Before(dofs_.size());
}

void InelasticElements::exchange(const SteppedStructure& structure, double back) {
  const stiffness::StiffnessArgument moved{structure.displacement().data(),
                                           structure.velocity().data(), -back};
  halo_->begin(moved);
  for (const LocalIndex dof : dofs_) displacement_[dof] = moved[dof];
  halo_->end();
  for (std::size_t g = 0; g < halo_->ghost_count(); ++g) {
    displacement_[mesh_.owned_dofs + g] = halo_->ghosts()[halo_->place(g)];
  }
}

double InelasticElements::respond() {
  double offset = 0;
  for (const LocalIndex dof : dofs_) force_[dof] = 0;
  std::array<double, max_element_size> u{};
  std::array<double, max_element_size> f{};
  for (Group& group : groups_) {
    const std::size_t size = group.layout.size();
    const std::size_t numbers = group.law->memory_size();
    const ElementBlock& block = mesh_.blocks[group.block];
    for (std::size_t e = 0; e < block.count(); ++e) {
      const LocalIndex* const place = &group.places[e * size];
      for (std::size_t i = 0; i < size; ++i) u[i] = place[i] < 0 ? 0 : displacement_[place[i]];
      const double held =
          group.law->respond(group.first + e, {u.data(), size},
                             {group.memory.data() + e * numbers, numbers}, {f.data(), size});
      if (block.counted[e] != 0) offset += held;
      for (std::size_t i = 0; i < size; ++i) {
        if (place[i] >= 0 && place[i] < mesh_.owned_dofs) force_[place[i]] += f[i];
      }
    }
  }
  return offset;
}

void InelasticElements::begin(const Step& step) {
  const ScopedTimer timer(step.profile, Phase::step);
  SteppedStructure& structure = *step.structures[structure_];
  structure.remember(dofs_, state_);
  const bool first = step.number == 0;
  if (first) {  // f_{-1}, of which no history is kept
    std::vector<std::vector<double>> kept;
    for (const Group& group : groups_) kept.push_back(group.memory);
    exchange(structure, time_step_);
    offset_ = respond();
    for (std::size_t k = 0; k < dofs_.size(); ++k) now_[k] = force_[dofs_[k]];
    for (std::size_t g = 0; g < groups_.size(); ++g) groups_[g].memory = kept[g];
  }
  before_ = now_;
  offset_before_ = offset_;
  for (std::size_t k = 0; k < taken_.size(); ++k) {
    taken_[k] = state_of(parts_[records_.links()[k]]).taken;
  }
  exchange(structure, 0);
  offset_ = respond();
  for (std::size_t k = 0; k < taken_.size(); ++k) {
    const PartState part = state_of(parts_[records_.links()[k]]);
    records_.note(k, part.elongation, part.force, part.ductility > 1);
    records_.add_work(k, part.taken - taken_[k]);
  }
  const double lag = system_.damping.beta / time_step_;
  for (std::size_t k = 0; k < dofs_.size(); ++k) {
    now_[k] = force_[dofs_[k]];
    acting_[k] = now_[k] + lag * (now_[k] - before_[k]);
  }
  structure.act(dofs_, acting_, first);
}

void InelasticElements::finish(const Step& step) {
  const std::vector<double>& velocity = step.structures[structure_]->velocity();
  double work = 0, held_before = -offset_before_, held = -offset_;
  for (std::size_t k = 0; k < dofs_.size(); ++k) {
    const double u = state_.displacement[k];
    const double moved = time_step_ * velocity[dofs_[k]];
    work += acting_[k] * (moved + time_step_ * state_.velocity[k]) / 2;
    held_before += before_[k] * u / 2;
    held += now_[k] * (u + moved) / 2;
  }
  LedgerPart& ledger = *step.ledger[structure_];
  ledger.link_energy_before += held_before;
  ledger.plastic_loss += work - (held - held_before);
}

PartState InelasticElements::state_of(const Part& part) const {
  const Group& group = groups_[part.group];
  const std::size_t numbers = group.law->memory_size();
  return group.law->part(group.first + part.element, part.number,
                         {group.memory.data() + part.element * numbers, numbers});
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

void InelasticElements::save(SavedState& saved) const {
  for (const Group& group : groups_) {
    const ElementBlock& block = mesh_.blocks[group.block];
    const std::size_t numbers = group.law->memory_size();
    std::vector<double> rows;
    for (std::size_t e = 0; e < block.count(); ++e) {
      if (block.counted[e] == 0) continue;
      rows.push_back(static_cast<double>(block.tags[e]));
      const auto begin = group.memory.begin() + static_cast<std::ptrdiff_t>(e * numbers);
      rows.insert(rows.end(), begin, begin + static_cast<std::ptrdiff_t>(numbers));
    }
    saved.put(name_of(group, "history"), gather_rows(mesh_.comm, rows), numbers + 1);
  }
  std::vector<double> force(mesh_.owned_dofs, 0.0);
  for (std::size_t k = 0; k < dofs_.size(); ++k) force[dofs_[k]] = now_[k];
  saved.put_dofs(static_cast<int>(structure_), "inelastic_force", force);
  saved.put_sums("inelastic " + mesh_.structure + " offset", {&offset_, 1});
  records_.save(record_names(), saved);
}

void InelasticElements::load(const SavedState& saved) {
  for (Group& group : groups_) {
    const ElementBlock& block = mesh_.blocks[group.block];
    const std::size_t numbers = group.law->memory_size();
    const std::string name = name_of(group, "history");
    const std::vector<double>& rows = saved.table(name, numbers + 1);
    std::vector<std::pair<double, std::size_t>> place;  // of the row of each element in the file
    for (std::size_t r = 0; r < rows.size(); r += numbers + 1) place.emplace_back(rows[r], r + 1);
    std::ranges::sort(place);
    for (std::size_t e = 0; e < block.count(); ++e) {
      const auto tag = static_cast<double>(block.tags[e]);
      const auto found = std::ranges::lower_bound(place, std::pair(tag, std::size_t{0}));
      if (found == place.end() || found->first != tag) saved.refuse_values(name);
      std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(found->second), numbers,
                  group.memory.begin() + static_cast<std::ptrdiff_t>(e * numbers));
    }
  }
  std::vector<double> force(mesh_.owned_dofs);
  saved.get_dofs(static_cast<int>(structure_), "inelastic_force", force);
  for (std::size_t k = 0; k < dofs_.size(); ++k) now_[k] = force[dofs_[k]];
  saved.get_sums("inelastic " + mesh_.structure + " offset", {&offset_, 1});
  records_.load(record_names(), saved);
}

}  // namespace pounding::interactions
