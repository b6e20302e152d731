#include "modal/orthonormal_space.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "common/parallel.h"

namespace pounding {
namespace {

/// Smallest remainder, relative to the largest one, that products of columns still show.
constexpr double least_told = 1e-5;

/// Columns of a matrix X, and weights with which X W is orthonormal, shape (columns of X, chosen).
struct Combination {
  std::vector<std::size_t> columns;
  DenseMatrix weights;
};

/// Chooses columns of X by X^T X, that with the largest remainder beside those before first, while
/// this is above `least` and more than rounding (Cholesky's factor with pivots).
Combination orthonormal_combination(DenseMatrix products, double least) {
  const std::size_t size = products.columns;
  Combination found;
  found.weights = DenseMatrix(size, 0);
  std::vector<bool> chosen(size, false);
  double largest = 0;
  // A column that is not chosen, less its part along the chosen ones, is X times its column of
  // `rest`; its products with the others are its column of `products`.
  DenseMatrix rest(size, size);
  for (std::size_t j = 0; j < size; ++j) rest.column(j)[j] = 1;
  while (found.columns.size() < size) {
    std::size_t best = size;
    for (std::size_t j = 0; j < size; ++j) {
      if (chosen[j]) continue;
      if (best == size || products.column(j)[j] > products.column(best)[best]) best = j;
    }
    const double square = products.column(best)[best];
    largest = std::max(largest, square);
    if (!(square > std::max(least * least, least_told * least_told * largest))) break;
    chosen[best] = true;
    found.columns.push_back(best);
    const double scale = 1 / std::sqrt(square);
    for (std::size_t j = 0; j < size; ++j) {
      if (chosen[j]) continue;
      const double part = products.column(j)[best] / square;
      for (std::size_t i = 0; i < size; ++i) {
        rest.column(j)[i] -= part * rest.column(best)[i];
        if (!chosen[i]) products.column(j)[i] -= part * products.column(best)[i];
      }
    }
    std::vector<double> weights(rest.column(best), rest.column(best) + size);
    for (double& weight : weights) weight *= scale;
    found.weights.append(weights);
  }
  return found;
}

}  // namespace

DenseMatrix product_over_ranks(MPI_Comm comm, const DenseMatrix& a, const DenseMatrix& b,
                               std::size_t first) {
  DenseMatrix result = transposed_product(a, b, first);
  reduce_over_ranks(comm, MPI_SUM, result.values);
  return result;
}

void OrthonormalSpace::choose(const std::vector<std::size_t>& numbers) {
  std::size_t kept = 0;
  for (const std::size_t j : numbers) {
    if (j != kept) std::copy_n(column(j), columns_.rows, columns_.column(kept));
    ++kept;
  }
  keep_first(kept);
}

void OrthonormalSpace::keep_first(std::size_t count) {
  LargeArray& values = columns_.values;
  columns_.columns = count;
  values.resize(count * columns_.rows);
  return_pages(values.data() + values.size(), (values.capacity() - values.size()) * sizeof(double));
}

DenseMatrix OrthonormalSpace::parts(const DenseMatrix& x, std::size_t first) const {
  return product_over_ranks(comm_, columns_, x, first);
}

DenseMatrix OrthonormalSpace::project(DenseMatrix& x, std::size_t first) const {
  DenseMatrix part = parts(x, first);
  add_product(-1, columns_, part, x, first);
  return part;
}

std::vector<double> OrthonormalSpace::norms(const DenseMatrix& x) const {
  std::vector<double> lengths = squared_norms(x);
  reduce_over_ranks(comm_, MPI_SUM, lengths);
  for (double& length : lengths) length = std::sqrt(length);
  return lengths;
}

void OrthonormalSpace::normalise(DenseMatrix& x) const {
  const std::vector<double> lengths = norms(x);
  for (std::size_t j = 0; j < x.columns; ++j) {
    for (std::size_t i = 0; i < x.rows && lengths[j] > 0; ++i) x.column(j)[i] /= lengths[j];
  }
}

void OrthonormalSpace::take_in(DenseMatrix& x, double least) {
  while (x.columns > 0) {
    const Combination first = orthonormal_combination(product_over_ranks(comm_, x, x), least);
    if (first.columns.empty()) return;
    DenseMatrix block(x.rows, first.weights.columns);
    add_product(1, x, first.weights, block);
    std::vector<std::size_t> used = first.columns;
    std::ranges::sort(used, std::greater());
    for (const std::size_t j : used) x.remove(j);
    project(block);  // once more: the part that rounding put back grew with the scale
    combine_columns(block,
                    orthonormal_combination(product_over_ranks(comm_, block, block), 0).weights);
    append_columns(block);
    add_product(-1, block, product_over_ranks(comm_, block, x), x);
  }
}

}  // namespace pounding
