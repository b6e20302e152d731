#include "interactions/shared_rows.h"

#include <algorithm>
#include <iterator>

#include "common/lanes.h"
#include "common/parallel.h"
#include "mesh/element_graph.h"

namespace pounding::interactions {
namespace {

/// Cuts a group into so many parts, none of them empty; per row its part.
std::vector<idx_t> cut(std::span<const std::vector<int>> coupled, int parts) {
  if (parts == 1) return std::vector<idx_t>(coupled.size(), 0);
  Graph graph;
  for (std::size_t i = 0; i < coupled.size(); ++i) {
    std::ranges::copy_if(coupled[i], std::back_inserter(graph.neighbours),
                         [i](int other) { return other != static_cast<int>(i); });
    graph.first.push_back(static_cast<idx_t>(graph.neighbours.size()));
  }
  graph.weights.assign(graph.neighbours.size(), 1);
  std::vector<idx_t> cost(coupled.size(), 1);
  long edge_cut = 0;
  std::vector<idx_t> part = cut_graph(graph, cost, parts, edge_cut);
  const auto rows = static_cast<idx_t>(part.size());
  for (idx_t p = 0; p < parts; ++p) {
    if (std::ranges::count(part, p) > 0) continue;
    for (idx_t i = 0; i < rows; ++i) part[i] = i * parts / rows;
    break;
  }
  return part;
}

/// The rank of each part, of those that are `free` one that knows many of its dofs. Collective over
/// `comm`.
std::vector<int> ranks_of_parts(MPI_Comm comm, std::vector<int> free, std::span<const idx_t> part,
                                std::span<const int> known) {
  const auto ranks = static_cast<int>(free.size());
  std::vector<int> knows(free.size() * free.size(), 0);  // by part and rank
  for (std::size_t i = 0; i < part.size(); ++i) knows[part[i] * ranks + rank_of(comm)] += known[i];
  reduce_over_ranks(comm, MPI_SUM, knows);
  std::vector<int> taken(std::ranges::count(free, 1), -1);
  for (std::size_t p = 0; p < taken.size(); ++p) {
    const int* const of_part = &knows[p * free.size()];
    for (int rank = 0; rank < ranks; ++rank) {
      if (free[rank] != 0 && (taken[p] < 0 || of_part[rank] > of_part[taken[p]])) taken[p] = rank;
    }
    free[taken[p]] = 0;
  }
  return taken;
}

}  // namespace

SharedRows::SharedRows(MPI_Comm comm, bool holds, const std::vector<int>& rows,
                       std::span<const int> known, std::span<const std::vector<int>> coupled) {
  const int me = rank_of(comm);
  std::vector<int> holders(size_of(comm), 0);
  holders[me] = holds ? 1 : 0;
  reduce_over_ranks(comm, MPI_SUM, holders);
  const int parts = static_cast<int>(std::ranges::count(holders, 1));
  const std::vector<idx_t> part = holds ? cut(coupled, parts) : std::vector<idx_t>{};
  const std::vector<int> taken = ranks_of_parts(comm, holders, part, known);
  std::vector<int> mine, near, felt;  // numbers
  if (holds) {
    number_rows(rows, part, taken, me);
    const auto other = [&](std::size_t i) { return taken[part[i]] != me; };
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const bool crosses =
          std::ranges::any_of(coupled[i], [&](int j) { return other(j) != other(i); });
      if (!other(i)) mine.push_back(number_[i]);
      // A rank with none at a border takes part in sums.
      if (!other(i) && (crosses || border_.empty())) border_.push_back(number_[i]);
      if (!other(i) || !(crosses || known[i] > 0)) continue;
      if (crosses) near.push_back(number_[i]);
      felt.push_back(number_[i]);
      felt_.push_back({rows[i], static_cast<std::size_t>(number_[i])});
    }
  }
  near_ = std::make_unique<InterfaceGather>(comm, border_);
  all_ = std::make_unique<InterfaceGather>(comm, mine);
  if (!holds) return;
  near_->want(near);
  all_->want(felt);
  sent_.resize(mine.size());
}

void SharedRows::number_rows(const std::vector<int>& rows, std::span<const int> part,
                             std::span<const int> rank_of_part, int me) {
  number_.resize(rows.size());
  for (std::size_t p = 0; p < rank_of_part.size(); ++p) {
    if (rank_of_part[p] == me) first_ = numbers_;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (part[i] != static_cast<int>(p)) continue;
      number_[i] = static_cast<int>(numbers_++);
      if (rank_of_part[p] == me) rows_.push_back(rows[i]);
    }
    numbers_ = (numbers_ + most_lanes - 1) / most_lanes * most_lanes;
  }
}

void SharedRows::bring(std::span<double> values) {
  for (std::size_t k = 0; k < border_.size(); ++k) sent_[k] = values[border_[k]];
  near_->gather(1, {sent_.data(), border_.size()}, values);
}

void SharedRows::bring_felt(std::span<double> values) {
  std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(first_), rows_.size(), sent_.begin());
  all_->gather(1, {sent_.data(), rows_.size()}, values);
}

}  // namespace pounding::interactions
