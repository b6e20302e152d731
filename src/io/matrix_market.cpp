#include "io/matrix_market.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <optional>
#include <sstream>
#include <string_view>

#include "common/error.h"
#include "io/new_file.h"

namespace pounding {
namespace {

/// Reads a Matrix Market file line by line.
class MarketReader {
 public:
  explicit MarketReader(const std::string& path) : path_(path), file_(path) {
    if (!file_) throw UserError(path + ": no such file, or it cannot be read");
  }

  MatrixSize read(const std::function<void(const MatrixEntry&)>& receive) {
    read_banner();
    MatrixSize size;
    long long entries = 0;
    const std::vector<double> header = numbers(coordinate_ ? 3 : 2);
    size.rows = count(header[0]);
    size.columns = count(header[1]);
    entries = coordinate_ ? count(header[2]) : static_cast<long long>(size.rows) * size.columns;
    if (symmetric_ && (size.rows != size.columns || !coordinate_)) {
      fail("symmetric is understood for square matrices in coordinates only");
    }
    for (long long k = 0; k < entries; ++k) {
      const MatrixEntry entry = coordinate_ ? coordinates(size) : array_entry(k, size);
      receive(entry);
      if (symmetric_ && entry.row != entry.column) {
        check_triangle(entry);
        receive({entry.column, entry.row, entry.value});
      }
    }
    check_end(entries);
    return size;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw UserError(path_ + ", line " + std::to_string(line_) + ": " + what);
  }

  void read_banner() {
    std::string text;
    std::getline(file_, text);
    line_ = 1;
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::istringstream words(text);
    std::string mark, object, format, field, symmetry;
    words >> mark >> object >> format >> field >> symmetry;
    coordinate_ = format == "coordinate";
    symmetric_ = symmetry == "symmetric";
    if (mark != "%%matrixmarket" || object != "matrix" || (!coordinate_ && format != "array") ||
        (field != "real" && field != "integer" && field != "double") ||
        (!symmetric_ && symmetry != "general")) {
      fail(
          "expected '%%MatrixMarket matrix coordinate|array real|integer general|symmetric', not "
          "'" +
          text + "'");
    }
  }

  /// A symmetric file holds one triangle: an entry given in both would count twice.
  void check_triangle(const MatrixEntry& entry) {
    const bool lower = entry.row > entry.column;
    if (one_triangle_ && lower != *one_triangle_) {
      fail("row " + std::to_string(entry.row + 1) + ", column " + std::to_string(entry.column + 1) +
           (lower ? " is below the diagonal, entries before it above"
                  : " is above the diagonal, entries before it below") +
           ": a symmetric file holds one triangle only; leave one out, or say general");
    }
    one_triangle_ = lower;
  }

  void check_end(long long entries) {
    std::string text;
    if (next_line(text)) {
      fail("more than the " + std::to_string(entries) + " entries that the file announces");
    }
  }

  /// The next line that is neither empty nor a comment; false at the end.
  bool next_line(std::string& text) {
    do {
      if (!std::getline(file_, text)) return false;
      ++line_;
    } while (text[0] == '%' || text.find_first_not_of(" \t\r") == std::string::npos);
    return true;
  }

  std::vector<double> numbers(std::size_t wanted) {
    std::string text;
    if (!next_line(text)) fail("the file ends too early");
    std::vector<double> values;
    const char* place = text.c_str();
    char* end = nullptr;
    for (double value = std::strtod(place, &end); end != place; value = std::strtod(place, &end)) {
      values.push_back(value);
      place = end;
    }
    const bool all = std::string_view(place).find_first_not_of(" \t\r") == std::string_view::npos;
    if (values.size() != wanted || !all) fail("expected " + std::to_string(wanted) + " numbers");
    return values;
  }

  PetscInt count(double value) const {
    if (!(value >= 0) || value != std::floor(value) || value > 2147483647.0) {
      fail("not a number of rows, columns or entries");
    }
    return static_cast<PetscInt>(value);
  }

  double finite(double value) const {
    if (!std::isfinite(value)) fail("a value is not finite");
    return value;
  }

  MatrixEntry coordinates(const MatrixSize& size) {
    const std::vector<double> line = numbers(3);
    const MatrixEntry entry{count(line[0]) - 1, count(line[1]) - 1, finite(line[2])};
    if (entry.row < 0 || entry.row >= size.rows || entry.column < 0 ||
        entry.column >= size.columns) {
      fail("row or column outside the matrix");
    }
    return entry;
  }

  /// Arrays run column by column.
  MatrixEntry array_entry(long long k, const MatrixSize& size) {
    return {static_cast<PetscInt>(k % size.rows), static_cast<PetscInt>(k / size.rows),
            finite(numbers(1)[0])};
  }

  std::string path_;
  std::ifstream file_;
  long line_ = 0;
  bool coordinate_ = true;
  bool symmetric_ = false;
  std::optional<bool> one_triangle_;  ///< of a symmetric file so far: the lower one
};

constexpr std::int32_t matrix_class = 1211216;

/// Reads big-endian numbers.
class BinaryReader {
 public:
  explicit BinaryReader(const std::string& path)
      : path_(path), file_(path, std::ios::binary), size_(0) {
    std::error_code failure;
    size_ = std::filesystem::file_size(path, failure);
    if (!file_ || failure) throw UserError(path + ": no such file, or it cannot be read");
  }

  MatrixSize read(const std::function<void(const MatrixEntry&)>& receive) {
    constexpr std::size_t head = 4;
    const auto header = size_ < head * sizeof(std::int32_t)
                            ? std::vector<std::int32_t>(head, 0)
                            : numbers<std::int32_t, std::uint32_t>(head);
    const auto [rows, columns, entries] = std::array{header[1], header[2], header[3]};
    if (header[0] != matrix_class) {
      fail(
          "not a matrix in PETSc's binary format with 32-bit indices (Matrix Market ends in .mtx)");
    }
    if (rows < 0 || columns < 0 || entries < 0) {
      fail("its head says " + std::to_string(rows) + " x " + std::to_string(columns) + " with " +
           std::to_string(entries) + " entries; only sparse matrices are read");
    }
    const auto lengths = numbers<std::int32_t, std::uint32_t>(static_cast<std::size_t>(rows));
    const bool negative = std::ranges::any_of(lengths, [](std::int32_t n) { return n < 0; });
    if (negative || std::accumulate(lengths.begin(), lengths.end(), std::int64_t{0}) != entries) {
      fail("the numbers of entries of its rows do not add up to " + std::to_string(entries));
    }
    const auto places = numbers<std::int32_t, std::uint32_t>(static_cast<std::size_t>(entries));
    const auto values = numbers<double, std::uint64_t>(static_cast<std::size_t>(entries));
    std::size_t k = 0;
    for (PetscInt row = 0; row < rows; ++row) {
      for (std::int32_t i = 0; i < lengths[row]; ++i, ++k) {
        const MatrixEntry entry{row, places[k], values[k]};
        if (entry.column < 0 || entry.column >= columns) {
          fail(at(entry) + ": outside of the matrix of " + std::to_string(columns) + " columns");
        }
        if (!std::isfinite(entry.value)) fail(at(entry) + ": the value is not finite");
        receive(entry);
      }
    }
    return {rows, columns};
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw UserError(path_ + ": " + what); }

  static std::string at(const MatrixEntry& entry) {
    return "row " + std::to_string(entry.row + 1) + ", column " +
           std::to_string(static_cast<long>(entry.column) + 1);
  }

  /// `Bits`: the unsigned integer of the same width.
  template <typename Value, typename Bits>
  std::vector<Value> numbers(std::size_t count) {
    if (count * sizeof(Bits) > size_) fail("the file ends too early");
    std::vector<unsigned char> bytes(count * sizeof(Bits));
    if (!file_.read(reinterpret_cast<char*>(bytes.data()),
                    static_cast<std::streamsize>(bytes.size()))) {
      fail("the file ends too early");
    }
    std::vector<Value> values;
    values.reserve(count);
    for (std::size_t i = 0; i < bytes.size(); i += sizeof(Bits)) {
      Bits bits = 0;
      for (std::size_t b = 0; b < sizeof(Bits); ++b) {
        bits = static_cast<Bits>(bits << 8 | bytes[i + b]);
      }
      values.push_back(std::bit_cast<Value>(bits));
    }
    return values;
  }

  std::string path_;
  std::ifstream file_;
  std::uintmax_t size_;  ///< [bytes]
};

}  // namespace

MatrixSize read_matrix(const std::string& path,
                       const std::function<void(const MatrixEntry&)>& receive) {
  require_finite_file(path);
  return path.ends_with(".mtx") ? MarketReader(path).read(receive)
                                : read_petsc_binary(path, receive);
}

void write_matrix(const std::string& path, const std::string& comment, const MatrixSize& size,
                  const std::vector<MatrixEntry>& entries) {
  NewFile file(path);
  std::fprintf(file.stream(), "%%%%MatrixMarket matrix coordinate real general\n%% %s\n%d %d %zu\n",
               comment.c_str(), size.rows, size.columns, entries.size());
  for (const MatrixEntry& entry : entries) {
    std::fprintf(file.stream(), "%d %d %.17g\n", entry.row + 1, entry.column + 1, entry.value);
  }
  file.close();
}

MatrixSize read_petsc_binary(const std::string& path,
                             const std::function<void(const MatrixEntry&)>& receive) {
  return BinaryReader(path).read(receive);
}

}  // namespace pounding
