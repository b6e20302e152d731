#include "soil/rate_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "soil/nonnegative.h"

namespace pounding {
namespace {

using Complex = std::complex<double>;

constexpr double good_misfit = 1e-5;    ///< below which no rates are added
constexpr double worth_it = 0.9;        ///< misfit of one more pair over that without it
constexpr std::size_t most_cells = 10;  ///< pairs of rates
constexpr double first_move = 0.2;      ///< of the logarithm of a rate
constexpr double last_move = 1e-3;
constexpr double noticed = 1 - 1e-4;  ///< of the misfit, for a move to count
constexpr double per_decade = 8;      ///< points of the grid
constexpr std::array sharpnesses{0.5, 1.0, 2.0, 4.0, 8.0};
constexpr double least_sharpness = 0.2;
constexpr double most_sharpness = 30;

std::vector<double> unit_column(std::vector<double> column) {
  const double norm =
      std::sqrt(std::inner_product(column.begin(), column.end(), column.begin(), 0.0));
  for (double& value : column) value /= norm;
  return column;
}

/// Greedy search for rates, each step of which lowers the misfit.
class Search {
 public:
  Search(const Samples& samples, const DenseMatrix& wanted)
      : samples_(samples), wanted_(wanted), grounded_(wanted.rows, 0) {
    const auto first = std::ranges::upper_bound(samples.omega, 0.0);
    low_ = *first;
    high_ = samples.omega.back();
    const DenseMatrix grounded = samples.of_grounded();
    for (std::size_t j = 0; j < grounded.columns; ++j) {
      grounded_.append(unit_column({grounded.column(j), grounded.column(j) + grounded.rows}));
    }
  }

  std::vector<SeriesRates> run() {
    const std::vector<SeriesRates> grid = make_grid();
    misfit_ = misfit_of({});
    const std::size_t most = std::min(most_cells, samples_.omega.size() / 4);
    while (misfit_ > good_misfit && found_.size() < most) {
      if (!add_best(grid)) break;
    }
    return found_;
  }

 private:
  using Columns = std::vector<std::vector<double>>;

  /// Rates that the table can see: their peaks lie about its band and are no narrower than it
  /// resolves.
  bool is_allowed(const SeriesRates& rates) const {
    const auto is_near = [&](double rate) { return rate >= low_ / 2 && rate <= 2 * high_; };
    if (std::isinf(rates.spring)) return is_near(rates.mass);
    if (rates.mass == 0) return is_near(rates.spring);
    const double peak = std::sqrt(rates.spring * rates.mass);
    const double sharpness = std::sqrt(rates.mass / rates.spring);
    return is_near(peak) && sharpness >= least_sharpness && sharpness <= sharpest(peak);
  }

  double sharpest(double peak) const {
    const auto above = std::ranges::upper_bound(samples_.omega, peak);
    if (peak <= low_ || above == samples_.omega.end()) return 1;
    return std::clamp(peak / (2 * (*above - *(above - 1))), 1.0, most_sharpness);
  }

  std::vector<SeriesRates> make_grid() const {
    std::vector<SeriesRates> grid;
    const double decades = std::log10(4 * high_ / low_);
    const auto count = static_cast<int>(std::ceil(per_decade * decades));
    for (int i = 0; i <= count; ++i) {
      const double rate = low_ / 2 * std::pow(10.0, decades * i / count);
      grid.push_back({rate, 0});
      grid.push_back({std::numeric_limits<double>::infinity(), rate});
      for (const double sharpness : sharpnesses) {
        grid.push_back({rate / sharpness, rate * sharpness});
      }
    }
    std::erase_if(grid, [&](const SeriesRates& rates) { return !is_allowed(rates); });
    return grid;
  }

  std::vector<double> column_of(const SeriesRates& rates) const {
    return unit_column(samples_.column(samples_.of(rates)));
  }

  /// Root of the sum of the squared misfits of all functions; `used`, if given: which of the
  /// columns have a factor above 0.
  double misfit_of(const Columns& columns, std::vector<char>* used = nullptr) const {
    DenseMatrix work = grounded_;
    for (const std::vector<double>& column : columns) work.append(column);
    const std::size_t count = work.columns;
    work.append_columns(wanted_);
    triangularize(work, count);
    const std::size_t top = std::min(count, work.rows);
    DenseMatrix triangle(top, count);
    for (std::size_t j = 0; j < count; ++j) std::copy_n(work.column(j), top, triangle.column(j));
    double square = 0;
    for (std::size_t k = count; k < work.columns; ++k) {
      std::vector<double> rest(work.column(k), work.column(k) + work.rows);
      const std::vector<double> x =
          nonnegative_solution(triangle, {rest.begin(), rest.begin() + static_cast<long>(top)});
      for (std::size_t j = 0; j < count; ++j) {
        for (std::size_t i = 0; i < top; ++i) rest[i] -= triangle.column(j)[i] * x[j];
        if (used != nullptr && j >= grounded_.columns && x[j] > 0) {
          (*used)[j - grounded_.columns] = 1;
        }
      }
      square += std::inner_product(rest.begin(), rest.end(), rest.begin(), 0.0);
    }
    return std::sqrt(square);
  }

  bool add_best(const std::vector<SeriesRates>& grid) {
    Columns columns;
    for (const SeriesRates& rates : found_) columns.push_back(column_of(rates));
    columns.emplace_back();
    SeriesRates best;
    double least = misfit_;
    for (const SeriesRates& rates : grid) {
      columns.back() = column_of(rates);
      const double misfit = misfit_of(columns);
      if (misfit < least) {
        least = misfit;
        best = rates;
      }
    }
    if (!(least < misfit_)) return false;
    std::vector<SeriesRates> trial = found_;
    trial.push_back(best);
    columns.back() = column_of(best);
    least = move(trial, columns);
    if (!(least < worth_it * misfit_)) return false;
    std::vector<char> used(trial.size(), 0);
    misfit_of(columns, &used);
    found_.clear();
    for (std::size_t i = 0; i < trial.size(); ++i) {
      if (used[i] != 0) found_.push_back(trial[i]);
    }
    misfit_ = least;
    return true;
  }

  /// Moves rates one by one while that lowers the misfit, by ever smaller steps; returns it.
  double move(std::vector<SeriesRates>& trial, Columns& columns) const {
    double least = misfit_of(columns);
    for (double step = first_move; step > last_move;) {
      bool moved = false;
      for (std::size_t i = 0; i < trial.size(); ++i) {
        const bool has_both = std::isfinite(trial[i].spring) && trial[i].mass > 0;
        for (const double way : {step, -step}) {
          moved = move_along(way, way, i, trial, columns, least) || moved;
          if (has_both) moved = move_along(way, -way, i, trial, columns, least) || moved;
        }
      }
      if (!moved) step /= 2;
    }
    return least;
  }

  bool move_along(double spring, double mass, std::size_t i, std::vector<SeriesRates>& trial,
                  Columns& columns, double& least) const {
    bool moved = false;
    while (true) {
      const SeriesRates next{trial[i].spring * std::exp(spring), trial[i].mass * std::exp(mass)};
      if (!is_allowed(next)) return moved;
      std::vector<double> kept = column_of(next);
      std::swap(kept, columns[i]);
      const double misfit = misfit_of(columns);
      if (!(misfit < noticed * least)) {
        std::swap(kept, columns[i]);
        return moved;
      }
      trial[i] = next;
      least = misfit;
      moved = true;
    }
  }

  const Samples& samples_;
  const DenseMatrix& wanted_;
  double low_ = 0;
  double high_ = 0;
  DenseMatrix grounded_;
  std::vector<SeriesRates> found_;
  double misfit_ = 0;
};

}  // namespace

Complex SeriesRates::at(double omega) const {
  if (omega == 0) return 0;
  const Complex i_omega(0, omega);
  return i_omega / (1.0 + i_omega / spring + mass / i_omega);
}

std::vector<double> Samples::column(const std::vector<Complex>& values) const {
  std::vector<double> column(2 * values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    column[i] = weight[i] * values[i].real();
    column[values.size() + i] = weight[i] * values[i].imag();
  }
  return column;
}

std::vector<Complex> Samples::of(const SeriesRates& rates) const {
  std::vector<Complex> values;
  for (const double w : omega) values.push_back(rates.at(w));
  return values;
}

DenseMatrix Samples::of_grounded() const {
  std::vector<Complex> spring;
  std::vector<Complex> dashpot;
  std::vector<Complex> mass;
  for (const double w : omega) {
    spring.emplace_back(1);
    dashpot.emplace_back(0, w);
    mass.emplace_back(-w * w);
  }
  DenseMatrix columns(2 * omega.size(), 0);
  for (const auto* values : {&spring, &dashpot, &mass}) columns.append(column(*values));
  return columns;
}

std::vector<SeriesRates> search_rates(const Samples& samples, const DenseMatrix& wanted) {
  return Search(samples, wanted).run();
}

}  // namespace pounding
