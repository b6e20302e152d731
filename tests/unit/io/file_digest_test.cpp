#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

#include <gtest/gtest.h>

#include "common/error.h"
#include "io/file_seal.h"

namespace pounding {
namespace file_digest_test {

class Digest : public testing::Test {
 protected:
  Digest() { std::filesystem::create_directories(folder_); }
  ~Digest() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& text) const {
    const std::string path = (folder_ / "file").string();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("pounding-digest-" + std::to_string(getpid()));
};

TEST_F(Digest, IsThatOfTheExamplesOfTheStandard) {
  const FileDigest abc = digest_of_file(write("abc"));
  EXPECT_EQ(abc.bytes, 3u);
  EXPECT_EQ(abc.sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digest_of_file(write("")).sha256,
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  // A million times the letter a: more than one block is no whole number of blocks.
  const FileDigest million = digest_of_file(write(std::string(1000000, 'a')));
  EXPECT_EQ(million.bytes, 1000000u);
  EXPECT_EQ(million.sha256, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_F(Digest, OfManyBlocksHasAllOfThem) {
  const std::string text(5 << 20, 'x');
  const FileDigest whole = digest_of_file(write(text));
  EXPECT_EQ(whole.bytes, text.size());
  std::string changed = text;
  changed.back() = 'y';
  EXPECT_NE(digest_of_file(write(changed)).sha256, whole.sha256);
}

TEST_F(Digest, RefusesWhatIsNotThere) {
  EXPECT_THROW(digest_of_file((folder_ / "none").string()), UserError);
}

}  // namespace file_digest_test
}  // namespace pounding
