#include "system/coupled_mass.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "system/block_factorisation.h"
#include "unit/elements/dense_eigen.h"

namespace pounding {
namespace coupled_mass_test {

constexpr std::size_t width = CoupledMass::width;

/// M, S, and M + S as a dense matrix over all dofs of the rank.
struct Case {
  std::vector<double> mass;
  NodeBlocks added;
  std::vector<double> dense;
  std::vector<double> dense_added;
};

/// A ring of nodes of three to six dofs with a few chords and one node on its own; some dofs in
/// between are not coupled. S = sum of c g g^T over the edges, g at random.
Case random_case(int ring, unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  Case result;
  LocalIndex dof = 2;
  for (int n = 0; n <= ring; ++n) {
    const int count = n % 3 == 1 ? 3 : n % 5 == 2 ? 5 : 6;
    result.added.nodes.push_back({dof, count});
    dof += count + n % 2;
  }
  for (LocalIndex i = 0; i < dof; ++i) {
    result.mass.push_back(std::pow(10, number(-1, 1)));
  }
  const std::size_t n = result.mass.size();
  result.dense_added.assign(n * n, 0.0);
  const auto add_edge = [&](int a, int b) {
    const int row = std::max(a, b);
    const int column = std::min(a, b);
    std::vector<std::pair<int, int>> places;
    std::vector<double> g;
    for (const int node : {row, column}) {
      for (int i = 0; i < result.added.nodes[static_cast<std::size_t>(node)].count; ++i) {
        places.emplace_back(node, i);
        g.push_back(number(-10, 10));
      }
      if (row == column) break;
    }
    for (std::size_t i = 0; i < g.size(); ++i) {
      for (std::size_t j = 0; j < g.size(); ++j) {
        const auto [node_i, place_i] = places[i];
        const auto [node_j, place_j] = places[j];
        if (node_i >= node_j) {
          result.added.blocks[{node_i, node_j}][static_cast<std::size_t>(6 * place_i + place_j)] +=
              g[i] * g[j];
        }
        const auto at = [&](int node, int place) {
          return static_cast<std::size_t>(result.added.nodes[static_cast<std::size_t>(node)].begin +
                                          place);
        };
        result.dense_added[at(node_i, place_i) * n + at(node_j, place_j)] += g[i] * g[j];
      }
    }
  };
  for (int k = 0; k < ring; ++k) {
    add_edge(k, (k + 1) % ring);
  }
  for (int k = 0; k + 7 < ring; k += 5) {
    add_edge(k, k + 7);
  }
  add_edge(ring, ring);
  result.dense = result.dense_added;
  for (std::size_t i = 0; i < n; ++i) {
    result.dense[i * n + i] += result.mass[i];
  }
  return result;
}

std::vector<double> random_vector(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<double> x(size);
  for (double& value : x) {
    value = static_cast<double>(random()) / 2147483648.0 - 1;
  }
  return x;
}

/// Over the owned dofs: f of what is coupled.
template <typename Function>
std::vector<double> on_field(const CoupledMass& mass, const std::vector<double>& owned,
                             Function&& function) {
  std::vector<double> field(mass.field_size());
  std::vector<double> result(owned.size(), 0.0);
  mass.take(owned.data(), field.data());
  function(field.data());
  mass.put(field.data(), result.data());
  return result;
}

bool is_coupled(const CoupledMass& mass, std::size_t dof) {
  return mass.node_of(static_cast<LocalIndex>(dof)) >= 0;
}

TEST(CoupledMass, SolutionIsThatOfTheDenseMatrix) {
  for (const int ring : {3, 4, 17, 60}) {
    const Case dense = random_case(ring, static_cast<unsigned>(ring));
    const CoupledMass mass(dense.mass, dense.added);
    const std::vector<double> right = random_vector(dense.mass.size(), 1);
    const auto expected = testing_support::solve_positive_definite(dense.dense, right);
    const auto found = on_field(mass, right, [&](double* x) { mass.solve(x); });
    for (std::size_t i = 0; i < right.size(); ++i) {
      if (is_coupled(mass, i)) {
        EXPECT_NEAR(found[i], expected[i], 1e-10) << ring << " " << i;
      } else {
        EXPECT_EQ(found[i], 0) << ring << " " << i;
      }
    }
  }
}

TEST(CoupledMass, HalfSolutionsMakeAWholeOne) {
  const Case dense = random_case(23, 5);
  const CoupledMass mass(dense.mass, dense.added);
  const std::vector<double> x = random_vector(dense.mass.size(), 2);
  const std::vector<double> y = random_vector(dense.mass.size(), 3);
  const auto whole = on_field(mass, x, [&](double* f) { mass.solve(f); });
  const auto halves = on_field(mass, x, [&](double* f) {
    mass.solve_half(f);
    mass.solve_transposed_half(f);
  });
  const auto half = on_field(mass, x, [&](double* f) { mass.solve_half(f); });
  const auto other = on_field(mass, y, [&](double* f) { mass.solve_transposed_half(f); });
  double left = 0;   // y^T (G^-1 x)
  double right = 0;  // (G^-T y)^T x
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(halves[i], whole[i], 1e-12);
    left += half[i] * (is_coupled(mass, i) ? y[i] : 0);
    right += other[i] * (is_coupled(mass, i) ? x[i] : 0);
  }
  EXPECT_NEAR(left, right, 1e-11);
}

TEST(CoupledMass, AddedProductIsThatOfTheDenseMatrix) {
  const Case dense = random_case(11, 7);
  const CoupledMass mass(dense.mass, dense.added);
  const std::vector<double> v = random_vector(dense.mass.size(), 4);
  double expected = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    for (std::size_t j = 0; j < v.size(); ++j) {
      expected += v[i] * dense.dense_added[i * v.size() + j] * v[j];
    }
  }
  EXPECT_NEAR(mass.added_product(v.data()) / expected, 1, 1e-12);
}

TEST(CoupledMass, RefusesAMatrixThatIsNotPositiveDefinite) {
  Case dense = random_case(5, 9);
  for (double& entry : dense.added.blocks.begin()->second) {
    entry *= -1;
  }
  EXPECT_THROW(CoupledMass(dense.mass, dense.added), std::runtime_error);
}

TEST(CoupledMass, KnowsItsNodes) {
  const Case dense = random_case(4, 1);
  const CoupledMass mass(dense.mass, dense.added);
  EXPECT_EQ(mass.node_of(0), -1);
  EXPECT_EQ(mass.node_of(1), -1);
  EXPECT_EQ(mass.node_of(2), 0);
  EXPECT_EQ(mass.node_of(7), 0);
  EXPECT_EQ(mass.node_of(8), 1);
  EXPECT_EQ(mass.node_of(11), -1);  // behind the three dofs of node 1
  EXPECT_EQ(mass.node_of(12), 2);
}

TEST(Elimination, OfARingFillsInOneBlockPerNode) {
  for (const int ring : {4, 25, 94}) {
    std::vector<std::set<int>> neighbours(static_cast<std::size_t>(ring));
    for (int k = 0; k < ring; ++k) {
      neighbours[static_cast<std::size_t>(k)] = {(k + 1) % ring, (k + ring - 1) % ring};
    }
    const Elimination elimination = *eliminate(neighbours, 1000);
    std::set<int> once(elimination.order.begin(), elimination.order.end());
    EXPECT_EQ(once.size(), static_cast<std::size_t>(ring));
    EXPECT_EQ(elimination.order.size(), static_cast<std::size_t>(ring));
    std::size_t blocks = 0;
    for (const auto& column : elimination.columns) {
      blocks += column.size();
    }
    EXPECT_EQ(blocks, static_cast<std::size_t>(2 * ring - 3)) << ring;
    // A round takes every other node: half of them are no neighbours of the node before.
    for (std::size_t k = 1; k < static_cast<std::size_t>(ring) / 2; ++k) {
      EXPECT_FALSE(neighbours[static_cast<std::size_t>(elimination.order[k])].contains(
          elimination.order[k - 1]));
    }
  }
}

}  // namespace coupled_mass_test
}  // namespace pounding
