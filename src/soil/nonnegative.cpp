#include "soil/nonnegative.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pounding {
namespace {

double product(const double* a, const double* b, std::size_t count) {
  return std::inner_product(a, a + count, b, 0.0);
}

/// Least squares of the columns that are `free`, whose values are returned in their order.
std::vector<double> free_solution(const DenseMatrix& a, const std::vector<double>& b,
                                  const std::vector<std::size_t>& free) {
  DenseMatrix work(a.rows, free.size() + 1);
  for (std::size_t k = 0; k < free.size(); ++k) {
    std::copy_n(a.column(free[k]), a.rows, work.column(k));
  }
  std::ranges::copy(b, work.column(free.size()));
  triangularize(work, free.size());
  std::vector<double> x(work.column(free.size()),
                        work.column(free.size()) + std::min(a.rows, free.size()));
  x.resize(free.size(), 0.0);
  for (std::size_t k = std::min(a.rows, free.size()); k-- > 0;) {
    const double pivot = work.column(k)[k];
    x[k] = pivot == 0 ? 0 : x[k] / pivot;
    for (std::size_t i = 0; i < k; ++i) x[i] -= work.column(k)[i] * x[k];
  }
  return x;
}

}  // namespace

void triangularize(DenseMatrix& matrix, std::size_t count) {
  const std::size_t rows = matrix.rows;
  for (std::size_t k = 0; k < std::min(count, rows); ++k) {
    double* pivot = matrix.column(k) + k;
    const std::size_t below = rows - k;
    const double norm = std::sqrt(product(pivot, pivot, below));
    if (norm == 0) continue;
    const double diagonal = pivot[0] > 0 ? -norm : norm;
    std::vector<double> mirror(pivot, pivot + below);
    mirror[0] -= diagonal;
    const double square = product(mirror.data(), mirror.data(), below);
    for (std::size_t j = k; j < matrix.columns; ++j) {
      double* column = matrix.column(j) + k;
      const double factor = 2 * product(mirror.data(), column, below) / square;
      for (std::size_t i = 0; i < below; ++i) column[i] -= factor * mirror[i];
    }
    std::fill(pivot + 1, pivot + below, 0.0);
  }
}

std::vector<double> nonnegative_solution(const DenseMatrix& a, const std::vector<double>& b) {
  constexpr double round_off = 1e-13;
  std::vector<double> x(a.columns, 0.0);
  std::vector<std::size_t> free;
  const std::vector<double> squares = [&] {
    std::vector<double> sums;
    for (std::size_t j = 0; j < a.columns; ++j) {
      sums.push_back(product(a.column(j), a.column(j), a.rows));
    }
    return sums;
  }();
  const double size = std::sqrt(product(b.data(), b.data(), b.size()));
  std::vector<double> rest = b;
  double last = size * size;
  for (std::size_t turn = 0; turn < 3 * a.columns + 10; ++turn) {
    std::size_t best = a.columns;
    double steepest = round_off * size;
    for (std::size_t j = 0; j < a.columns; ++j) {
      if (squares[j] == 0 || std::ranges::find(free, j) != free.end()) continue;
      const double slope = product(a.column(j), rest.data(), a.rows) / std::sqrt(squares[j]);
      if (slope > steepest) {
        steepest = slope;
        best = j;
      }
    }
    if (best == a.columns) break;
    const std::vector<double> kept = x;
    free.push_back(best);
    while (!free.empty()) {
      const std::vector<double> wanted = free_solution(a, b, free);
      double share = 1;
      for (std::size_t k = 0; k < free.size(); ++k) {
        if (wanted[k] <= 0) share = std::min(share, x[free[k]] / (x[free[k]] - wanted[k] + 1e-300));
      }
      for (std::size_t k = 0; k < free.size(); ++k) {
        x[free[k]] += share * (wanted[k] - x[free[k]]);
        if (wanted[k] <= 0 && x[free[k]] <= round_off * std::abs(wanted[k])) x[free[k]] = 0;
      }
      const std::size_t before = free.size();
      std::erase_if(free, [&](std::size_t j) { return !(x[j] > 0); });
      if (free.size() == before) break;
    }
    rest = b;
    for (const std::size_t j : free) {
      for (std::size_t i = 0; i < a.rows; ++i) rest[i] -= a.column(j)[i] * x[j];
    }
    const double now = product(rest.data(), rest.data(), rest.size());
    if (!(now < last)) {  // round-off decides from here on
      x = kept;
      break;
    }
    last = now;
  }
  return x;
}

}  // namespace pounding
