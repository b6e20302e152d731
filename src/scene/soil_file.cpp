#include "scene/soil_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "common/dense_matrix.h"
#include "common/error.h"
#include "common/types.h"
#include "scene/option_values.h"
#include "scene/soil_parts.h"

namespace pounding {
namespace {

constexpr double wide_miss = 0.1;   ///< misfit to doubt
constexpr double round_off = 1e-9;  ///< of a term over the root of its diagonals' product
constexpr double largest_value = 1e30;
constexpr int most_mats = 20;
constexpr std::uintmax_t most_bytes = 10'000'000;
constexpr const char* first_word = "pounding soil";

class Reader {
 public:
  explicit Reader(const Structure& structure)
      : option_("option -" + structure.name + "_soil_table " + structure.soil->table),
        structure_(structure.name),
        path_(structure.soil->table),
        mat_(structure.soil->table_mat) {}

  FittedSoil read() {
    read_rows();
    read_head();
    FittedSoil soil;
    soil.mats = static_cast<int>(size_ / 6);
    while (words().front() == "misfit") soil.misfits.push_back(read_misfit());
    const DenseMatrix stiffness = read_matrix("stiffness", round_off);
    std::vector<SoilPart> parts;
    if (soil.mats == 1) {
      add_parts(stiffness, &Impedance::stiffness, parts);
    } else {
      soil.parts = own_springs(stiffness, 6 * static_cast<std::size_t>(mat_ - 1));
      add_springs_between(stiffness, parts);
    }
    add_parts(read_matrix("dashpots", -round_off), &Impedance::dashpot, parts);
    add_parts(read_matrix("masses", -round_off), &Impedance::mass, parts);
    expect("hidden");
    while (next_ < rows_.size()) add_part(read_hidden(), parts);
    if (soil.mats == 1) soil.parts = parts_of_mat(parts);
    if (soil.mats > 1) soil.shared = std::move(parts);
    return soil;
  }

 private:
  struct Row {
    long line = 0;
    std::vector<std::string> words;
  };

  [[noreturn]] void refuse(long line, const std::string& why) const {
    throw UserError(option_ + (line > 0 ? ", line " + std::to_string(line) : "") + ": " + why);
  }

  void refuse_if(bool wrong, long line, const std::string& why) const {
    if (wrong) refuse(line, why);
  }

  void read_rows() {
    require_finite_file(path_, option_ + ": ", most_bytes);
    std::ifstream file(path_);
    if (!file) refuse(0, "no such file, or it cannot be read");
    std::string text;
    for (long line = 1; std::getline(file, text); ++line) {
      if (line == 1 && text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
      text = trimmed(text.substr(0, text.find('#')));
      if (!text.empty()) rows_.push_back({line, split(text, ',')});
    }
    if (rows_.empty()) refuse(0, "nothing in it");
  }

  void read_head() {
    const Row& head = rows_.front();
    refuse_if(std::ranges::find(head.words, "frequency") != head.words.end(), head.line,
              "a table of impedances, which is fitted first: run/soil " + path_ +
                  " OUT writes the file for this option");
    refuse_if(head.words.front() != first_word, head.line,
              "'" + head.words.front() + "' where '" + first_word +
                  ",1' belongs; run/soil writes such files");
    refuse_if(head.words != std::vector<std::string>{first_word, "1"}, head.line,
              "another version of the file than 1, which is read here; write it anew by run/soil");
    ++next_;
    const std::vector<std::string>& mats = words();
    refuse_if(mats.front() != "mats" || mats.size() != 2, line(),
              "'" + mats.front() + "' where 'mats,1' belongs");
    const auto count = parse_integer(mats[1]);
    refuse_if(!count || *count < 1 || *count > most_mats, line(),
              "soil of " + mats[1] + " mats; give 1 to " + std::to_string(most_mats));
    refuse_if(mat_ > *count, line(),
              "it is soil of " + mats[1] + " mats, and -" + structure_ + "_soil_table_mat " +
                  std::to_string(mat_) + " is none of them");
    size_ = 6 * static_cast<std::size_t>(*count);
    ++next_;
  }

  /// Line and words that are next.
  long line() const { return next_ < rows_.size() ? rows_[next_].line : rows_.back().line + 1; }
  const std::vector<std::string>& words() const {
    if (next_ >= rows_.size()) refuse(line(), "the file ends where more of it belongs");
    return rows_[next_].words;
  }

  void expect(const std::string& section) {
    refuse_if(words() != std::vector{section}, line(),
              "'" + words().front() + "' where '" + section + "' belongs");
    ++next_;
  }

  double number(const std::string& word) const {
    const auto value = parse_real(word);
    refuse_if(!value || std::abs(*value) > largest_value, line(),
              "'" + word + "' is no number of use");
    return *value;
  }

  std::vector<double> numbers(std::size_t count) const {
    refuse_if(
        words().size() != count, line(),
        std::to_string(words().size()) + " values where " + std::to_string(count) + " belong");
    std::vector<double> values;
    for (const std::string& word : words()) values.push_back(number(word));
    return values;
  }

  FitMisfit read_misfit() {
    const std::vector<std::string>& row = words();
    if (row.size() != 5) refuse(line(), "a misfit has motions, the most, its frequency, the mean");
    FitMisfit misfit;
    for (const std::string& name : split(row[1], ' ')) {
      std::size_t at = 0;
      while (at < size_ && name != name_of(at)) ++at;
      refuse_if(at == size_, line(),
                "'" + name + "' is none of " +
                    (size_ == 6 ? "x, y, z, rx, ry, rz" : "x1, y1, z1, rx1 and so on"));
      misfit.motions += (misfit.motions.empty() ? "" : ", ") + name;
    }
    misfit.largest = number(row[2]);
    misfit.largest_at = number(row[3]);
    misfit.mean = number(row[4]);
    ++next_;
    return misfit;
  }

  /// A symmetric matrix none of whose eigenvalues is below `least`.
  DenseMatrix read_matrix(const std::string& section, double least) {
    const long head = line();
    expect(section);
    DenseMatrix matrix(size_, size_);
    for (std::size_t i = 0; i < size_; ++i) {
      const std::vector<double> row = numbers(size_);
      for (std::size_t j = 0; j < size_; ++j) matrix.column(j)[i] = row[j];
      if (row[i] < 0) refuse_energy(section, i, i, row[i]);
      for (std::size_t j = 0; j < i; ++j) make_symmetric(section, i, j, matrix);
      ++next_;
    }
    DenseMatrix scaled = matrix;
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t j = 0; j < size_; ++j) scaled.column(j)[i] /= size(matrix, i, j);
    }
    const double found = symmetric_eigenvalues(scaled).front();
    if (found >= least) return matrix;
    const std::string value = text_of(found);
    refuse_if(found >= -round_off, head,
              "the soil has no stiffness against some motion: the least eigenvalue of the "
              "stiffness over its diagonals is " +
                  value);
    refuse(head, "the soil would give energy: the least eigenvalue of the " + section +
                     " over the diagonals is " + value);
  }

  static std::string text_of(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
  }

  /// Root of the product of two diagonals, 1 where it is 0.
  static double size(const DenseMatrix& matrix, std::size_t i, std::size_t j) {
    const double root = std::sqrt(matrix.column(i)[i]) * std::sqrt(matrix.column(j)[j]);
    return root > 0 ? root : 1;
  }

  /// "ry", of several mats "ry2".
  std::string name_of(std::size_t motion) const {
    const std::string name(motion_names[motion % 6]);
    return size_ == 6 ? name : name + std::to_string(motion / 6 + 1);
  }
  std::string place(std::size_t i, std::size_t j) const { return name_of(i) + " " + name_of(j); }

  [[noreturn]] void refuse_energy(const std::string& section, std::size_t i, std::size_t j,
                                  double value) const {
    refuse(line(), "the soil would give energy: " + text_of(value) + " at " + place(i, j) +
                       " of the " + section);
  }

  void make_symmetric(const std::string& section, std::size_t i, std::size_t j,
                      DenseMatrix& matrix) const {
    double& below = matrix.column(j)[i];
    double& above = matrix.column(i)[j];
    const bool has_both = matrix.column(i)[i] > 0 && matrix.column(j)[j] > 0;
    if (!has_both && (below != 0 || above != 0)) {
      refuse_energy(section, i, j, below != 0 ? below : above);
    }
    if (std::abs(below - above) > round_off * size(matrix, i, j)) {
      refuse(line(), "not symmetric: " + text_of(below) + " at " + place(i, j) + " of the " +
                         section + ", " + text_of(above) + " at " + place(j, i));
    }
    below = above = (below + above) / 2;
  }

  SoilPart read_hidden() {
    const std::vector<double> row = numbers(size_ + 3);
    SoilPart part{{row.begin(), row.end() - 3}, {}};
    if (std::ranges::all_of(part.motion, [](double value) { return value == 0; })) {
      refuse(line(), "a hidden part against no motion");
    }
    constexpr std::array names{"dashpot", "spring", "mass"};
    const double* const values = &row[size_];
    for (std::size_t k = 0; k < 3; ++k) {
      if (values[k] >= 0 && (k > 0 || values[0] > 0)) continue;
      refuse(line(), std::string("the soil would give energy, or none would pass: a hidden ") +
                         names[k] + " of " + text_of(values[k]));
    }
    part.impedance.inner_dashpot = values[0];
    part.impedance.inner_stiffness = values[1];
    part.impedance.inner_mass = values[2];
    ++next_;
    return part;
  }

  std::string option_;
  std::string structure_;
  std::string path_;
  int mat_;               ///< from 1 on
  std::size_t size_ = 6;  ///< motions of all mats
  std::vector<Row> rows_;
  std::size_t next_ = 0;
};

/// Soil of a ground with another shear modulus and the same density, Poisson's ratio, damping and
/// layers: K(omega; f G) = f K(omega / sqrt(f); G).
void scale_soil(double factor, FittedSoil& soil) {
  const double root = std::sqrt(factor);
  const auto scale = [&](auto& part) {
    part.impedance.stiffness *= factor;
    part.impedance.inner_stiffness *= factor;
    part.impedance.dashpot *= root;
    part.impedance.inner_dashpot *= root;
  };
  std::ranges::for_each(soil.parts, scale);
  std::ranges::for_each(soil.shared, scale);
  for (FitMisfit& misfit : soil.misfits) misfit.largest_at *= root;
}

}  // namespace

void read_soil_file(Structure& structure) {
  if (!structure.soil || structure.soil->table.empty()) return;
  structure.soil->fitted = Reader(structure).read();
  scale_soil(structure.soil->factor, *structure.soil->fitted);
}

std::vector<std::string> fit_doubts(const Structure& structure) {
  std::vector<std::string> doubts;
  if (!structure.soil || !structure.soil->fitted || structure.soil->table_mat > 1) return doubts;
  for (const FitMisfit& misfit : structure.soil->fitted->misfits) {
    if (misfit.largest <= wide_miss) continue;
    char numbers[120];
    std::snprintf(numbers, sizeof numbers, "by up to %.3g %%, at %.4g Hz", 100 * misfit.largest,
                  misfit.largest_at);
    doubts.push_back("structure " + structure.name + ": springs, dashpots and masses of " +
                     structure.soil->table + " miss the table that they are fitted to along " +
                     misfit.motions + " " + numbers + "; passive soil may not be able to move so");
  }
  return doubts;
}

}  // namespace pounding
