#include "soil/impedance_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "common/dense_matrix.h"
#include "common/disjoint_sets.h"
#include "soil/nonnegative.h"
#include "soil/rate_search.h"

namespace pounding {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

constexpr double coupled = 1e-3;   ///< term over its diagonals from which on motions are coupled
constexpr double heavy = 10;       ///< share of the table's rows that the static one counts as
constexpr double lightest = 0.05;  ///< least size of a row over the median, for its weight
constexpr int most_rounds = 12;    ///< of directions
constexpr double settled = 1e-3;   ///< part by which a round has to lower the misfit
constexpr double negligible = 1e-9;

Complex entry(const ImpedanceMatrix& matrix, std::size_t i, std::size_t j) {
  return matrix[6 * i + j];
}

/// A term over the root of the product of its diagonals' moduli.
double relative(Complex value, const ImpedanceMatrix& table, std::size_t i, std::size_t j) {
  const double size = std::sqrt(std::abs(entry(table, i, i)) * std::abs(entry(table, j, j)));
  return size > 0 ? std::abs(value) / size : 0;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// Motions that are coupled, lowest first.
std::vector<std::vector<std::size_t>> blocks_of(const ImpedanceTable& table, double& left_out) {
  std::array<double, 36> largest{};
  for (const ImpedanceMatrix& matrix : table.impedance) {
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        double& most = largest[6 * i + j];
        most = std::max(most, relative(entry(matrix, i, j), matrix, i, j));
      }
    }
  }
  DisjointSets sets(6);
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (largest[6 * i + j] > coupled) sets.join(i, j);
    }
  }
  std::vector<std::vector<std::size_t>> blocks;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto same = std::ranges::find_if(
        blocks, [&](const auto& block) { return sets.root(block.front()) == sets.root(i); });
    if (same == blocks.end()) {
      blocks.push_back({i});
    } else {
      same->push_back(i);
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (sets.root(i) != sets.root(j)) left_out = std::max(left_out, largest[6 * i + j]);
    }
  }
  return blocks;
}

/// A term of the fit in one direction of the scaled motions.
struct Atom {
  std::size_t term = 0;
  std::vector<double> direction;
};

/// Fit of the terms of some motions that the table couples with no others. Motions are scaled so
/// that their diagonals are about 1, frequencies by the middle of the band.
class Block {
 public:
  Block(const ImpedanceTable& table, std::vector<std::size_t> motions)
      : table_(table), motions_(std::move(motions)), size_(motions_.size()) {
    const auto first = std::ranges::upper_bound(table.frequency, 0.0);
    unit_ = 2 * pi * std::sqrt(*first * table.frequency.back());
    for (const std::size_t c : motions_) {
      std::vector<double> sizes;
      for (const ImpedanceMatrix& matrix : table.impedance) {
        sizes.push_back(std::abs(entry(matrix, c, c)));
      }
      scale_.push_back(std::sqrt(median(std::move(sizes))));
    }
    take_rows();
  }

  void fit(ImpedanceFit& result) {
    DenseMatrix wanted(2 * samples_.omega.size(), 0);
    for (const std::vector<double>& direction : first_directions()) {
      wanted.append(samples_.column(along(direction)));
    }
    rates_ = search_rates(samples_, wanted);
    make_terms();
    find_factors();
    for (std::size_t t = 0; t < terms_.columns; ++t) add_parts(t, result.parts);
    BlockFit report;
    for (const std::size_t c : motions_) report.motions[c] = true;
    report.cells = static_cast<int>(rates_.size());
    judge(result, report);
    result.blocks.push_back(report);
  }

 private:
  /// The table's rows, and one at rest.
  void take_rows() {
    const bool has_static = table_.frequency.front() == 0;
    if (!has_static) append_row(0, at_rest());
    for (std::size_t i = 0; i < table_.frequency.size(); ++i) {
      append_row(2 * pi * table_.frequency[i] / unit_, table_.impedance[i]);
    }
    std::vector<double> norms;
    for (const auto& row : rows_) {
      double square = 0;
      for (const Complex& value : row) square += std::norm(value);
      norms.push_back(std::sqrt(square / static_cast<double>(size_)));
    }
    const double least = lightest * median(norms);
    const auto count = static_cast<double>(rows_.size());
    for (const double norm : norms) {
      samples_.weight.push_back(1 / (std::max(norm, least) * std::sqrt(count)));
    }
    samples_.weight.front() *= std::sqrt(std::max(1.0, count / heavy));
  }

  void append_row(double omega, const ImpedanceMatrix& matrix) {
    samples_.omega.push_back(omega);
    std::vector<Complex>& row = rows_.emplace_back();
    for (std::size_t a = 0; a < size_; ++a) {
      for (std::size_t b = 0; b < size_; ++b) {
        const Complex value = entry(matrix, motions_[a], motions_[b]) / (scale_[a] * scale_[b]);
        row.push_back(omega == 0 ? value.real() : value);
      }
    }
  }

  /// The parabola in the frequency through the first row and the first one at twice its frequency.
  ImpedanceMatrix at_rest() const {
    const double f = table_.frequency.front();
    const auto second = std::ranges::lower_bound(table_.frequency, 2 * f);
    ImpedanceMatrix found = table_.impedance.front();
    if (second == table_.frequency.end()) return found;
    const auto& other =
        table_.impedance[static_cast<std::size_t>(second - table_.frequency.begin())];
    const double share = f * f / (*second * *second - f * f);
    for (std::size_t k = 0; k < found.size(); ++k) found[k] += share * (found[k] - other[k]);
    return found;
  }

  /// Along each motion and between each two.
  std::vector<std::vector<double>> first_directions() const {
    std::vector<std::vector<double>> directions;
    for (std::size_t a = 0; a < size_; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        std::vector<double>& direction = directions.emplace_back(size_, 0.0);
        direction[a] = direction[b] = a == b ? 1 : std::sqrt(0.5);
      }
    }
    return directions;
  }

  std::vector<Complex> along(const std::vector<double>& direction) const {
    std::vector<Complex> values;
    for (const std::vector<Complex>& row : rows_) {
      Complex sum = 0;
      for (std::size_t a = 0; a < size_; ++a) {
        for (std::size_t b = 0; b < size_; ++b) {
          sum += direction[a] * row[size_ * a + b] * direction[b];
        }
      }
      values.push_back(sum);
    }
    return values;
  }

  void make_terms() {
    terms_ = samples_.of_grounded();
    for (const SeriesRates& rates : rates_) terms_.append(samples_.column(samples_.of(rates)));
    factors_.assign(terms_.columns, LargeArray(size_ * size_, 0.0));
    norms_ = squared_norms(terms_);
    for (double& norm : norms_) norm = std::sqrt(norm);
  }

  /// Weighted entries (a, b), b <= a, of the table less the fit, as columns of `terms_`.
  std::vector<double> residual(std::size_t a, std::size_t b) const {
    std::vector<Complex> values;
    for (const std::vector<Complex>& row : rows_) values.push_back(row[size_ * a + b]);
    std::vector<double> rest = samples_.column(values);
    for (std::size_t t = 0; t < terms_.columns; ++t) {
      const double factor = factors_[t][size_ * a + b];
      for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= factor * terms_.column(t)[i];
    }
    return rest;
  }

  /// Factors of all terms, symmetric and without a negative eigenvalue: sums of squares of
  /// directions, with new ones where the misfit falls most.
  void find_factors() {
    std::vector<Atom> atoms;
    for (std::size_t t = 0; t < terms_.columns; ++t) {
      for (std::vector<double>& direction : first_directions()) {
        atoms.push_back({t, std::move(direction)});
      }
    }
    double last = solve_atoms(atoms);
    for (int round = 0; round < most_rounds && size_ > 1; ++round) {
      const auto kept = factors_;
      const double misfit = solve_atoms(next_atoms(round));
      if (!(misfit < last)) factors_ = kept;
      if (!(misfit < last * (1 - settled))) break;
      last = misfit;
    }
  }

  std::vector<Atom> next_atoms(int round) const {
    const std::vector<DenseMatrix> slopes = slope_matrices();
    std::vector<Atom> atoms;
    const auto add_eigenvectors = [&](std::size_t term, DenseMatrix matrix) {
      symmetric_eigenvalues(matrix);
      for (std::size_t k = 0; k < size_; ++k) {
        atoms.push_back({term, {matrix.column(k), matrix.column(k) + size_}});
      }
    };
    const double reach = 0.3 * std::pow(0.7, round);
    for (std::size_t t = 0; t < terms_.columns; ++t) {
      DenseMatrix factor(size_, size_);
      factor.values = factors_[t];
      add_eigenvectors(t, factor);
      add_eigenvectors(t, slopes[t]);
      const double own = std::sqrt(std::inner_product(factor.values.begin(), factor.values.end(),
                                                      factor.values.begin(), 0.0));
      const double slope = std::sqrt(squared_sum(slopes[t]));
      if (own == 0 || slope == 0) continue;
      for (const double way : {reach, -reach}) {
        DenseMatrix mixed = factor;
        for (std::size_t k = 0; k < mixed.values.size(); ++k) {
          mixed.values[k] = mixed.values[k] / own + way * slopes[t].values[k] / slope;
        }
        add_eigenvectors(t, mixed);
      }
    }
    return atoms;
  }

  static double squared_sum(const DenseMatrix& matrix) {
    return std::inner_product(matrix.values.begin(), matrix.values.end(), matrix.values.begin(),
                              0.0);
  }

  /// Per term the fall of half the squared misfit with its factor.
  std::vector<DenseMatrix> slope_matrices() const {
    std::vector<DenseMatrix> slopes(terms_.columns, DenseMatrix(size_, size_));
    for (std::size_t a = 0; a < size_; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        const std::vector<double> rest = residual(a, b);
        for (std::size_t t = 0; t < terms_.columns; ++t) {
          const double slope = std::inner_product(rest.begin(), rest.end(), terms_.column(t), 0.0);
          slopes[t].column(a)[b] = slopes[t].column(b)[a] = slope;
        }
      }
    }
    return slopes;
  }

  /// Factors by the best sum of the atoms; returns the misfit.
  double solve_atoms(const std::vector<Atom>& atoms) {
    const std::size_t rows = terms_.rows;
    DenseMatrix work(rows * size_ * (size_ + 1) / 2, atoms.size() + 1);
    for (auto& factor : factors_) std::ranges::fill(factor, 0.0);
    std::size_t begin = 0;
    for (std::size_t a = 0; a < size_; ++a) {
      for (std::size_t b = 0; b <= a; ++b, begin += rows) {
        const double twice = a == b ? 1 : std::sqrt(2.0);
        const std::vector<double> wanted = residual(a, b);
        for (std::size_t i = 0; i < rows; ++i) {
          work.column(atoms.size())[begin + i] = twice * wanted[i];
        }
        for (std::size_t k = 0; k < atoms.size(); ++k) {
          const Atom& atom = atoms[k];
          const double part = twice * atom.direction[a] * atom.direction[b] / norms_[atom.term];
          for (std::size_t i = 0; i < rows; ++i) {
            work.column(k)[begin + i] = part * terms_.column(atom.term)[i];
          }
        }
      }
    }
    triangularize(work, atoms.size());
    const std::size_t top = std::min(work.rows, atoms.size());
    DenseMatrix triangle(top, atoms.size());
    for (std::size_t k = 0; k < atoms.size(); ++k) {
      std::copy_n(work.column(k), top, triangle.column(k));
    }
    const double* wanted = work.column(atoms.size());
    const std::vector<double> x = nonnegative_solution(triangle, {wanted, wanted + top});
    for (std::size_t k = 0; k < atoms.size(); ++k) {
      for (std::size_t a = 0; a < size_; ++a) {
        for (std::size_t b = 0; b < size_; ++b) {
          factors_[atoms[k].term][size_ * a + b] +=
              x[k] / norms_[atoms[k].term] * atoms[k].direction[a] * atoms[k].direction[b];
        }
      }
    }
    double square = 0;
    for (std::size_t a = 0; a < size_; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        const std::vector<double> rest = residual(a, b);
        square +=
            (a == b ? 1 : 2) * std::inner_product(rest.begin(), rest.end(), rest.begin(), 0.0);
      }
    }
    return std::sqrt(square);
  }

  /// The impedance of a term with the factor 1, in SI.
  Impedance impedance_of(std::size_t term) const {
    Impedance part;
    if (term == 0) part.stiffness = 1;
    if (term == 1) part.dashpot = 1 / unit_;
    if (term == 2) part.mass = 1 / (unit_ * unit_);
    if (term < 3) return part;
    const SeriesRates& rates = rates_[term - 3];
    part.inner_dashpot = 1 / unit_;
    if (std::isfinite(rates.spring)) part.inner_stiffness = rates.spring;
    if (rates.mass > 0) part.inner_mass = 1 / (rates.mass * unit_ * unit_);
    return part;
  }

  /// Parts of a term in the directions of the eigenvectors of its factor. The grounded parts of a
  /// motion that is coupled with none are one with its first internal part.
  void add_parts(std::size_t term, std::vector<DirectedImpedance>& parts) const {
    DenseMatrix factor(size_, size_);
    factor.values = factors_[term];
    const std::vector<double> values = symmetric_eigenvalues(factor);
    for (std::size_t k = 0; k < size_; ++k) {
      if (!(values[k] > negligible * values.back()) || !(values[k] > 0)) continue;
      DirectedImpedance part;
      double largest = 0;
      for (std::size_t a = 0; a < size_; ++a) {
        part.motion[motions_[a]] = scale_[a] * factor.column(k)[a];
        largest = std::max(largest, std::abs(part.motion[motions_[a]]));
      }
      for (double& value : part.motion) value /= largest;
      const double strength = values[k] * largest * largest;
      part.impedance = impedance_of(term);
      for (double* value : {&part.impedance.stiffness, &part.impedance.dashpot,
                            &part.impedance.mass, &part.impedance.inner_stiffness,
                            &part.impedance.inner_dashpot, &part.impedance.inner_mass}) {
        *value *= strength;
      }
      if (size_ == 1 && joins_last(part, parts)) continue;
      parts.push_back(part);
    }
  }

  /// Whether it is now one with the last part, of the same motion.
  static bool joins_last(const DirectedImpedance& part, std::vector<DirectedImpedance>& parts) {
    if (parts.empty()) return false;
    std::array<double, 6> same = part.motion;
    for (std::size_t c = 0; c < 6; ++c) same[c] = std::abs(part.motion[c]);
    std::array<double, 6> last = parts.back().motion;
    for (double& value : last) value = std::abs(value);
    Impedance& to = parts.back().impedance;
    if (same != last || to.inner_dashpot > 0) return false;
    to.stiffness += part.impedance.stiffness;
    to.dashpot += part.impedance.dashpot;
    to.mass += part.impedance.mass;
    to.inner_stiffness = part.impedance.inner_stiffness;
    to.inner_dashpot = part.impedance.inner_dashpot;
    to.inner_mass = part.impedance.inner_mass;
    return true;
  }

  /// Smallest and largest eigenvalue of the imaginary part, each term over its `sizes`.
  std::array<double, 2> imaginary_range(const ImpedanceMatrix& matrix,
                                        const std::vector<double>& sizes) const {
    DenseMatrix part(size_, size_);
    for (std::size_t a = 0; a < size_; ++a) {
      for (std::size_t b = 0; b < size_; ++b) {
        part.column(a)[b] = entry(matrix, motions_[a], motions_[b]).imag() / (sizes[a] * sizes[b]);
      }
    }
    const std::vector<double> values = symmetric_eigenvalues(part);
    return {values.front(), values.back()};
  }

  /// Roots of the moduli of the diagonals.
  std::vector<double> sizes_of(const ImpedanceMatrix& matrix) const {
    std::vector<double> sizes;
    for (const std::size_t c : motions_) {
      sizes.push_back(std::sqrt(std::max(std::abs(entry(matrix, c, c)), 1e-300)));
    }
    return sizes;
  }

  void judge(const ImpedanceFit& result, BlockFit& report) const {
    report.table_damping = 1e300;
    report.damping = 1e300;
    std::vector<double> largest;
    double sum = 0;
    for (std::size_t i = 0; i < table_.frequency.size(); ++i) {
      const double f = table_.frequency[i];
      const ImpedanceMatrix& wanted = table_.impedance[i];
      const ImpedanceMatrix found = result.at(2 * pi * f);
      double worst = 0;
      for (const std::size_t a : motions_) {
        for (const std::size_t b : motions_) {
          Complex miss = entry(found, a, b) - entry(wanted, a, b);
          if (f == 0) miss = miss.real();
          worst = std::max(worst, relative(miss, wanted, a, b));
        }
      }
      sum += worst;
      if (worst > report.largest) {
        report.largest = worst;
        report.largest_at = f;
      }
      if (f == 0) continue;
      report.table_damping =
          std::min(report.table_damping, imaginary_range(wanted, sizes_of(wanted))[0]);
      largest.push_back(imaginary_range(wanted, scale_)[1] / (2 * pi * f));
    }
    report.mean = sum / static_cast<double>(table_.frequency.size());
    find_margin(result, median(std::move(largest)), report);
  }

  void find_margin(const ImpedanceFit& result, double usual, BlockFit& report) const {
    constexpr int count = 2000;
    constexpr double beyond = 1000;
    const double first = *std::ranges::upper_bound(table_.frequency, 0.0);
    const double last = table_.frequency.back();
    report.margin = 1e300;
    for (int i = 0; i <= count; ++i) {
      const double f = first / beyond * std::pow(last / first * beyond * beyond, double(i) / count);
      const ImpedanceMatrix found = result.at(2 * pi * f);
      const double margin = imaginary_range(found, scale_)[0] / (2 * pi * f * usual);
      if (margin < report.margin) {
        report.margin = margin;
        report.margin_at = f;
      }
      if (f < first || f > last) continue;
      const double damping = imaginary_range(found, sizes_of(found))[0];
      if (damping < report.damping) {
        report.damping = damping;
        report.damping_at = f;
      }
    }
  }

  const ImpedanceTable& table_;
  std::vector<std::size_t> motions_;
  std::size_t size_;
  double unit_ = 1;            ///< of circular frequencies [rad/s]
  std::vector<double> scale_;  ///< root of the usual modulus of the diagonal, per motion
  Samples samples_;
  std::vector<std::vector<Complex>> rows_;  ///< per frequency, shape (size, size)
  std::vector<SeriesRates> rates_;
  DenseMatrix terms_;  ///< spring, dashpot, mass, then the rates
  std::vector<double> norms_;
  std::vector<LargeArray> factors_;  ///< per term, shape (size, size)
};

}  // namespace

ImpedanceMatrix ImpedanceFit::at(double circular_frequency) const {
  ImpedanceMatrix sum{};
  for (const DirectedImpedance& part : parts) {
    const Complex value = part.impedance.at(circular_frequency);
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) sum[6 * i + j] += part.motion[i] * part.motion[j] * value;
    }
  }
  return sum;
}

ImpedanceFit fit_impedances(const ImpedanceTable& table) {
  ImpedanceFit result;
  result.band = {table.frequency.front(), table.frequency.back()};
  for (std::vector<std::size_t>& block : blocks_of(table, result.left_out)) {
    Block(table, std::move(block)).fit(result);
  }
  return result;
}

}  // namespace pounding
