#include "modal/orthonormal_space.h"

#include <algorithm>
#include <cmath>

namespace pounding {

void add_over_ranks(MPI_Comm comm, std::vector<double>& values) {
  constexpr std::size_t portion = std::size_t{1} << 28;  // range of an int
  for (std::size_t first = 0; first < values.size(); first += portion) {
    const auto count = static_cast<int>(std::min(portion, values.size() - first));
    MPI_Allreduce(MPI_IN_PLACE, values.data() + first, count, MPI_DOUBLE, MPI_SUM, comm);
  }
}

DenseMatrix product_over_ranks(MPI_Comm comm, const DenseMatrix& a, const DenseMatrix& b,
                               std::size_t first) {
  DenseMatrix result = transposed_product(a, b, first);
  add_over_ranks(comm, result.values);
  return result;
}

void OrthonormalSpace::choose(const std::vector<std::size_t>& numbers) {
  DenseMatrix chosen(columns_.rows, 0);
  for (const std::size_t j : numbers) chosen.append({column(j), column(j) + columns_.rows});
  columns_ = std::move(chosen);
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
  add_over_ranks(comm_, lengths);
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
    const std::vector<double> lengths = norms(x);
    const auto best = std::ranges::max_element(lengths);
    if (*best <= least) return;
    const auto j = static_cast<std::size_t>(best - lengths.begin());
    DenseMatrix next(x.rows, 0);
    next.append({x.column(j), x.column(j) + x.rows});
    x.remove(j);
    normalise(next);
    project(next);  // once more: the part that rounding put back grew with the scale
    normalise(next);
    append(next.values);
    add_product(-1, next, product_over_ranks(comm_, next, x), x);
  }
}

}  // namespace pounding
