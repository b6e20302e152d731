#include "scene/command_line.h"

#include <gmock/gmock.h>

#include "common/error.h"
#include "support/refusal.h"

namespace pounding {
namespace command_line_test {

CommandLine read(const std::vector<std::string>& words) {
  return read_command_line(words);
}

std::string refusal(const std::vector<std::string>& words) {
  return testing_support::refusal_of([&] { read(words); });
}

TEST(CommandLine, NamesTakeOneValueOrNone) {
  const CommandLine line = read({"-end_time", "25", "-dry_run", "-options_file", "a.yaml",
                                 "-courant", "0.5", "-options_file", "b.yaml", "-write_modes"});
  EXPECT_EQ(line.options,
            (OptionsDatabase{
                {"end_time", "25"}, {"dry_run", ""}, {"courant", "0.5"}, {"write_modes", ""}}));
  EXPECT_EQ(line.files, (std::vector<std::string>{"a.yaml", "b.yaml"}));
  EXPECT_FALSE(line.help || line.version);
}

TEST(CommandLine, ValuesMayBeNegative) {
  const CommandLine line =
      read({"-a", "-3", "-b", "-.5,-2", "-c", "-1e3", "-d", "-inf", "-e", "--2"});
  EXPECT_EQ(
      line.options,
      (OptionsDatabase{{"a", "-3"}, {"b", "-.5,-2"}, {"c", "-1e3"}, {"d", "-inf"}, {"e", "--2"}}));
}

TEST(CommandLine, LastOfTheSameNameCounts) {
  EXPECT_EQ(read({"-a", "1", "-a", "2"}).options.at("a"), "2");
}

TEST(CommandLine, HelpAndVersion) {
  for (const char* word : {"-help", "--help", "-h"}) {
    EXPECT_TRUE(read({"-a", "1", word}).help) << word;
    EXPECT_TRUE(read({"case.yaml", word}).help) << word;
  }
  for (const char* word : {"-version", "--version"}) {
    EXPECT_TRUE(read({word}).version) << word;
  }
  EXPECT_THAT(version_text(), testing::StartsWith("pounding "));
}

TEST(CommandLine, StrayWordsAreRefusedWithAdvice) {
  EXPECT_THAT(refusal({"case.yaml"}), testing::HasSubstr("did you mean -options_file case.yaml?"));
  EXPECT_THAT(refusal({"-options_file", "a.yaml", "b.yml"}),
              testing::HasSubstr("did you mean -options_file b.yml?"));
  EXPECT_THAT(refusal({"end_time=0.1"}), testing::HasSubstr("did you mean -end_time 0.1?"));
  EXPECT_THAT(refusal({"-end_time=0.1"}), testing::HasSubstr("write -end_time 0.1"));
  EXPECT_THAT(refusal({"-end_time", "1", "2"}), testing::HasSubstr("'2'"));
  EXPECT_THAT(refusal({"-"}), testing::HasSubstr("'-'"));
  EXPECT_THAT(refusal({""}), testing::HasSubstr("no option"));
  EXPECT_THAT(refusal({"-options_file"}), testing::HasSubstr("needs a file"));
  EXPECT_THAT(refusal({"-options_file", "-dry_run"}), testing::HasSubstr("needs a file"));
}

TEST(CommandLine, VariablesOfPetscAreNamed) {
  unsetenv("PETSC_OPTIONS");
  EXPECT_TRUE(ignored_variables().empty());
  setenv("PETSC_OPTIONS", "-lowest_eps_tol 1", 1);
  EXPECT_THAT(ignored_variables(),
              testing::ElementsAre(testing::HasSubstr("PETSC_OPTIONS (-lowest_eps_tol 1)")));
  unsetenv("PETSC_OPTIONS");
}

}  // namespace command_line_test
}  // namespace pounding
