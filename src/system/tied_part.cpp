#include "system/tied_part.h"

#include <algorithm>
#include <set>

#include "system/six_lanes.h"

namespace pounding {
namespace {

NodeDofs dofs_of(const Mesh& mesh, LocalIndex node) {
  return {mesh.first_dof[node], component_count(mesh.free_components[node])};
}

/// Place of a component among a node's dofs; -1 if it has none.
int dof_place(const Mesh& mesh, LocalIndex node, int component) {
  const LocalIndex dof = mesh.dof(node, component);
  return dof < 0 ? -1 : static_cast<int>(dof - mesh.first_dof[node]);
}

}  // namespace

TiedPart::TiedPart(const Mesh& mesh, const RigidPart& part, std::span<const double> lumped_mass)
    : factor_(lumped_mass, (find_nodes(mesh, part), followers_mass(lumped_mass))) {
  // Fields go by the order of elimination.
  std::vector<NodeDofs> nodes = nodes_;
  for (std::size_t c = 0; c < carriers_; ++c) nodes[factor_.order(c)] = nodes_[c];
  nodes_ = std::move(nodes);
  for (Term& term : terms_) term.carrier = factor_.order(term.carrier);
}

void TiedPart::find_nodes(const Mesh& mesh, const RigidPart& part) {
  std::set<LocalIndex> followers;
  for (const TiedNode& tied : part.tied) followers.insert(mesh.owned_node(tied.node));
  for (const LocalIndex node : part.nodes) {
    if (followers.contains(node) || dofs_of(mesh, node).count == 0) continue;
    local_.push_back(node);
    nodes_.push_back(dofs_of(mesh, node));
  }
  carriers_ = nodes_.size();
  for (const TiedNode& tied : part.tied) {
    const NodeDofs dofs = dofs_of(mesh, mesh.owned_node(tied.node));
    if (dofs.count == 0) continue;
    nodes_.push_back(dofs);
    first_term_.push_back(terms_.size());
    add_terms(mesh, tied);
  }
  first_term_.push_back(terms_.size());
}

void TiedPart::add_terms(const Mesh& mesh, const TiedNode& tied) {
  const LocalIndex follower = mesh.owned_node(tied.node);
  for (const Carrier& carrier : tied.carriers) {
    const LocalIndex node = mesh.owned_node(carrier.node);
    const auto found = std::ranges::lower_bound(local_, node);
    if (found == local_.end() || *found != node) continue;  // clamped altogether
    Term& term = terms_.emplace_back();
    term.carrier = static_cast<std::size_t>(found - local_.begin());
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) {
        const int row = dof_place(mesh, follower, i);
        const int column = dof_place(mesh, node, j);
        if (row < 0 || column < 0) continue;
        const double value =
            carrier.block[6 * static_cast<std::size_t>(i) + static_cast<std::size_t>(j)];
        term.block[width * static_cast<std::size_t>(column) + static_cast<std::size_t>(row)] =
            value;
        term.transposed[width * static_cast<std::size_t>(row) + static_cast<std::size_t>(column)] =
            value;
      }
    }
  }
}

NodeBlocks TiedPart::followers_mass(std::span<const double> lumped_mass) const {
  NodeBlocks mass;
  mass.nodes.assign(nodes_.begin(), nodes_.begin() + static_cast<std::ptrdiff_t>(carriers_));
  for (std::size_t t = 0; t + 1 < first_term_.size(); ++t) {
    const NodeDofs& dofs = nodes_[carriers_ + t];
    for (std::size_t a = first_term_[t]; a < first_term_[t + 1]; ++a) {
      for (std::size_t b = first_term_[t]; b < first_term_[t + 1]; ++b) {
        if (terms_[a].carrier < terms_[b].carrier) continue;
        NodeBlock& block =
            mass.blocks[{static_cast<int>(terms_[a].carrier), static_cast<int>(terms_[b].carrier)}];
        for (std::size_t i = 0; i < width; ++i) {
          for (std::size_t j = 0; j < width; ++j) {
            for (std::size_t k = 0; k < static_cast<std::size_t>(dofs.count); ++k) {
              block[width * i + j] += terms_[a].block[width * i + k] *
                                      lumped_mass[static_cast<std::size_t>(dofs.begin) + k] *
                                      terms_[b].block[width * j + k];
            }
          }
        }
      }
    }
  }
  return mass;
}

void TiedPart::collect(double* x) const {
  for (std::size_t t = 0; t + 1 < first_term_.size(); ++t) {
    double* const own = x + width * (carriers_ + t);
    for (std::size_t k = first_term_[t]; k < first_term_[t + 1]; ++k) {
      double* const carrier = x + width * terms_[k].carrier;
      Six y[2];
      load_six(carrier, y[0]);
      accumulate<false>(terms_[k].transposed.data(), own, y);
      store_six(carrier, sum(y));
    }
    std::fill_n(own, width, 0.0);
  }
}

void TiedPart::spread(double* x) const {
  for (std::size_t t = 0; t + 1 < first_term_.size(); ++t) {
    Six y[2];
    for (std::size_t k = first_term_[t]; k < first_term_[t + 1]; ++k) {
      accumulate<false>(terms_[k].block.data(), x + width * terms_[k].carrier, y);
    }
    store_six(x + width * (carriers_ + t), sum(y));
  }
}

void TiedPart::solve(double* x) const {
  collect(x);
  factor_.solve(x);
  spread(x);
}

void TiedPart::solve_half(double* x) const {
  collect(x);
  factor_.solve_half(x);
}

void TiedPart::solve_transposed_half(double* x) const {
  factor_.solve_transposed_half(x);
  spread(x);
}

}  // namespace pounding
