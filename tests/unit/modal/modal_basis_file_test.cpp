#include "modal/modal_basis_file.h"

#include <array>
#include <filesystem>
#include <functional>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/hdf5_file.h"

namespace pounding {
namespace modal_basis_file_test {

namespace fs = std::filesystem;

/// Arrays of a basis of three vectors at two places, as its file holds them.
struct Content {
  double modes = 2;
  double attachment_vectors = 1;
  double full_dofs = 24;
  std::vector<double> mode_numbers;
  std::vector<double> points;
  std::size_t point_columns = 2;
};

Content sound() {
  constexpr std::array<double, 3> numbers{1, 2, 0};
  constexpr std::array<double, 4> points{3, 0, 3, 1};
  Content content;
  content.mode_numbers.assign(numbers.begin(), numbers.end());
  content.points.assign(points.begin(), points.end());
  return content;
}

class ModalBasisFile : public testing::Test {
 protected:
  ModalBasisFile()
      : folder_(fs::temp_directory_path() / ("pounding-basis-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~ModalBasisFile() override { fs::remove_all(folder_); }

  /// What is said of a file with this content; "" if it is read.
  std::string complaint(const Content& content) const {
    const std::string path = folder_ / "basis.h5";
    Hdf5File file(path, Hdf5File::Kind::sealed);
    file.write_attribute("/", "format", "pounding modal basis");
    file.write_attribute("/", "schema", 4);
    file.write_attribute("/", "modes", content.modes);
    file.write_attribute("/", "attachment_vectors", content.attachment_vectors);
    file.write_attribute("/", "residual_vectors", 0);
    file.write_attribute("/", "full_dofs", content.full_dofs);
    file.write_attribute("/", "independent_dofs", content.full_dofs);
    file.write_attribute("/", "largest_without_residual", 0);
    file.write_attribute("/", "total_mass", 10);
    file.write_attribute("/", "mass", 8);
    file.write_array("squared_frequency", 0, std::vector<double>{1, 4, 9});
    file.write_array("mode_numbers", 0, content.mode_numbers);
    file.write_array("participation", 3, std::vector<double>(18, 0.1));
    file.write_array("centre_of_mass", 0, std::vector<double>(3, 0.0));
    file.write_array("inertia", 0, std::vector<double>(6, 1.0));
    file.write_array("points", content.point_columns, content.points);
    file.write_array("rows", 3, std::vector<double>(6, 0.2));
    file.close();
    try {
      const StoredBasis stored = read_modal_basis(path, {});
      EXPECT_EQ(stored.basis->points.size(), 2U);
      return "";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }

 private:
  fs::path folder_;
};

TEST_F(ModalBasisFile, IsRead) {
  EXPECT_EQ(complaint(sound()), "");
}

TEST_F(ModalBasisFile, IsReadWithRotationsAmongItsPlaces) {
  Content content = sound();
  content.points = {3, 3, 3, 5};
  EXPECT_EQ(complaint(content), "");
}

TEST_F(ModalBasisFile, WithHalfAPlaceIsRefused) {
  Content content = sound();
  content.points.push_back(4);
  content.point_columns = 0;
  EXPECT_THAT(complaint(content), testing::HasSubstr("sizes that do not belong together"));
}

TEST_F(ModalBasisFile, WithNumbersThatMustBeWholeIsRefused) {
  const auto spoilt = [&](const std::function<void(Content&)>& spoil) {
    Content content = sound();
    spoil(content);
    return complaint(content);
  };
  const auto refused = testing::HasSubstr("a number that must be whole");
  EXPECT_THAT(spoilt([](Content& c) { c.points[0] = 1e300; }), refused);
  EXPECT_THAT(spoilt([](Content& c) { c.points[0] = -1; }), refused);
  EXPECT_THAT(spoilt([](Content& c) { c.points[1] = 6; }), refused);
  EXPECT_THAT(spoilt([](Content& c) { c.points[3] = 0.5; }), refused);
  EXPECT_THAT(spoilt([](Content& c) { c.mode_numbers[1] = 1e12; }), refused);
  EXPECT_THAT(spoilt([](Content& c) { c.modes = 1e300; }), refused);
  EXPECT_THAT(spoilt([](Content& c) { c.attachment_vectors = -1e10; }), refused);
  EXPECT_THAT(spoilt([](Content& c) { c.full_dofs = 2.5; }), refused);
}

}  // namespace modal_basis_file_test
}  // namespace pounding
