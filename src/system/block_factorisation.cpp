#include "system/block_factorisation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "system/six_by_six.h"

namespace pounding {
namespace {

constexpr std::size_t width = BlockFactorisation::width;

/// x[place] = B x[place].
void multiply(const NodeBlock& block, double* x) {
  Six y[2];
  accumulate<false>(block.data(), x, y);
  store_six(x, sum(y));
}

NodeBlock transposed(const NodeBlock& a) {
  NodeBlock result;
  for (std::size_t i = 0; i < width; ++i) {
    for (std::size_t j = 0; j < width; ++j) result[j * width + i] = a[i * width + j];
  }
  return result;
}

/// A B^T, all row by row.
NodeBlock product_with_transposed(const NodeBlock& a, const NodeBlock& b) {
  NodeBlock result{};
  for (std::size_t i = 0; i < width; ++i) {
    for (std::size_t j = 0; j < width; ++j) {
      for (std::size_t k = 0; k < width; ++k) {
        result[i * width + j] += a[i * width + k] * b[j * width + k];
      }
    }
  }
  return result;
}

/// R^-1 row by row, D = R R^T.
NodeBlock inverse_cholesky(const NodeBlock& d) {
  NodeBlock root{};
  NodeBlock inverse{};
  for (std::size_t i = 0; i < width; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double value = d[i * width + j];
      for (std::size_t k = 0; k < j; ++k) value -= root[i * width + k] * root[j * width + k];
      if (i == j && !(value > 0)) {
        throw std::runtime_error("a mass matrix is not positive definite");
      }
      root[i * width + j] = i == j ? std::sqrt(value) : value / root[j * width + j];
    }
  }
  for (std::size_t j = 0; j < width; ++j) {
    for (std::size_t i = j; i < width; ++i) {
      double value = i == j ? 1 : 0;
      for (std::size_t k = j; k < i; ++k) value -= root[i * width + k] * inverse[k * width + j];
      inverse[i * width + j] = value / root[i * width + i];
    }
  }
  return inverse;
}

}  // namespace

std::optional<Elimination> eliminate(std::vector<std::set<int>> neighbours, std::size_t most) {
  Elimination result;
  result.columns.resize(neighbours.size());
  std::vector<int> left(neighbours.size());
  std::iota(left.begin(), left.end(), 0);
  std::vector<char> waits(neighbours.size(), 0);
  std::size_t entries = 0;
  for (const std::set<int>& around : neighbours) entries += around.size();
  if (entries / 2 > most) return std::nullopt;
  entries = 0;
  while (!left.empty()) {
    std::size_t smallest = std::numeric_limits<std::size_t>::max();
    for (const int v : left) {
      smallest = std::min(smallest, neighbours[v].size());
      waits[v] = 0;
    }
    std::vector<int> rest;
    for (const int v : left) {
      const std::set<int>& around = neighbours[v];
      if (waits[v] != 0 || around.size() > smallest) {
        rest.push_back(v);
        continue;
      }
      entries += around.size();
      if (entries > most) return std::nullopt;
      for (const int a : around) {
        waits[a] = 1;
        auto& others = neighbours[a];
        others.erase(v);
        others.insert(around.begin(), around.end());
        others.erase(a);
      }
      result.order.push_back(v);
      result.columns[v].assign(around.begin(), around.end());
    }
    left = std::move(rest);
  }
  return result;
}

namespace {

/// Blocks of a matrix by column and row.
using BlockColumns = std::vector<std::map<std::size_t, NodeBlock>>;

/// M + S, columns and rows by their places in an order of the nodes, lower triangle.
BlockColumns lower_triangle(std::span<const double> lumped_mass, const NodeBlocks& added,
                            std::span<const std::size_t> order) {
  const std::size_t count = added.nodes.size();
  BlockColumns columns(count);
  for (std::size_t n = 0; n < count; ++n) {
    NodeBlock& diagonal = columns[order[n]][order[n]];
    diagonal = {};
    for (std::size_t i = 0; i < width; ++i) {
      const auto dof = static_cast<std::size_t>(added.nodes[n].begin) + i;
      diagonal[i * width + i] =
          i < static_cast<std::size_t>(added.nodes[n].count) ? lumped_mass[dof] : 1;
    }
  }
  for (const auto& [pair, block] : added.blocks) {
    const std::size_t row = order[pair[0]];
    const std::size_t column = order[pair[1]];
    NodeBlock& entry = columns[std::min(row, column)][std::max(row, column)];
    const NodeBlock values = row >= column ? block : transposed(block);
    for (std::size_t i = 0; i < values.size(); ++i) entry[i] += values[i];
  }
  return columns;
}

}  // namespace

BlockFactorisation::BlockFactorisation(std::span<const double> lumped_mass,
                                       const NodeBlocks& added) {
  const std::size_t count = added.nodes.size();
  std::vector<std::set<int>> neighbours(count);
  for (const auto& [pair, block] : added.blocks) {
    if (pair[0] != pair[1]) {
      neighbours[pair[0]].insert(pair[1]);
      neighbours[pair[1]].insert(pair[0]);
    }
  }
  const Elimination elimination =
      *eliminate(std::move(neighbours), std::numeric_limits<std::size_t>::max());
  order_.resize(count);
  for (std::size_t k = 0; k < count; ++k) order_[elimination.order[k]] = k;
  BlockColumns columns = lower_triangle(lumped_mass, added, order_);
  BlockColumns rows(count);  // of L
  for (std::size_t k = 0; k < count; ++k) {
    const NodeBlock root = inverse_cholesky(columns[k].at(k));
    const NodeBlock root_transposed = transposed(root);
    inverse_root_.push_back(root_transposed);
    inverse_root_transposed_.push_back(root);
    inverse_diagonal_.push_back(product_with_transposed(root_transposed, root_transposed));
    columns[k].erase(k);
    for (const auto& [i, block] : columns[k]) {
      rows[i][k] = product_with_transposed(block, inverse_diagonal_[k]);
    }
    for (const auto& [i, block] : columns[k]) {
      for (auto j = columns[k].begin(); j->first <= i; ++j) {
        const NodeBlock update = product_with_transposed(block, rows[j->first].at(k));
        NodeBlock& entry = columns[j->first][i];
        for (std::size_t e = 0; e < update.size(); ++e) entry[e] -= update[e];
        if (j->first == i) break;
      }
    }
  }
  lower_begin_.push_back(0);
  for (std::size_t k = 0; k < count; ++k) {
    for (const auto& [column, block] : rows[k]) {
      lower_column_.push_back(column);
      lower_.push_back(transposed(block));
    }
    lower_begin_.push_back(lower_.size());
  }
  upper_begin_.assign(1, 0);
  for (std::size_t k = count; k-- > 0;) {
    for (const auto& [row, block] : columns[k]) {
      upper_column_.push_back(row);
      upper_.push_back(rows[row].at(k));
    }
    upper_begin_.push_back(upper_.size());
  }
}

void BlockFactorisation::forward(double* x) const {
  for (std::size_t k = 0; k < order_.size(); ++k) {
    Six y[2];
    load_six(x + width * k, y[0]);
    for (std::size_t b = lower_begin_[k]; b < lower_begin_[k + 1]; ++b) {
      accumulate<true>(lower_[b].data(), x + width * lower_column_[b], y);
    }
    store_six(x + width * k, sum(y));
  }
}

void BlockFactorisation::backward(double* x) const {
  const std::size_t count = order_.size();
  for (std::size_t turn = 0; turn < count; ++turn) {
    double* const here = x + width * (count - 1 - turn);
    Six y[2];
    load_six(here, y[0]);
    for (std::size_t b = upper_begin_[turn]; b < upper_begin_[turn + 1]; ++b) {
      accumulate<true>(upper_[b].data(), x + width * upper_column_[b], y);
    }
    store_six(here, sum(y));
  }
}

void BlockFactorisation::solve(double* x) const {
  forward(x);
  for (std::size_t k = 0; k < order_.size(); ++k) multiply(inverse_diagonal_[k], x + width * k);
  backward(x);
}

void BlockFactorisation::solve_half(double* x) const {
  forward(x);
  for (std::size_t k = 0; k < order_.size(); ++k) multiply(inverse_root_[k], x + width * k);
}

void BlockFactorisation::solve_transposed_half(double* x) const {
  for (std::size_t k = 0; k < order_.size(); ++k) {
    multiply(inverse_root_transposed_[k], x + width * k);
  }
  backward(x);
}

}  // namespace pounding
