#include "io/file_seal.h"

#include <filesystem>
#include <fstream>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/hdf5_file.h"
#include "io/hdf5_reader.h"

/// HDF5 sees a sealed file only as it was written.
namespace pounding {
namespace file_seal_test {

namespace fs = std::filesystem;

class FileSeal : public testing::Test {
 protected:
  FileSeal() : path_(fs::temp_directory_path() / ("seal-" + std::to_string(getpid()) + ".h5")) {
    Hdf5File file(path_, Hdf5File::Kind::sealed);
    file.write_array("values", 0, std::vector<double>{1, 2, 3});
    file.write_attribute("/", "format", std::string("a test"));
    file.close();
    std::ifstream written(path_, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(written), {});
  }
  ~FileSeal() override { fs::remove(path_); }

  std::string complaint(const std::string& bytes) const {
    std::ofstream(path_, std::ios::binary) << bytes;
    try {
      Hdf5Reader(path_, Hdf5Reader::Kind::sealed);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  fs::path path_;
  std::string bytes_;
};

TEST_F(FileSeal, IsPassedOver) {
  const Hdf5Reader sealed(path_, Hdf5Reader::Kind::sealed);
  EXPECT_THAT(sealed.array("values"), testing::ElementsAre(1, 2, 3));
  const Hdf5Reader plain(path_);
  EXPECT_EQ(plain.text("/", "format"), "a test");
  EXPECT_EQ(bytes_.substr(0, 22), "pounding seal 1\nbytes ");
  EXPECT_THAT(bytes_, testing::HasSubstr("\nbytes " + std::to_string(bytes_.size() - seal_size)));
}

TEST_F(FileSeal, FindsEveryChange) {
  EXPECT_EQ(complaint(bytes_), "");
  for (std::size_t place = 0; place < bytes_.size(); ++place) {
    std::string bad = bytes_;
    bad[place] = static_cast<char>(bad[place] ^ (1 << place % 8));
    EXPECT_THAT(complaint(bad), testing::HasSubstr("damaged")) << place;
  }
  for (const std::size_t size : {0UL, 100UL, seal_size, bytes_.size() / 2, bytes_.size() - 1}) {
    EXPECT_THAT(complaint(bytes_.substr(0, size)), testing::HasSubstr("damaged")) << size;
  }
  EXPECT_THAT(complaint(bytes_ + "more"), testing::HasSubstr("not the sealed one"));
}

TEST_F(FileSeal, LeavesPlacesOpen) {
  std::int64_t place = 0;
  {
    Hdf5File file(path_, Hdf5File::Kind::sealed);
    file.write_array("values", 0, std::vector<double>{1, 2, 3});
    place = file.reserve("later", {2});
    file.let_others_write();
    file.close({{place + 8, 8}, {place, 8}});  // they touch: one place
  }
  std::ifstream written(path_, std::ios::binary);
  bytes_.assign(std::istreambuf_iterator<char>(written), {});
  EXPECT_THAT(bytes_, testing::HasSubstr("\nopen " + std::to_string(place) + " 16\n"));
  EXPECT_EQ(open_bytes(path_).size(), 1U);
  for (std::size_t at = 0; at < bytes_.size(); ++at) {
    std::string other = bytes_;
    other[at] = static_cast<char>(other[at] ^ (1 << at % 8));
    const bool open =
        at >= static_cast<std::size_t>(place) && at < static_cast<std::size_t>(place) + 16;
    EXPECT_EQ(complaint(other).empty(), open) << at;
  }
}

TEST_F(FileSeal, IsMissingInOtherFiles) {
  { Hdf5File(path_).write_array("values", 0, std::vector<double>{1}); }
  EXPECT_THROW(check_seal(path_), std::runtime_error);
}

}  // namespace file_seal_test
}  // namespace pounding
