#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.h"
#include "io/matrix_market.h"
#include "support/refusal.h"
#include "system/square_matrix.h"

/// Matrices out of files: what cannot be is refused with the file and the place.
namespace pounding {
namespace matrix_files_test {

namespace fs = std::filesystem;
using testing::HasSubstr;

class MatrixFiles : public testing::Test {
 protected:
  MatrixFiles() : folder_(fs::temp_directory_path() / ("matrices-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~MatrixFiles() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

  static std::vector<std::array<double, 3>> entries(const std::string& path) {
    std::vector<std::array<double, 3>> list;
    read_matrix(path, [&](const MatrixEntry& entry) {
      list.push_back(
          {static_cast<double>(entry.row), static_cast<double>(entry.column), entry.value});
    });
    return list;
  }

  static std::string complaint(const std::string& path) {
    return testing_support::refusal_of([&] { entries(path); });
  }

  std::string of_market(const std::string& lines, const std::string& symmetry = "general") const {
    return complaint(write(
        "a.mtx", "%%MatrixMarket matrix coordinate real " + symmetry + "\n% words\n" + lines));
  }

 private:
  fs::path folder_;
};

/// PETSc's binary format, big-endian.
class Binary {
 public:
  Binary& whole(std::int32_t value) { return put(std::bit_cast<std::uint32_t>(value), 4); }
  Binary& real(double value) { return put(std::bit_cast<std::uint64_t>(value), 8); }
  const std::string& bytes() const { return bytes_; }

 private:
  Binary& put(std::uint64_t bits, int count) {
    for (int shift = 8 * (count - 1); shift >= 0; shift -= 8) {
      bytes_ += static_cast<char>(bits >> shift & 0xff);
    }
    return *this;
  }
  std::string bytes_;
};

/// [2 -1; -1 2] with one column and one value to choose.
std::string petsc_file(std::int32_t column = 1, double value = -1, std::int32_t entries = 4) {
  Binary file;
  file.whole(1211216).whole(2).whole(2).whole(entries).whole(2).whole(2);
  file.whole(0).whole(column).whole(0).whole(1);
  file.real(2).real(value).real(-1).real(2);
  return file.bytes();
}

TEST_F(MatrixFiles, SymmetricOnesAreFilledUp) {
  const std::string head = "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n";
  const std::vector<std::array<double, 3>> expected{{0, 0, 2}, {1, 0, -1}, {0, 1, -1}};
  EXPECT_EQ(entries(write("lower.mtx", head + "1 1 2\n2 1 -1\n\n% the end\n")), expected);
  const std::vector<std::array<double, 3>> upper{{0, 0, 2}, {0, 1, -1}, {1, 0, -1}};
  EXPECT_EQ(entries(write("upper.mtx", head + "1 1 2\n1 2 -1\n")), upper);
}

TEST_F(MatrixFiles, SymmetricOnesWithBothTrianglesAreRefused) {
  EXPECT_THAT(of_market("2 2 3\n1 1 2\n2 1 -1\n1 2 -1\n", "symmetric"),
              HasSubstr("line 6: row 1, column 2 is above the diagonal"));
  EXPECT_THAT(of_market("2 2 3\n1 1 2\n1 2 -1\n2 1 -1\n", "symmetric"),
              HasSubstr("line 6: row 2, column 1 is below the diagonal"));
}

TEST_F(MatrixFiles, MarketLinesAreReadToTheirEnd) {
  EXPECT_EQ(of_market("2 2 1\n1 1 2 \r\n"), "");
  EXPECT_THAT(of_market("2 2 1\n1 1 2 N/m\n"), HasSubstr("line 4: expected 3 numbers"));
  EXPECT_THAT(of_market("2 2 1\n1 1 2\n2 2 2\n"), HasSubstr("line 5: more than the 1 entries"));
  EXPECT_THAT(of_market("2 2 1\n1 3 2\n"), HasSubstr("line 4: row or column outside"));
}

TEST_F(MatrixFiles, PetscBinaryIsRead) {
  const std::vector<std::array<double, 3>> expected{{0, 0, 2}, {0, 1, -1}, {1, 0, -1}, {1, 1, 2}};
  EXPECT_EQ(entries(write("a.petsc", petsc_file())), expected);
}

TEST_F(MatrixFiles, WrongPetscBinaryIsRefused) {
  const auto of = [&](const std::string& bytes) { return complaint(write("a.petsc", bytes)); };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(of(petsc_file(-7)), HasSubstr("a.petsc: row 1, column -6: outside of the matrix"));
  EXPECT_THAT(of(petsc_file(2)), HasSubstr("row 1, column 3: outside of the matrix of 2 columns"));
  EXPECT_THAT(of(petsc_file(1, nan)), HasSubstr("row 1, column 2: the value is not finite"));
  EXPECT_THAT(of(petsc_file(1, -1, 5)), HasSubstr("do not add up to 5"));
  EXPECT_THAT(of(petsc_file(1, -1, -1)), HasSubstr("only sparse matrices are read"));
  EXPECT_THAT(of("%%MatrixMarket and so on"), HasSubstr("not a matrix in PETSc's binary format"));
  const std::string whole = petsc_file();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THAT(of(whole.substr(0, size)), HasSubstr("a.petsc: ")) << size;
  }
}

/// What the checks say of a matrix of three free rows, all on this rank.
std::string complaint_of(const std::vector<MatrixEntry>& entries) {
  const std::vector<PetscInt> numbers{0, 1, 2};
  SquareMatrix matrix("k.mtx", numbers, numbers, 3);
  for (const MatrixEntry& entry : entries) {
    matrix.add(entry);
  }
  matrix.finish();
  return testing_support::refusal_of([&] { matrix.check(); });
}

TEST(SquareMatrixChecks, NameThePlace) {
  EXPECT_EQ(complaint_of({{0, 0, 1}, {0, 1, -1}, {1, 0, -1}, {1, 1, 1}, {2, 2, 0}}), "");
  EXPECT_EQ(complaint_of({{0, 0, 0.5}, {0, 0, 0.5}, {0, 1, -1}, {1, 0, -1}, {1, 1, 1}}), "");
  EXPECT_THAT(complaint_of({{0, 0, 1}, {1, 1, -3}}),
              HasSubstr("k.mtx: row 2, column 2: -3 on the"));
  EXPECT_THAT(complaint_of({{0, 0, 1}, {1, 1, 1}, {0, 1, 0.5}}),
              HasSubstr("row 1, column 2: 0.5, but 0 at row 2, column 1: not symmetric"));
  EXPECT_THAT(complaint_of({{0, 0, 1}, {2, 2, 1}, {2, 0, 0.5}, {0, 2, 0.4}}),
              HasSubstr("row 1, column 3: 0.4, but 0.5 at row 3, column 1: not symmetric"));
  EXPECT_THAT(complaint_of({{0, 0, 1}, {1, 1, 1}, {0, 1, -2}, {1, 0, -2}}),
              HasSubstr("row 1, column 2: -2, more than the diagonals there allow (1)"));
  EXPECT_THAT(complaint_of({{0, 0, 1}, {0, 1, 1}, {1, 0, 1}}), HasSubstr("diagonals"));
}

TEST(SquareMatrixChecks, LeaveClampedRowsAlone) {
  const std::vector<PetscInt> numbers{0, -1, 1};
  SquareMatrix matrix("k.mtx", numbers, numbers, 2);
  for (const MatrixEntry& entry : {MatrixEntry{0, 0, 1}, {0, 1, 9}, {1, 1, -5}, {2, 2, 1}}) {
    matrix.add(entry);
  }
  matrix.finish();
  EXPECT_NO_THROW(matrix.check());
  ASSERT_EQ(matrix.rows().size(), 2U);
  EXPECT_EQ(matrix.rows()[1], (std::vector<SquareMatrix::Entry>{{2, 1.0}}));
}

}  // namespace matrix_files_test
}  // namespace pounding
