#include "scene/impedance_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "common/component_names.h"
#include "common/dense_matrix.h"
#include "common/error.h"
#include "common/finite_file.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

constexpr double unsymmetric = 0.01;   ///< of a term, over the root of its diagonals' product
constexpr double gives_energy = 0.02;  ///< least eigenvalue of the imaginary part, likewise
constexpr double wide_miss = 0.1;      ///< misfit to doubt
constexpr std::size_t fewest = 4;      ///< frequencies
constexpr std::uintmax_t largest_table = 100'000'000;

/// A column of the file: the frequency, or a part of a term.
struct Column {
  bool frequency = false;
  bool imaginary = false;
  std::size_t row = 0;
  std::size_t column = 0;
};

/// Names of all columns, "kxx_re" and so on, but for the frequency's.
std::string column_name(std::size_t row, std::size_t column, bool imaginary) {
  return "k" + std::string(motion_names[row]) + std::string(motion_names[column]) +
         (imaginary ? "_im" : "_re");
}

class Reader {
 public:
  explicit Reader(const Structure& structure)
      : option_("option -" + structure.name + "_soil_table " + structure.soil->table),
        path_(structure.soil->table) {}

  ImpedanceTable read() {
    require_finite_file(path_, option_ + ": ", largest_table);
    std::ifstream file(path_);
    if (!file) refuse(0, "no such file, or it cannot be read");
    std::string text;
    for (long number = 1; std::getline(file, text); ++number) {
      text = trimmed(text);
      if (number == 1 && text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
      if (text.empty() || text[0] == '#') continue;
      const std::vector<std::string> words = split(text, ',');
      if (columns_.empty()) {
        read_names(number, words);
      } else {
        read_row(number, words);
      }
    }
    if (columns_.empty()) refuse(0, "no line with names of columns in it");
    if (table_.frequency.size() < fewest ||
        (table_.frequency.front() == 0 && table_.frequency.size() == fewest)) {
      refuse(0, std::to_string(table_.frequency.size()) + " frequencies; a fit needs " +
                    std::to_string(fewest) + " above 0");
    }
    return std::move(table_);
  }

 private:
  [[noreturn]] void refuse(long line, const std::string& why) const {
    throw UserError(option_ + (line > 0 ? ", line " + std::to_string(line) : "") + ": " + why);
  }

  void read_names(long line, const std::vector<std::string>& words) {
    for (const std::string& word : words) {
      if (std::ranges::count(words, word) > 1) {
        refuse(line, "two columns are called '" + word + "'");
      }
      columns_.push_back(column_of(line, word));
    }
    const auto has = [&](const std::string& name) {
      return std::ranges::find(words, name) != words.end();
    };
    if (!has("frequency")) refuse(line, "no column 'frequency', in Hz");
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) {
        const std::array names{column_name(i, j, false), column_name(i, j, true)};
        given_[6 * i + j] = has(names[0]);
        for (const std::string& name : names) {
          if (!has(name) && (i == j || has(names[0]) || has(names[1]))) {
            refuse(line, "no column '" + name + "'" +
                             (i == j ? "; all six motions need their diagonal" : ""));
          }
        }
      }
    }
  }

  Column column_of(long line, const std::string& word) const {
    if (word == "frequency") return {true};
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) {
        for (const bool imaginary : {false, true}) {
          if (word == column_name(i, j, imaginary)) return {false, imaginary, i, j};
        }
      }
    }
    refuse(line, "'" + word +
                     "' where names of columns belong: frequency, in Hz, then kxx_re, kxx_im and "
                     "so on of x, y, z, rx, ry, rz, such as kxry_re");
  }

  void read_row(long line, const std::vector<std::string>& words) {
    if (words.size() != columns_.size()) {
      refuse(line, std::to_string(words.size()) + " values for " + std::to_string(columns_.size()) +
                       " columns");
    }
    double frequency = 0;
    ImpedanceMatrix matrix{};
    for (std::size_t k = 0; k < words.size(); ++k) {
      const auto number = parse_real(words[k]);
      if (!number || std::abs(*number) > 1e30) {
        refuse(line, "'" + words[k] + "' is no number of use");
      }
      const Column& column = columns_[k];
      if (column.frequency) {
        frequency = *number;
      } else {
        matrix[6 * column.row + column.column] +=
            column.imaginary ? std::complex<double>(0, *number) : *number;
      }
    }
    if (!(frequency >= 0) || frequency > 1e4) {
      refuse(line, "the frequency is to be in Hz, from 0 to 1e4");
    }
    if (!table_.frequency.empty() && !(frequency > table_.frequency.back())) {
      refuse(line, "the frequency does not increase");
    }
    make_symmetric(line, matrix);
    table_.frequency.push_back(frequency);
    table_.impedance.push_back(matrix);
    check_row(line, frequency, matrix);
  }

  void make_symmetric(long line, ImpedanceMatrix& matrix) const {
    for (std::size_t i = 0; i < 6; ++i) {
      if (std::abs(matrix[7 * i]) == 0) {
        refuse(line, column_name(i, i, false) + " and " + column_name(i, i, true) +
                         " are 0; soil holds a mat in all six motions");
      }
      for (std::size_t j = 0; j < i; ++j) {
        std::complex<double>& below = matrix[6 * i + j];
        std::complex<double>& above = matrix[6 * j + i];
        if (!given_[6 * i + j]) below = above;
        if (!given_[6 * j + i]) above = below;
        const double size = std::sqrt(std::abs(matrix[7 * i]) * std::abs(matrix[7 * j]));
        if (std::abs(below - above) > unsymmetric * size) {
          refuse(line, "the matrix is not symmetric: k" + std::string(motion_names[i]) +
                           std::string(motion_names[j]) + " and k" + std::string(motion_names[j]) +
                           std::string(motion_names[i]) +
                           " differ by more than 1 % of their diagonals");
        }
        below = above = (below + above) / 2.0;
      }
    }
  }

  /// Eigenvalues of a part of a matrix, each term over the root of its diagonals' product.
  static std::vector<double> eigenvalues(const ImpedanceMatrix& matrix, bool imaginary) {
    DenseMatrix part(6, 6);
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) {
        const std::complex<double> value = matrix[6 * i + j];
        part.column(i)[j] = (imaginary ? value.imag() : value.real()) /
                            std::sqrt(std::abs(matrix[7 * i]) * std::abs(matrix[7 * j]));
      }
    }
    return symmetric_eigenvalues(part);
  }

  void check_row(long line, double frequency, const ImpedanceMatrix& matrix) const {
    if (table_.frequency.size() == 1 && !(eigenvalues(matrix, false).front() > 0)) {
      refuse(line,
             "the soil has no stiffness against some motion at the lowest frequency: the real part "
             "is not positive definite; are signs and the point that the table is for right?");
    }
    const double least = frequency > 0 ? eigenvalues(matrix, true).front() : 0;
    if (least >= -gives_energy) return;
    char number[40];
    std::snprintf(number, sizeof number, "%.3g", -100 * least);
    refuse(line, std::string("the soil would give energy: the imaginary part is negative, by ") +
                     number +
                     " % of the diagonals; tables for motions exp(-i omega t) need the other sign");
  }

  std::string option_;
  std::string path_;
  std::vector<Column> columns_;
  std::array<bool, 36> given_{};
  ImpedanceTable table_;
};

}  // namespace

ImpedanceTable read_impedances(const Structure& structure) {
  return Reader(structure).read();
}

void fit_soil(Structure& structure) {
  if (!structure.soil || structure.soil->table.empty()) return;
  structure.soil->fitted = fit_impedances(read_impedances(structure));
}

std::vector<std::string> fit_doubts(const Structure& structure) {
  std::vector<std::string> doubts;
  if (!structure.soil || !structure.soil->fitted) return doubts;
  for (const BlockFit& block : structure.soil->fitted->blocks) {
    if (block.largest <= wide_miss) continue;
    char numbers[120];
    std::snprintf(numbers, sizeof numbers, "by up to %.3g %%, at %.4g Hz", 100 * block.largest,
                  block.largest_at);
    doubts.push_back("structure " + structure.name + ": springs, dashpots and masses miss " +
                     structure.soil->table + " along " + names_of_motions(block.motions) + " " +
                     numbers + "; passive soil may not be able to move so");
  }
  return doubts;
}

std::string names_of_motions(const std::array<bool, 6>& motions) {
  std::string names;
  for (std::size_t c = 0; c < motions.size(); ++c) {
    if (motions[c]) names += (names.empty() ? "" : ", ") + std::string(motion_names[c]);
  }
  return names;
}

}  // namespace pounding
