#include "system/coupled_mass.h"

#include <algorithm>
#include <map>
#include <utility>

namespace pounding {

CoupledMass::CoupledMass(std::span<const double> lumped_mass, NodeBlocks added,
                         std::vector<RigidBody> bodies, std::vector<TiedPart> ties,
                         std::vector<AddedMass> waters)
    : added_(std::move(added)),
      factor_(lumped_mass, added_),
      bodies_(std::move(bodies)),
      ties_(std::move(ties)),
      waters_(std::move(waters)) {
  number_nodes();
}

void CoupledMass::number_nodes() {
  std::map<LocalIndex, std::pair<NodeDofs, std::size_t>> places;  // by first dof
  for (std::size_t n = 0; n < added_.nodes.size(); ++n) {
    places[added_.nodes[n].begin] = {added_.nodes[n], factor_.order(n)};
  }
  std::size_t next = added_.nodes.size();
  const auto place_part = [&](const std::vector<NodeDofs>& part) {
    first_node_.push_back(next);
    for (const NodeDofs& node : part) places[node.begin] = {node, next++};
  };
  for (const RigidBody& body : bodies_) place_part(body.nodes());
  for (const TiedPart& tie : ties_) place_part(tie.nodes());
  for (const AddedMass& water : waters_) place_part(water.nodes());
  for (const auto& [begin, entry] : places) {
    nodes_.push_back(entry.first);
    number_.push_back(entry.second);
  }
}

int CoupledMass::part_of(std::size_t node) const {
  const auto after = std::ranges::upper_bound(first_node_, number_[node]);
  return static_cast<int>(after - first_node_.begin()) - 1;
}

int CoupledMass::node_of(LocalIndex dof) const {
  const auto after =
      std::upper_bound(nodes().begin(), nodes().end(), dof,
                       [](LocalIndex d, const NodeDofs& node) { return d < node.begin; });
  if (after == nodes().begin() || dof >= (after - 1)->begin + (after - 1)->count) return -1;
  return static_cast<int>(after - 1 - nodes().begin());
}

template <typename Function>
void CoupledMass::for_each_part(double* x, Function&& function) const {
  auto first = first_node_.begin();
  for (const RigidBody& body : bodies_) function(body, x + width * *first++);
  for (const TiedPart& tie : ties_) function(tie, x + width * *first++);
  for (const AddedMass& water : waters_) function(water, x + width * *first++);
}

void CoupledMass::solve(double* x) const {
  factor_.solve(x);
  for_each_part(x, [](const auto& part, double* place) { part.solve(place); });
}

void CoupledMass::solve(double* x, const Parts& parts) const {
  if (parts.added) factor_.solve(x);
  for (const std::size_t p : parts.others) {
    double* const place = x + width * first_node_[p];
    if (p < bodies_.size()) {
      bodies_[p].solve(place);
    } else if (p - bodies_.size() < ties_.size()) {
      ties_[p - bodies_.size()].solve(place);
    } else {
      waters_[p - bodies_.size() - ties_.size()].solve(place);
    }
  }
}

void CoupledMass::solve_half(double* x) const {
  factor_.solve_half(x);
  for_each_part(x, [](const auto& part, double* place) { part.solve_half(place); });
}

void CoupledMass::solve_transposed_half(double* x) const {
  factor_.solve_transposed_half(x);
  for_each_part(x, [](const auto& part, double* place) { part.solve_transposed_half(place); });
}

void CoupledMass::take(const double* owned, double* x) const {
  for (std::size_t n = 0; n < nodes().size(); ++n) {
    const std::size_t begin = nodes()[n].begin, count = nodes()[n].count;
    for (std::size_t c = 0; c < width; ++c) x[offset(n) + c] = c < count ? owned[begin + c] : 0;
  }
}

void CoupledMass::put(const double* x, double* owned) const {
  for (std::size_t n = 0; n < nodes().size(); ++n) {
    std::copy_n(x + offset(n), nodes()[n].count, owned + nodes()[n].begin);
  }
}

double CoupledMass::added_product(const double* v) const {
  double total = 0;
  for (const AddedMass& water : waters_) total += water.added_product(v);
  for (const auto& [pair, block] : added_.blocks) {
    const NodeDofs& row = added_.nodes[pair[0]];
    const NodeDofs& column = added_.nodes[pair[1]];
    double product = 0;
    for (int i = 0; i < row.count; ++i) {
      for (int j = 0; j < column.count; ++j) {
        product += v[row.begin + i] *
                   block[static_cast<std::size_t>(i) * width + static_cast<std::size_t>(j)] *
                   v[column.begin + j];
      }
    }
    total += pair[0] == pair[1] ? product : 2 * product;
  }
  return total;
}

}  // namespace pounding
