#include "output/result_folder.h"

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.h"

/// A folder of results belongs to one run at a time, and holds what that one left.
namespace pounding {
namespace result_folder_test {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

const std::vector<ResultFile> files{
    {"summary.json", "numbers"},         {"impacts.csv", "impacts"},
    {"spectra.csv", "spectra"},          {"history.h5", "motion", "", true},
    {"modes.h5", "modes", "", true},     {"fields.h5", "fields", "", true},
    {"checkpoint.h5", "state", "", true}};

class Folder : public testing::Test {
 protected:
  Folder() : base_(fs::temp_directory_path() / ("results-" + std::to_string(getpid()))) {
    fs::remove_all(base_);
    fs::create_directories(base_);
  }
  ~Folder() override { fs::remove_all(base_); }

  std::string path() const { return base_ / "run"; }
  void touch(const std::string& name) const { std::ofstream(path() + "/" + name) << "old"; }
  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const fs::directory_entry& entry : fs::directory_iterator(path())) {
      list.push_back(entry.path().filename());
    }
    return list;
  }

 private:
  fs::path base_;
};

TEST_F(Folder, IsOfOneRunAtATime) {
  std::optional<ResultFolder> first(path());
  EXPECT_THAT(names(), ElementsAre("running.lock"));
  try {
    const ResultFolder second{path()};
    FAIL() << "two runs in one folder";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("option -output " + path()));
    EXPECT_THAT(error.what(), testing::HasSubstr("process " + std::to_string(getpid()) + " on "));
  }
  touch("summary.json");
  first.reset();
  EXPECT_THAT(names(), ElementsAre("summary.json"));
  EXPECT_NO_THROW(ResultFolder{path()});
}

TEST_F(Folder, IsFreeAfterItsRunWasKilled) {
  std::array<int, 2> ready{};
  ASSERT_EQ(pipe(ready.data()), 0);
  const pid_t child = fork();
  if (child == 0) {
    const ResultFolder folder(path());
    [[maybe_unused]] const auto told = write(ready[1], "x", 1);
    pause();
  }
  char told = 0;
  ASSERT_EQ(read(ready[0], &told, 1), 1);
  EXPECT_THROW(ResultFolder{path()}, UserError);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_THAT(names(), ElementsAre("running.lock"));
  EXPECT_NO_THROW(ResultFolder{path()});
}

TEST_F(Folder, ThatIsNewAndEmptyIsTakenAwayAgain) {
  { const ResultFolder folder(path()); }
  EXPECT_FALSE(fs::exists(path()));
  fs::create_directories(path());
  { const ResultFolder folder(path()); }
  EXPECT_TRUE(fs::exists(path()));
}

TEST_F(Folder, CannotBeAFile) {
  std::ofstream(path()) << "a file";
  EXPECT_THROW(ResultFolder{path()}, UserError);
}

TEST_F(Folder, LosesWhatAnEarlierRunLeftAndNothingElse) {
  const ResultFolder folder(path());
  EXPECT_THAT(folder.clear("", files), IsEmpty());
  fs::create_directories(path() + "/spectra.csv");  // no file of a run
  for (const char* name : {"summary.json", "history.h5", "checkpoint.h5", "checkpoint.h5.new",
                           "impacts.csv", "notes.txt", "report.html", "basis.h5"}) {
    touch(name);
  }
  EXPECT_THAT(folder.clear("elsewhere/checkpoint.h5", files),
              UnorderedElementsAre("summary.json", "history.h5", "checkpoint.h5",
                                   "checkpoint.h5.new", "impacts.csv"));
  EXPECT_THAT(names(), UnorderedElementsAre("running.lock", "spectra.csv", "notes.txt",
                                            "report.html", "basis.h5"));
}

TEST_F(Folder, KeepsWhatItsRunGoesOnFrom) {
  const ResultFolder folder(path());
  for (const char* name :
       {"summary.json", "history.h5", "checkpoint.h5", "modes.h5", "fields.h5"}) {
    touch(name);
  }
  EXPECT_THAT(folder.clear(path() + "/checkpoint.h5", files), ElementsAre("summary.json"));
  EXPECT_THAT(folder.clear(path() + "/../run/./checkpoint.h5", files), IsEmpty());
  EXPECT_THAT(names(), UnorderedElementsAre("running.lock", "history.h5", "checkpoint.h5",
                                            "modes.h5", "fields.h5"));
}

}  // namespace result_folder_test
}  // namespace pounding
