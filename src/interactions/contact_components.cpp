#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "common/parallel.h"
#include "interactions/contact_problem.h"

namespace pounding::interactions {
namespace {

/// Components that follow each other are counted by the same rank, so that their values share
/// cache lines.
constexpr std::size_t counted_at_once = 64;

/// Rows of one rank from which on components are shared: of fewer, the waiting costs more.
constexpr std::size_t least_share = 200;

}  // namespace

std::vector<ContactProblem::Holders> ContactProblem::find_holders(
    std::span<const std::vector<int>> components, std::span<const std::vector<int>> row_dofs) {
  alike_ = true;
  if (!member() || sliding_.any()) return {components.size(), Holders{0, 0, 1, member()}};
  std::vector<Holders> found(components.size());
  const int me = rank_of(comm());
  std::vector<int> first(components.size(), 0);  // and minus the last member that holds each
  std::vector<int> last(components.size(), 0);
  std::vector<int> count(components.size(), 0);
  for (std::size_t c = 0; c < components.size(); ++c) {
    bool holds = row_dofs[components[c].front()].empty() && me == 0;  // nothing of it moves
    for (const int row : components[c]) {
      holds = holds ||
              std::ranges::any_of(row_dofs[row], [this](int dof) { return interface_.knows(dof); });
    }
    found[c].here = holds;
    first[c] = holds ? me : members();
    last[c] = holds ? -me : members();
    count[c] = holds ? 1 : 0;
  }
  reduce_over_ranks(comm(), MPI_MIN, first, last);
  reduce_over_ranks(comm(), MPI_SUM, count);
  for (std::size_t c = 0; c < components.size(); ++c) {
    found[c] = {first[c], -last[c], count[c], found[c].here};
    alike_ = alike_ && count[c] == members();
  }
  return found;
}

std::unique_ptr<SharedRows> ContactProblem::share_of(const std::vector<int>& rows,
                                                     const Holders& holders, Building& building) {
  const std::size_t shares = holders.count;
  if (shares < 2 || rows.size() < least_share * shares) return nullptr;
  alike_ = false;
  std::vector<int> known;
  std::vector<std::vector<int>> coupled;
  for (std::size_t i = 0; holders.here && i < rows.size(); ++i) {
    known.push_back(static_cast<int>(std::ranges::count_if(
        building.row_dofs[rows[i]], [this](int dof) { return interface_.knows(dof); })));
    coupled.push_back(building.pattern.coupled_with({&rows[i], 1}));
    for (int& other : coupled.back()) other = building.number[other];
  }
  auto share = std::make_unique<SharedRows>(comm(), holders.here, rows, known, coupled);
  for (std::size_t i = 0; i < share->number().size(); ++i) {
    building.number[rows[i]] = share->number()[i];
  }
  return share;
}

void ContactProblem::build_rows(Component& component, Building& building) {
  SparseRows& delassus = component.delassus;
  std::vector<std::pair<int, double>> entries;
  for (const int row : component.rows) {
    entries.clear();
    for (const int column : building.pattern.coupled_with({&row, 1})) {
      entries.emplace_back(building.number[column],
                           delassus_entry(interface_.rows(), interface_.compliance(), row, column));
    }
    std::ranges::sort(entries);
    for (const auto& [column, value] : entries) delassus.add(column, value);
    delassus.end_row();
  }
  SharedRows* const share = component.share.get();
  if (share != nullptr) {
    component.many = std::make_unique<ProportioningSolver>(std::move(delassus), share->first(),
                                                           share->numbers(), share);
    component.numbered.resize(share->numbers());
  } else if (component.rows.size() > CoupledLcp::most_dense_rows) {
    component.many = std::make_unique<ProportioningSolver>(std::move(delassus));
  }
}

void ContactProblem::add_component(const std::vector<int>& rows, const Holders& holders,
                                   bool counts, Building& building) {
  const bool slides =
      std::ranges::any_of(rows, [this](int row) { return friction_.has_friction(row); });
  for (std::size_t i = 0; i < rows.size(); ++i) building.number[rows[i]] = static_cast<int>(i);
  Component component;
  if (member() && !slides) component.share = share_of(rows, holders, building);
  if (!holders.here) return;
  component.rows = component.share ? component.share->rows() : rows;
  held_.insert(held_.end(), component.rows.begin(), component.rows.end());
  if (counts || component.share) {
    counted_.insert(counted_.end(), component.rows.begin(), component.rows.end());
  }
  for (const int row : component.rows) {
    const std::vector<int>& dofs = building.row_dofs[row];
    building.wanted.insert(dofs.begin(), dofs.end());
  }
  if (rows.size() == 1 && !slides) {
    lone_.push_back(rows.front());
    return;
  }
  if (slides) {
    component.frictional = static_cast<int>(friction_.add(component.rows, building.pattern));
  } else {
    build_rows(component, building);
  }
  components_.push_back(std::move(component));
}

void ContactProblem::find_components() {
  for (auto* const rows_here : {&held_, &counted_, &lone_}) rows_here->clear();
  components_.clear();
  friction_.forget_components();
  coupled_rows_ = 0;
  Building building{{interface_.rows(), interface_.compliance()}, {}, {}, {}};
  building.number.assign(interface_.rows().rows(), -1);
  std::vector<std::vector<int>> row_groups;
  for (int row = 0; row < rows(); ++row) {
    std::vector<int>& dofs = building.row_dofs.emplace_back();
    const auto add_dofs = [&](int operator_row) {
      const auto more = interface_.rows().row_dofs(operator_row);
      dofs.insert(dofs.end(), more.begin(), more.end());
    };
    add_dofs(row);
    if (friction_.has_friction(row)) {
      add_dofs(friction_.tangent(row));
      add_dofs(friction_.tangent(row) + 1);
    }
    std::vector<int>& groups = row_groups.emplace_back(dofs);
    for (int& dof : groups) dof = interface_.compliance().group_of(static_cast<std::size_t>(dof));
  }
  const std::vector<std::vector<int>> all =
      coupled_components(row_groups, interface_.rows().dofs());
  const std::vector<Holders> holders = find_holders(all, building.row_dofs);
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (all[c].size() > 1) coupled_rows_ += static_cast<int>(all[c].size());
    // Both sides have their share, in turns.
    const int counter = c / counted_at_once % 2 == 0 ? holders[c].first : holders[c].last;
    add_component(all[c], holders[c], member() && rank_of(comm()) == counter, building);
  }
  for (auto* const rows_here : {&held_, &counted_}) std::ranges::sort(*rows_here);
  if (member() && !sliding_.any()) {
    interface_.want(std::vector<int>(building.wanted.begin(), building.wanted.end()));
  }
  friction_.reserve();
  std::size_t largest = 1;
  for (const Component& component : components_) {
    largest = std::max(largest, component.rows.size());
  }
  active_indices_.reserve(largest);
  for (auto* const room : {&rate_, &solution_, &increment_}) room->resize(largest);
  if (largest > 1) lcp_ = std::make_unique<CoupledLcp>(largest);
}

}  // namespace pounding::interactions
