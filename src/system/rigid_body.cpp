#include "system/rigid_body.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/rigid_motion.h"
#include "system/six_lanes.h"

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
      if (dof < 0 || (part.components >> c & 1) == 0) continue;
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
        if (mesh.dof(node, c) < 0 || (part.components >> c & 1) == 0) continue;
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

void RigidBody::solve(double* x) const {
  move(coordinates(x), x);
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

}  // namespace pounding
