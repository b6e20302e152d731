#include "system/rigid_body.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "common/matrix3.h"
#include "system/six_by_six.h"

namespace pounding {
namespace {

/// Part of a column that the others leave, at which it is one of them.
constexpr double dependent = 1e-8;

using Columns = std::vector<std::vector<double>>;

double norm(const std::vector<double>& a) {
  return std::sqrt(std::inner_product(a.begin(), a.end(), a.begin(), 0.0));
}

/// Orthonormal columns of the same space; dependent ones are left out.
Columns orthonormal(Columns columns) {
  Columns kept;
  for (std::vector<double>& column : columns) {
    const double before = norm(column);
    for (int repeat = 0; repeat < 2; ++repeat) {
      for (const std::vector<double>& other : kept) {
        const double part = std::inner_product(column.begin(), column.end(), other.begin(), 0.0);
        for (std::size_t i = 0; i < column.size(); ++i) column[i] -= part * other[i];
      }
    }
    const double length = norm(column);
    if (!(length > dependent * before)) continue;
    for (double& value : column) value /= length;
    kept.push_back(std::move(column));
  }
  return kept;
}

NodeDofs dofs_of(const Mesh& mesh, LocalIndex node) {
  return {mesh.first_dof[node], component_count(mesh.free_components[node])};
}

/// Place of a component among a node's dofs; -1 if it has none.
int dof_place(const Mesh& mesh, LocalIndex node, int component) {
  const LocalIndex dof = mesh.dof(node, component);
  return dof < 0 ? -1 : static_cast<int>(dof - mesh.first_dof[node]);
}

}  // namespace

RigidBody::RigidBody(const Mesh& mesh, const RigidPart& part, std::span<const double> lumped_mass) {
  const std::size_t places = width * part.nodes.size();
  root_mass_.assign(places, 0.0);
  alone_.assign(places, 0.0);
  for (const LocalIndex node : part.nodes) {
    const std::size_t n = node;
    const std::size_t begin = width * nodes_.size();
    nodes_.push_back({mesh.first_dof[n], component_count(mesh.free_components[n])});
    for (int i = 0; i < nodes_.back().count; ++i) {
      const std::size_t place = begin + static_cast<std::size_t>(i);
      root_mass_[place] = std::sqrt(lumped_mass[nodes_.back().begin + i]);
      alone_[place] = 1 / lumped_mass[nodes_.back().begin + i];
    }
    for (int c = 0; c < 6; ++c) {
      const LocalIndex dof = mesh.dof(node, c);
      if (dof < 0 || !mesh.follows(node, c)) continue;
      dofs_.push_back(dof);
      slots_.push_back(begin + static_cast<std::size_t>(dof - nodes_.back().begin));
      alone_[slots_.back()] = 0;
    }
  }
  find_motions(mesh, part);
}

void RigidBody::find_motions(const Mesh& mesh, const RigidPart& part) {
  Vector3 centre{0, 0, 0};
  for (const LocalIndex node : part.nodes) {
    const Vector3 x = mesh.position(node);
    for (std::size_t d = 0; d < 3; ++d) {
      centre[d] += x[d] / static_cast<double>(part.nodes.size());
    }
  }
  Columns columns;
  for (int motion = 0; motion < 6; ++motion) {
    if ((part.components >> motion & 1) == 0) continue;
    std::vector<double>& column = columns.emplace_back();
    for (const LocalIndex node : part.nodes) {
      Vector3 x = mesh.position(node);
      for (std::size_t d = 0; d < 3; ++d) x[d] -= centre[d];
      for (int c = 0; c < 6; ++c) {
        if (mesh.dof(node, c) < 0 || !mesh.follows(node, c)) continue;
        column.push_back(root_mass_[slots_[column.size()]] *
                         rigid_motion_row(static_cast<std::size_t>(c), x)[motion]);
      }
    }
  }
  columns = orthonormal(std::move(columns));
  motions_ = columns.size();
  rows_.assign(nodes_.size(), {});
  columns_.assign(nodes_.size(), {});
  for (std::size_t k = 0; k < slots_.size(); ++k) {
    const std::size_t node = slots_[k] / width;
    const std::size_t place = slots_[k] % width;
    for (std::size_t m = 0; m < motions_; ++m) {
      const double value = columns[m][k] / root_mass_[slots_[k]];
      rows_[node][width * place + m] = value;
      columns_[node][width * m + place] = value;
    }
  }
}

RigidBody::Motion RigidBody::coordinates(const double* x) const {
  Six sums[2];
  for (const NodeBlock& rows : rows_) {
    accumulate<false>(rows.data(), x, sums);
    x += width;
  }
  Motion q;
  store_six(q.data(), sum(sums));
  return q;
}

void RigidBody::move(const Motion& q, double* x) const {
  const double* alone = alone_.data();
  for (const NodeBlock& columns : columns_) {
    Six y[2];
    Six own;
    Six inverse;
    load_six(x, own);
    load_six(alone, inverse);
    y[0].low = inverse.low * own.low;
    y[0].high = inverse.high * own.high;
    accumulate<false>(columns.data(), q.data(), y);
    store_six(x, sum(y));
    x += width;
    alone += width;
  }
}

void RigidBody::scale(double* x) const {
  for (std::size_t i = 0; i < root_mass_.size(); ++i) x[i] *= root_mass_[i];
}

void RigidBody::solve_half(double* x) const {
  solve(x);
  scale(x);
}

void RigidBody::solve_transposed_half(double* x) const {
  scale(x);
  solve(x);
}

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
