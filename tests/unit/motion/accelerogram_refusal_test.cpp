#include <filesystem>
#include <string>
#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motion/accelerogram.h"
#include "motion_files.h"

namespace pounding {
namespace accelerogram_refusal_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing_support::MotionFiles;
using testing_support::refusal;

class AccelerogramRefusal : public MotionFiles {
 protected:
  std::string refused(const std::string& text, const std::string& unit = "", double time_step = 0,
                      int column = 0) const {
    const std::string file = write("record", text);
    const std::string message = refusal([&] {
      read_accelerogram({file, unit, time_step, column});
    });
    EXPECT_THAT(message, HasSubstr(file));
    return message;
  }

  const std::string header = "A RECORD\nACCELERATION IN UNITS OF G\n";
  const std::string six = " .1 .2 .3\n .4 .5 .6\n";
};

TEST_F(AccelerogramRefusal, MissingEmptyOrUnreadableFile) {
  const std::string missing = (folder_ / "none.AT2").string();
  EXPECT_THAT(refusal([&] {
                read_accelerogram({missing, "g", 0.01, 0});
              }),
              AllOf(HasSubstr(missing), HasSubstr("cannot be opened")));
  EXPECT_THAT(refusal([&] {
                read_accelerogram({folder_.string(), "g", 0.01, 0});
              }),
              HasSubstr("folder"));
  EXPECT_THAT(refused(""), HasSubstr("empty"));
  EXPECT_THAT(refused(" \r\n\n  \n"), HasSubstr("empty"));
  EXPECT_THAT(refused(std::string("1\n\0\n2\n", 6), "g", 0.01), HasSubstr("not a text file"));
  EXPECT_THAT(refused("nothing but words\nand more\n", "g", 0.01), HasSubstr("no line of numbers"));
}

TEST_F(AccelerogramRefusal, HeaderThatBelongsToAnotherRecord) {
  const std::string message = refused(header + "NPTS= 10102, DT= .02 SEC\n" + six);
  EXPECT_THAT(message, AllOf(HasSubstr("10102"), HasSubstr("6 are found")));
}

TEST_F(AccelerogramRefusal, SurplusValuesThatAreNotZero) {
  EXPECT_THAT(refused(header + "NPTS= 5, DT= .02\n" + six), HasSubstr("announces 5 values but 6"));
}

TEST_F(AccelerogramRefusal, FewerValuesThanAnnounced) {
  EXPECT_THAT(refused(header + "NPTS= 7, DT= .02\n" + six), HasSubstr("announces 7 values but 6"));
  EXPECT_THAT(refused("{\"numPoints\": 4, \"dT\": 0.1, \"accel_data\": [1, 2, 3]}", "g"),
              HasSubstr("announces 4 values but 3"));
}

TEST_F(AccelerogramRefusal, CountsAndStepsThatCannotBe) {
  for (const std::string count : {"0", "-6", "1", "6.5", "12345678901", "****", "six"})
    EXPECT_THAT(refused(header + "NPTS= " + count + ", DT= .02\n" + six), HasSubstr("record:3: "))
        << count;
  for (const std::string step : {"0", "-.02", "-1E-2", "****", "none"})
    EXPECT_THAT(refused(header + "NPTS= 6, DT= " + step + "\n" + six), HasSubstr("record:3: "))
        << step;
  EXPECT_THAT(refused(header + "6  0.0  NPTS, DT\n" + six), HasSubstr("not positive"));
  EXPECT_THAT(refused(header + "NPTS= 6, DT= 20\n" + six),
              AllOf(HasSubstr("20 s"), HasSubstr("header"), HasSubstr("time_step")));
  EXPECT_THAT(refused("# unit m/s2, dt = 0.11\n1\n2\n"), HasSubstr("above 0.1 s"));
  const std::string list = "\"accel_data\": [0.1, 0.2, 0.1]}";
  for (const std::string dt : {"0", "-0.01", "2", "\"fast\""})
    refused("{\"dT\": " + dt + ", " + list, "g");
  for (const std::string count : {"-3", "1e300", "2.5", "[]"})
    refused("{\"dT\": 0.01, \"numPoints\": " + count + ", " + list, "g");
}

TEST_F(AccelerogramRefusal, SeveralColumnsOfWhichNoneIsAsked) {
  EXPECT_THAT(refused("time,acc,vel,disp\n0,1,2,3\n0.1,2,3,4\n0.2,3,4,5\n", "m/s2"),
              AllOf(HasSubstr("4 columns (time, acc, vel, disp)"), HasSubstr("time in column 1"),
                    HasSubstr("give column: 2, 3 or 4")));
  EXPECT_THAT(refused("0 1 2 3\n0.1 2 3 4\n0.2 3 4 5\n", "m/s2"), HasSubstr("give column"));
  EXPECT_THAT(refused("1 0 1\n2 0.05 2\n3 0.1 3\n", "m/s2"), HasSubstr("time in column 2"));
}

/// A column is no time because it is the first, nor a name of a component one of a time.
TEST_F(AccelerogramRefusal, ComponentsWithoutTimes) {
  const std::string head = "dt = 0.02 s, units: cm/s2\n";
  const std::string two =
      "3.0 11.8\n3.1 13.8\n2.6 15.3\n1.2 16.0\n-1.2 15.6\n-4.9 13.8\n-9.9 10.4\n";
  for (const std::string names : {"NS EW\n", "R T\n", ""}) {
    EXPECT_THAT(refused(head + names + two, ""),
                AllOf(HasSubstr("none of them a time"), HasSubstr("give column: 1 or 2")))
        << names;
  }
  const std::string three =
      "3.0 11.8 0.1\n3.1 13.8 0.2\n2.6 15.3 0.3\n1.2 16.0 0.2\n-1.2 15.6 0.1\n";
  EXPECT_THAT(refused(head + "N-S E-W U-D\n" + three, ""), HasSubstr("give column: 1, 2 or 3"));
}

TEST_F(AccelerogramRefusal, TimesThatAreNotSeconds) {
  const std::string milliseconds = "0 1\n10 2\n20 3\n30 4\n";
  EXPECT_THAT(refused(milliseconds, "g"), AllOf(HasSubstr("10 s"), HasSubstr("time column")));
  EXPECT_THAT(refused(milliseconds, "g", 0.01), HasSubstr("contradict"));
  EXPECT_THAT(refused("index,acc\n1,1\n2,2\n3,3\n", "g"), HasSubstr("give time_step"));
  EXPECT_THAT(refused("1 1\n2 2\n3 3\n", "g"), HasSubstr("give time_step"));
}

TEST_F(AccelerogramRefusal, HeaderThatContradictsItself) {
  EXPECT_THAT(refused(header + "NPTS= 6, DT= .02\n6 points at equal spacing of .01 sec\n" + six),
              HasSubstr("record:4: "));
  EXPECT_THAT(refused(header + "NPTS= 6, DT= .02\nNPTS= 7\n" + six), HasSubstr("record:4: "));
  EXPECT_THAT(refused(header + "NPTS= 6, DT= 0.0\n" + six), HasSubstr("record:3: "));
}

TEST_F(AccelerogramRefusal, WordsAndNumbersThatAreNotFinite) {
  for (const std::string word :
       {"abc", "nan", "-NaN", "inf", "1e999", "0x10", "1.2.3", "1,5", "--1"}) {
    EXPECT_THAT(refused(header + "NPTS= 6, DT= .02\n .1 .2 .3\n .4 " + word + " .6\n"),
                HasSubstr("record:5: "))
        << word;
    EXPECT_THAT(refused(header + "NPTS= 6, DT= .02\n .1 " + word + " .3\n .4 .5 .6\n"),
                HasSubstr("record:4: "))
        << word;
  }
  EXPECT_THAT(refused("0.1\nnan\n0.2\n0.3\n0.4\n", "g", 0.01), HasSubstr("record:2: 'nan'"));
  EXPECT_THAT(refused("nan\n0.2\n0.3\n0.4\n", "g", 0.01), HasSubstr("record:1: 'nan'"));
  EXPECT_THAT(refused("0 1\n0.1 abc\n0.2 3\n0.3 3\n", "g"), HasSubstr("record:2: 'abc'"));
  EXPECT_THAT(refused("t,a\n0,abc\n0.1,2\n0.2,3\n", "g"), HasSubstr("record:2: 'abc'"));
  EXPECT_THAT(refused("t,a\n0,1\n0.1,\n0.2,3\n0.3,3\n0.4,3\n", "g"), HasSubstr("record:3: "));
}

TEST_F(AccelerogramRefusal, NumbersOfAHeader) {
  const std::string below = "values of acceleration in g follow\n .1 .2\n .3 .4\n";
  EXPECT_THAT(refused("A RECORD\n 1 2 3 4\n 5 6 7 8\n" + below, "", 0.01),
              AllOf(HasSubstr("record:4: a line of words"), HasSubstr("from line 2")));
  std::string values;
  for (int i = 0; i < 12; ++i) values += "   0.1  -0.2   0.3  -0.4   0.5\n";
  EXPECT_THAT(
      refused("A RECORD\n 2020 1 2 3 4\n 40 0 0 175 0\n  1.25 0.02 0.00 9806.65 1.00\n" + values,
              "cm/s2", 0.02),
      AllOf(HasSubstr("record:2: "), HasSubstr("down to line 4"), HasSubstr("header")));
  EXPECT_THAT(refused("A RECORD\n 2020 1 2 3 4 5\n" + values, "cm/s2", 0.02),
              HasSubstr("record:3: 5 numbers where the lines before have 6"));
  EXPECT_THAT(refused("NPTS= 66, DT= .02\n 1 2 3 4 5 6\n" + values, "cm/s2"),
              HasSubstr("record:3: 5 numbers"));
}

TEST_F(AccelerogramRefusal, CountsAndOffsets) {
  EXPECT_THAT(refused("units: counts\n100\n200\n-300\n", "cm/s2", 0.02), HasSubstr("counts"));
  EXPECT_THAT(refused("Scale Factor 3920(gal)/6182761\n100\n200\n-300\n", "cm/s2", 0.02),
              HasSubstr("record:1: the values are counts"));
  std::string counts;
  for (int i = 0; i < 200; ++i) counts += std::to_string(-10700 + i * 37 % 900) + "\n";
  EXPECT_THAT(refused(counts, "cm/s2", 0.01), HasSubstr("all values lie about"));
}

TEST_F(AccelerogramRefusal, ACommaOfWhichNothingTells) {
  EXPECT_THAT(refused("3,1\n2,5\n4,2\n", "g", 0.01), HasSubstr("a decimal comma, or two columns?"));
}

TEST_F(AccelerogramRefusal, WhatHasNoEnd) {
  for (const std::string device : {"/dev/zero", "/dev/null"}) {
    EXPECT_THAT(refusal([&] {
                  read_accelerogram({device, "g", 0.01, 0});
                }),
                AllOf(HasSubstr(device), HasSubstr("device")));
  }
  const std::string pipe = (folder_ / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(refusal([&] { read_accelerogram({pipe, "g", 0.01, 0}); }), HasSubstr("a pipe"));
  std::filesystem::resize_file(write("huge", "1\n"), std::uintmax_t{1} << 40);
  EXPECT_THAT(refusal([&] {
                read_accelerogram({(folder_ / "huge").string(), "g", 0.01, 0});
              }),
              HasSubstr("MB"));
  EXPECT_THAT(refused(std::string("PK\x03\x04\0\0", 6), "g", 0.01), HasSubstr("spreadsheet"));
}

TEST_F(AccelerogramRefusal, MissingColumnsAndValues) {
  EXPECT_THAT(refused("0 1\n0.1 2\n0.2\n0.3 4\n", "g"), HasSubstr("record:3: 1 numbers"));
  EXPECT_THAT(refused("0 1\n0.1 2\n0.2 3\n0.3\n", "g"), HasSubstr("record:4: 1 numbers"));
  EXPECT_THAT(refused("1 2 9\n3 4\n5 6 7\n", "g", 0.01), HasSubstr("record:2: 2 numbers"));
  EXPECT_THAT(refused("1\n2\n\n3\n", "g", 0.01), HasSubstr("record:3: empty line"));
  EXPECT_THAT(refused("0 1\n0.1 2\n0.2 3\n", "g", 0, 3), HasSubstr("column 3"));
  EXPECT_THAT(refused("0 1\n0.1 2\n0.2 3\n", "g", 0, 1), HasSubstr("column 1 is the time"));
  EXPECT_THAT(refused("7\n", "g", 0.01), HasSubstr("at least 2"));
}

TEST_F(AccelerogramRefusal, VelocityAndSpectra) {
  EXPECT_THAT(refused("A RECORD\nVELOCITY TIME SERIES IN UNITS OF CM/S\nNPTS= 6, DT= .02\n" + six),
              AllOf(HasSubstr("record:2: "), HasSubstr("velocity")));
  EXPECT_THAT(refused("A RECORD\nDISPLACEMENT TIME SERIES IN UNITS OF CM\nNPTS= 6, DT= .02\n" + six,
                      "cm/s2"),
              HasSubstr("velocity or displacement"));
  EXPECT_THAT(refused("# unit cm/s\n0 1\n0.1 2\n0.2 3\n", "cm/s2"), HasSubstr("velocity"));
  EXPECT_THAT(refused("time,acc (g),vel (cm/s)\n0,1,2\n0.1,2,3\n0.2,3,4\n", "", 0, 3),
              HasSubstr("velocity"));
  EXPECT_THAT(refused("Period [s],Spectral Acceleration [g]\n0,1\n0.1,2\n0.2,3\n"),
              HasSubstr("spectrum"));
}

TEST_F(AccelerogramRefusal, TimesThatAreNotUniform) {
  EXPECT_THAT(refused("0 1\n0.1 2\n0.2 3\n0.4 4\n0.5 5\n0.6 6\n", "g"), HasSubstr("uniform step"));
  EXPECT_THAT(refused("0 1\n0.1 2\n0.1 3\n0.2 4\n", "g"), HasSubstr("record:3: time 0.1"));
  EXPECT_THAT(refused("0 1\n0.2 2\n0.1 3\n0.3 4\n", "g"), HasSubstr("times must increase"));
  EXPECT_THAT(refused("0 1 5\n1 2 6\n3 3 7\n7 1 1\n", "g", 0, 2), HasSubstr("uniform step"));
}

TEST_F(AccelerogramRefusal, OneLineMissingFromALongTimeColumn) {
  std::string text;
  for (int i = 0; i < 2000; ++i)
    if (i != 700) text += std::to_string(0.01 * i) + " 1\n";
  EXPECT_THAT(refused(text, "g"), HasSubstr("record:701: "));
}

TEST_F(AccelerogramRefusal, UnknownOrContradictoryTimeStep) {
  EXPECT_THAT(refused("1\n2\n3\n", "g"), HasSubstr("give time_step"));
  EXPECT_THAT(refused(header + "NPTS= 6, DT= .02\n" + six, "", 0.01), HasSubstr("contradict"));
  EXPECT_THAT(refused("0 1\n0.1 2\n0.2 3\n", "g", 0.2), HasSubstr("contradict"));
  EXPECT_THAT(refused("1\n2\n3\n", "g", -0.1), HasSubstr("must be positive"));
}

TEST_F(AccelerogramRefusal, UnknownOrContradictoryUnit) {
  EXPECT_THAT(refused("1\n2\n3\n", "", 0.01), HasSubstr("give unit"));
  EXPECT_THAT(refused(header + "NPTS= 6, DT= .02\n" + six, "cm/s2"),
              AllOf(HasSubstr("cm/s2"), HasSubstr("header says g")));
  EXPECT_THAT(refused("1\n2\n3\n", "inch/s2", 0.01), HasSubstr("unknown unit inch/s2"));
  EXPECT_THAT(refused("# a in g, was in m/s2\n1\n2\n", "", 0.01), HasSubstr("several units"));
  EXPECT_THAT(refused("100\n-800\n300\n", "g", 0.01), HasSubstr("800 g"));
}

}  // namespace accelerogram_refusal_test
}  // namespace pounding
