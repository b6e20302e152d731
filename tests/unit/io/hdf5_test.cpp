#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/hdf5_file.h"
#include "io/hdf5_reader.h"

/// What is written is read back, and what is damaged is refused.
namespace pounding {
namespace hdf5_test {

namespace fs = std::filesystem;

class Hdf5 : public testing::Test {
 protected:
  Hdf5() : folder_(fs::temp_directory_path() / ("pounding-hdf5-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~Hdf5() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ / name; }

  /// A file with one array of 1000 rows.
  std::string array_file() const {
    std::vector<double> values(3000);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = 0.1 * static_cast<double>(i);
    }
    Hdf5File file(path("array.h5"));
    file.write_array("group/array", 3, values);
    file.close();
    return path("array.h5");
  }

  /// What the reader says about a file of these bytes.
  std::string complaint(const std::string& bytes) const {
    const std::string name = path("damaged.h5");
    std::ofstream(name, std::ios::binary) << bytes;
    try {
      Hdf5Reader(name).array("group/array");
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

 private:
  fs::path folder_;
};

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_F(Hdf5, ReadsWhatWasWritten) {
  {
    Hdf5File file(path("all.h5"));
    file.write_array("a/b/table", 2, std::vector<double>{1, 2, 3, 4, 5, 6});
    file.write_array("a/vector", 0, std::vector<double>{7, 8});
    file.write_array("a/empty", 4, {});
    file.write_strings("names", {"one", "three three"});
    file.write_strings("no_names", {});
    file.write_attribute("/", "title", std::string("a title"));
    file.write_attribute("a/b", "number", 0.1);
    file.close();
  }
  const Hdf5Reader reader(path("all.h5"));
  EXPECT_THAT(reader.names("/"), testing::ElementsAre("a", "names", "no_names"));
  EXPECT_THAT(reader.names("a"), testing::ElementsAre("b", "empty", "vector"));
  EXPECT_THAT(reader.names("nothing"), testing::IsEmpty());
  EXPECT_EQ(reader.shape("a/b/table").rows, 3u);
  EXPECT_EQ(reader.shape("a/b/table").columns, 2u);
  EXPECT_EQ(reader.shape("a/vector").columns, 0u);
  EXPECT_THAT(reader.array("a/b/table"), testing::ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(reader.rows("a/b/table", 1, 1), testing::ElementsAre(3, 4));
  EXPECT_THAT(reader.array("a/vector"), testing::ElementsAre(7, 8));
  EXPECT_THAT(reader.array("a/empty"), testing::IsEmpty());
  EXPECT_THAT(reader.strings("names"), testing::ElementsAre("one", "three three"));
  EXPECT_THAT(reader.strings("no_names"), testing::IsEmpty());
  EXPECT_EQ(reader.text("/", "title"), "a title");
  EXPECT_EQ(reader.number("a/b", "number"), 0.1);
}

TEST_F(Hdf5, NamesWhatIsNotThere) {
  const Hdf5Reader reader(array_file());
  EXPECT_THROW(reader.array("other"), std::runtime_error);
  EXPECT_THROW(reader.rows("group/array", 999, 2), std::runtime_error);
  EXPECT_THROW(reader.strings("group/array"), std::runtime_error);
  EXPECT_THROW(reader.number("/", "number"), std::runtime_error);
  EXPECT_THROW(reader.text("group", "text"), std::runtime_error);
  EXPECT_THROW(Hdf5Reader(path("nothing.h5")), std::runtime_error);
}

TEST_F(Hdf5, RefusesDamagedFiles) {
  const std::string good = bytes_of(array_file());
  EXPECT_EQ(complaint(good), "");
  EXPECT_THAT(complaint("no file of HDF5"), testing::HasSubstr("not an HDF5 file"));
  EXPECT_THAT(complaint(good.substr(0, good.size() / 2)), testing::HasSubstr("truncated"));
  // Every flipped bit in the superblock, in the data and at the end is found.
  for (const std::size_t place : {std::size_t{20}, good.size() / 2, good.size() - 1}) {
    std::string bad = good;
    bad[place] = static_cast<char>(bad[place] ^ 1);
    EXPECT_NE(complaint(bad), "") << place << " of " << good.size();
  }
}

/// A copy taken while the file is open is what a killed program leaves.
TEST_F(Hdf5, GrowingFileIsReadableWheneverItsWriterIsKilled) {
  std::vector<double> row(5, 0.0);
  Hdf5File file(path("growing.h5"));
  file.create_dataset("time", 0, "s");
  file.create_dataset("motion", row.size(), "m");
  file.stay_readable();
  for (int i = 0; i < 20000; ++i) {
    row[4] = i;
    file.append("time", {row.data() + 4, 1});
    file.append("motion", row);
    if (i % 5000 != 4999) {
      continue;
    }
    file.flush();
    for (int more = 0; more < 3; ++more) {  // not flushed
      file.append("time", {row.data(), 1});
    }
    fs::copy(path("growing.h5"), path("left.h5"), fs::copy_options::overwrite_existing);
    EXPECT_THROW(Hdf5Reader(path("left.h5")), std::runtime_error);
    const Hdf5Reader reader(path("left.h5"), Hdf5Reader::Kind::left_open);
    EXPECT_GE(reader.shape("time").rows, static_cast<std::size_t>(i));
    EXPECT_EQ(reader.rows("motion", static_cast<std::size_t>(i), 1)[4], i);
  }
  file.move_to(path("moved.h5"));
  file.close();
  EXPECT_EQ(Hdf5Reader(path("moved.h5")).shape("motion").rows, 20000u);
  EXPECT_FALSE(fs::exists(path("growing.h5")));
}

}  // namespace hdf5_test
}  // namespace pounding
