#include "io/petsc_binary.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <vector>

#include "common/error.h"

namespace pounding {
namespace {

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

MatrixSize read_petsc_binary(const std::string& path,
                             const std::function<void(const MatrixEntry&)>& receive) {
  return BinaryReader(path).read(receive);
}

}  // namespace pounding
