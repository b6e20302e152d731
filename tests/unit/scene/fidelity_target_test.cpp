#include "scene/fidelity_target.h"

#include <cstdio>
#include <fstream>
#include <string>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.h"
#include "support/refusal.h"

namespace pounding {
namespace {

const char* const key = "abc";

/// A table of settings in a file of its own.
class Table {
 public:
  explicit Table(const std::string& rows) {
    std::ofstream(path_) << "# structures: abc two towers\nsetting,rms,cost,options\n" << rows;
  }
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;
  ~Table() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_ = testing::TempDir() + "fidelity-" + std::to_string(getpid()) + ".csv";
};

const char* const measured =
    "full,0,15,\n"
    "few,0.08,0.1,model=modal modal_vectors=40\n"
    "many,0.03,0.5,model=modal modal_vectors=400\n"
    "scaled,0.02,2,mass_scaling=2e-5 -courant=0.99\n";

OptionsDatabase scene_with(const Table& table, const std::string& target) {
  return {
      {"structures", "left,right"}, {"fidelity_target", target}, {"fidelity_table", table.path()}};
}

std::string message_of(const OptionsDatabase& options) {
  return testing_support::refusal_of([&] { choose_fidelity(options, key); });
}

TEST(FidelityTarget, TakesTheFastestWithinItForEveryStructure) {
  const Table table(measured);
  const ChosenFidelity chosen = choose_fidelity(scene_with(table, "0.05"), key);
  EXPECT_EQ(chosen.options.at("left_model"), "modal");
  EXPECT_EQ(chosen.options.at("right_modal_vectors"), "400");
  EXPECT_THAT(chosen.note, testing::HasSubstr("'many'"));
  EXPECT_THAT(chosen.note, testing::HasSubstr("3 % from full order"));
  EXPECT_EQ(choose_fidelity(scene_with(table, "0.2"), key).options.at("left_modal_vectors"), "40");
}

TEST(FidelityTarget, SetsOptionsOfTheRun) {
  const Table table(measured);
  const ChosenFidelity chosen = choose_fidelity(scene_with(table, "0.025"), key);
  EXPECT_EQ(chosen.options.at("courant"), "0.99");
  EXPECT_EQ(chosen.options.at("left_mass_scaling"), "2e-5");
}

TEST(FidelityTarget, TakesFullOrderWhereNothingElseWillDo) {
  const Table table(measured);
  const OptionsDatabase given = scene_with(table, "0.001");
  const ChosenFidelity chosen = choose_fidelity(given, key);
  EXPECT_EQ(chosen.options, given);
  EXPECT_THAT(chosen.note, testing::HasSubstr("nothing to change"));
}

TEST(FidelityTarget, PassesOverWhatTheUserAskedOtherwise) {
  const Table table(measured);
  OptionsDatabase given = scene_with(table, "0.05");
  given["left_modal_vectors"] = "400.0";
  EXPECT_THAT(choose_fidelity(given, key).note, testing::HasSubstr("'many'"));
  given["left_modal_vectors"] = "77";
  const ChosenFidelity chosen = choose_fidelity(given, key);
  EXPECT_EQ(chosen.options.at("left_modal_vectors"), "77");
  EXPECT_EQ(chosen.options.at("right_mass_scaling"), "2e-5");
  EXPECT_THAT(chosen.note, testing::HasSubstr("'scaled'"));
  given["courant"] = "0.5";
  EXPECT_THAT(choose_fidelity(given, key).note, testing::HasSubstr("'full'"));
}

TEST(FidelityTarget, WithoutItNothingChanges) {
  const OptionsDatabase given{{"structures", "left"}};
  const ChosenFidelity chosen = choose_fidelity(given, key);
  EXPECT_EQ(chosen.options, given);
  EXPECT_EQ(chosen.note, "");
}

TEST(FidelityTarget, RefusesOtherStructuresThanThoseMeasured) {
  const Table table(measured);
  const auto message = [&](const std::string& path) {
    return testing_support::refusal_of([&] {
      choose_fidelity(
          {{"structures", "left"}, {"fidelity_target", "0.05"}, {"fidelity_table", path}}, "def");
    });
  };
  EXPECT_THAT(message(table.path()),
              testing::AllOf(testing::HasSubstr("two towers; key abc, of this scene def"),
                             testing::HasSubstr("docs/fidelity.md")));
  const std::string unknown = testing::TempDir() + "fidelity_target_unknown.csv";
  std::ofstream(unknown) << "setting,rms,cost,options\n" << measured;
  EXPECT_THAT(message(unknown), testing::HasSubstr("does not say on which structures"));
  std::remove(unknown.c_str());
}

TEST(FidelityTarget, RefusesWhatItCannotRead) {
  OptionsDatabase lost = {
      {"structures", "left"}, {"fidelity_target", "0.1"}, {"fidelity_table", "nowhere.csv"}};
  EXPECT_THAT(message_of(lost), testing::HasSubstr("nowhere.csv: no such file"));
  const Table coarse("few,0.08,0.1,model=modal\n");
  EXPECT_THAT(message_of(scene_with(coarse, "0.01")), testing::HasSubstr("is that accurate"));
  EXPECT_THAT(message_of(scene_with(coarse, "-1")), testing::HasSubstr("fidelity_target"));
  const Table spoiled("few,much,0.1,model=modal\n");
  EXPECT_THAT(message_of(scene_with(spoiled, "0.1")), testing::HasSubstr("line 3"));
  const Table nameless("few,0.08,0.1,modal\n");
  EXPECT_THAT(message_of(scene_with(nameless, "0.1")), testing::HasSubstr("not name=value"));
}

}  // namespace
}  // namespace pounding
