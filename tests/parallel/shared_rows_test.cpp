#include "interactions/shared_rows.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <petscsys.h>

#include "common/array_reductions.h"
#include "common/parallel.h"
#include "support/plates.h"

namespace pounding::interactions {
namespace shared_rows_test {

using Vector = std::vector<double>;
using Known = std::function<int(std::size_t)>;

/// Rows of a matrix that the ranks of a communicator solve together; `offset`: of the numbers of
/// rows elsewhere in the program.
class Face {
 public:
  static constexpr int offset = 7;

  Face(MPI_Comm comm, const SparseRows& delassus, bool holds, const Known& known) {
    std::vector<int> rows, knows;
    std::vector<std::vector<int>> coupled;
    for (std::size_t i = 0; holds && i < delassus.rows(); ++i) {
      rows.push_back(static_cast<int>(i) + offset);
      knows.push_back(known(i));
      coupled.emplace_back(delassus.columns(i).begin(), delassus.columns(i).end());
    }
    share_ = std::make_unique<SharedRows>(comm, holds, rows, knows, coupled);
    if (!holds) return;
    SparseRows mine;
    for (const int row : share_->rows()) {
      const auto i = static_cast<std::size_t>(row - offset);
      std::vector<std::pair<int, double>> entries;
      for (std::size_t k = 0; k < delassus.columns(i).size(); ++k) {
        entries.emplace_back(share_->number()[delassus.columns(i)[k]], delassus.values(i)[k]);
      }
      std::ranges::sort(entries);
      for (const auto& [column, value] : entries) mine.add(column, value);
      mine.end_row();
    }
    solver_ = std::make_unique<ProportioningSolver>(std::move(mine), share_->first(),
                                                    share_->numbers(), share_.get());
  }

  SharedRows& share() { return *share_; }
  ProportioningSolver& solver() { return *solver_; }

  /// Solves for rows that `act`, from `guess`; the impulses of the rows here and of those felt here,
  /// NaN elsewhere.
  Vector solve(const Vector& rate, const std::vector<char>& act, const Vector& guess,
               LcpResult& result) {
    std::vector<std::size_t> active;
    Vector rates, impulses;
    for (std::size_t k = 0; k < share_->rows().size(); ++k) {
      const auto i = static_cast<std::size_t>(share_->rows()[k] - offset);
      if (act[i] == 0) continue;
      active.push_back(k);
      rates.push_back(rate[i]);
      impulses.push_back(guess[i]);
    }
    result = solver_->solve(active, rates, impulses);
    Vector values(share_->numbers());
    for (std::size_t k = 0; k < active.size(); ++k)
      values[share_->first() + active[k]] = impulses[k];
    share_->bring_felt(values);
    Vector found(rate.size(), std::nan(""));
    for (std::size_t k = 0; k < share_->rows().size(); ++k) {
      found[static_cast<std::size_t>(share_->rows()[k] - offset)] = values[share_->first() + k];
    }
    for (const SharedRows::Felt& other : share_->felt()) {
      found[static_cast<std::size_t>(other.row - offset)] = values[other.number];
    }
    return found;
  }

 private:
  std::unique_ptr<SharedRows> share_;
  std::unique_ptr<ProportioningSolver> solver_;
};

/// Every rank knows a strip of the face, the first of them a wider one.
int known_in_strip(MPI_Comm comm, std::size_t row, std::size_t rows) {
  const int strips = size_of(comm) + 1;
  const int strip = static_cast<int>(row * static_cast<std::size_t>(strips) / rows);
  return std::max(0, strip - 1) == rank_of(comm) ? 2 : 0;
}

Vector alone(const SparseRows& delassus, const Vector& rate, const std::vector<char>& act) {
  std::vector<std::size_t> active;
  Vector rates;
  for (std::size_t i = 0; i < act.size(); ++i) {
    if (act[i] == 0) continue;
    active.push_back(i);
    rates.push_back(rate[i]);
  }
  Vector impulses(active.size());
  ProportioningSolver(delassus).solve(active, rates, impulses);
  Vector all(rate.size());
  for (std::size_t k = 0; k < active.size(); ++k) all[active[k]] = impulses[k];
  return all;
}

/// Rows here and felt here have the impulses of one rank; together the ranks have every row once.
void expect_alike(MPI_Comm comm, Face& face, const Vector& found, const Vector& expected) {
  const double scale = largest_magnitude(expected);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (std::isnan(found[i])) continue;
    EXPECT_NEAR(found[i], expected[i], 1e-13 * scale) << "row " << i;
  }
  std::vector<int> times(expected.size(), 0);
  for (const int row : face.share().rows()) ++times[static_cast<std::size_t>(row - Face::offset)];
  reduce_over_ranks(comm, MPI_SUM, times);
  EXPECT_EQ(times, std::vector<int>(expected.size(), 1));
  const int mean = static_cast<int>(expected.size()) / size_of(comm);
  EXPECT_NEAR(static_cast<double>(face.share().rows().size()), mean, 0.02 * mean);
}

/// All rows, most of them, a corner that one rank has, in turns: the answers of one rank, the same
/// when they are asked for again, from the last ones in fewer products.
TEST(SharedRows, SolveAsOneRankDoes) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const Plates plates(30, 23, 1, 3);
  Face face(comm, plates.delassus, true,
            [&](std::size_t row) { return known_in_strip(comm, row, plates.rows()); });
  for (const int kept : {31, 20, 1, 31}) {
    std::vector<char> act(plates.rows(), 0);
    for (std::size_t i = 0; i < act.size(); ++i) {
      act[i] = kept == 1 ? i < 120 && i % 30 < 9 : static_cast<int>(i * i) % 31 < kept;
    }
    const Vector expected = alone(plates.delassus, plates.rate, act);
    LcpResult result, again;
    const Vector zeros(plates.rows());
    const Vector found = face.solve(plates.rate, act, zeros, result);
    EXPECT_EQ(result.method, LcpMethod::active_set);
    EXPECT_LE(result.residual, 2e-15);
    expect_alike(comm, face, found, expected);
    for (std::size_t i = 0; i < act.size(); ++i) {
      EXPECT_FALSE(known_in_strip(comm, i, plates.rows()) > 0 && std::isnan(found[i])) << i;
    }
    const Vector repeated = face.solve(plates.rate, act, zeros, again);
    EXPECT_EQ(std::memcmp(repeated.data(), found.data(), sizeof(double) * found.size()), 0);
    EXPECT_EQ(again.iterations, result.iterations);
    face.solve(plates.rate, act, expected, again);
    EXPECT_LT(again.iterations, 7);
  }
}

/// Every row twice: H has no inverse, and the gap rates are those of one rank.
TEST(SharedRows, SolveASingularDelassus) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const Plates plates(20, 15, 1, 5);
  SparseRows twice;
  Vector rate;
  for (std::size_t i = 0; i < plates.rows(); ++i) {
    for (int copy = 0; copy < 2; ++copy) {
      for (std::size_t k = 0; k < plates.delassus.columns(i).size(); ++k) {
        const int column = plates.delassus.columns(i)[k];
        twice.add(2 * column, plates.delassus.values(i)[k]);
        twice.add(2 * column + 1, plates.delassus.values(i)[k]);
      }
      twice.end_row();
      rate.push_back(plates.rate[i]);
    }
  }
  Face face(comm, twice, true,
            [&](std::size_t row) { return known_in_strip(comm, row, rate.size()); });
  const std::vector<char> act(rate.size(), 1);
  const Vector expected = alone(twice, rate, act);
  LcpResult result;
  const Vector found = face.solve(rate, act, Vector(rate.size()), result);
  EXPECT_EQ(result.method, LcpMethod::active_set);
  EXPECT_LE(result.residual, 2e-15);
  for (const int row : face.share().rows()) {  // what these feel comes as well
    const auto i = static_cast<std::size_t>(row - Face::offset);
    EXPECT_NEAR(row_product(twice, i, found), row_product(twice, i, expected), 1e-12);
  }
}

/// The last of three ranks has no share, and is done with it; bad numbers of one rank are seen by all.
TEST(SharedRows, OfSomeRanksAreSolvedByThose) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const bool holds = size_of(comm) < 3 || rank_of(comm) < 2;
  const Plates plates(24, 17, 10, 8);
  Face face(comm, plates.delassus, holds, [](std::size_t) { return 1; });
  if (!holds) return;
  const std::vector<char> act(plates.rows(), 1);
  LcpResult result;
  const Vector found = face.solve(plates.rate, act, Vector(plates.rows()), result);
  const Vector expected = alone(plates.delassus, plates.rate, act);
  for (std::size_t i = 0; i < found.size(); ++i) {  // both know dofs of all rows
    EXPECT_NEAR(found[i], expected[i], 1e-13 * largest_magnitude(expected));
  }
  Vector rate = plates.rate;
  rate[0] = std::nan("");
  face.solve(rate, act, Vector(plates.rows()), result);
  EXPECT_EQ(result.method, LcpMethod::not_finite);
  std::ranges::fill(rate, 0.0);
  rate[plates.rows() - 1] = 1;
  face.solve(rate, act, Vector(plates.rows()), result);
  EXPECT_EQ(result.method, LcpMethod::separated);
  EXPECT_EQ(result.free_rate, 1);
}

TEST(SharedRows, CorrectTogether) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const Plates plates(24, 17, 1, 5);
  Face face(comm, plates.delassus, true, [](std::size_t) { return 1; });
  const std::vector<char> act(plates.rows(), 1);
  LcpResult result;
  const Vector impulse = face.solve(plates.rate, act, Vector(plates.rows()), result);
  const std::vector<int>& rows = face.share().rows();
  Vector left, mine;
  for (const int row : rows) {
    left.push_back(1e-9 * std::sin(row));
    mine.push_back(impulse[static_cast<std::size_t>(row - Face::offset)]);
  }
  Vector increment(rows.size());
  face.solver().correct(left, mine, increment);
  Vector values(face.share().numbers());
  for (std::size_t k = 0; k < rows.size(); ++k) values[face.share().first() + k] = increment[k];
  face.share().bring_felt(values);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double rate = left[k] + row_product(face.solver().delassus(), k, values);
    EXPECT_TRUE(mine[k] == 0 || std::abs(rate) < 1e-16) << "row " << k << " " << rate;
  }
}

}  // namespace shared_rows_test
}  // namespace pounding::interactions
