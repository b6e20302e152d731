#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "motion/accelerogram.h"
#include "motion_files.h"

namespace pounding {
namespace accelerogram_format_test {

using testing_support::MotionFiles;

class AccelerogramFormat : public MotionFiles {
 protected:
  /// Reads `text` and checks time step and values, given in the unit of `factor` [m/s2].
  void expect(const std::string& text, double time_step, const std::vector<double>& values,
              double factor, RecordedMotion motion = {}) const {
    motion.file = write("record", text);
    const Accelerogram read = read_accelerogram(motion);
    EXPECT_DOUBLE_EQ(read.time_step, time_step);
    ASSERT_EQ(read.acceleration.size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_DOUBLE_EQ(read.acceleration[i], factor * values[i]) << i;
  }

  static RecordedMotion options(const std::string& unit, double time_step = 0, int column = 0) {
    return {"", unit, time_step, column};
  }

  const std::vector<double> seven{0.001, -0.25, 0.5, -0.125, 0.0625, 0.03, -0.01};
  const std::string rows = "  .1E-02  -.25  .5\n  -.125  .0625  .03\n  -.01\n";
  const std::string unit_line = "ACCELERATION TIME SERIES IN UNITS OF G\n";
};

constexpr double g = standard_gravity;

TEST_F(AccelerogramFormat, PeerHeaderInItsStyles) {
  for (const std::string sampling :
       {"NPTS=  7, DT= .02000 SEC", "NPTS=   7, DT=   .0200 SEC,            ",
        "NPTS =   7 , DT =   .020 SEC ,   ", "NPTS=   7, DT=   .0200 SEC    ",
        "NPTS=  7, DT=  .0200 SEC,   0 POLE @    30.00000 HZ,  -5 POLE @      .05000",
        "7    0.0200    NPTS, DT", "npts 7 dt 0.02", "NPTS: 7 DT: 20 msec"})
    expect("A RECORD\nSOMEWHERE 1/2/34, 090\n" + unit_line + sampling + "\n" + rows, 0.02, seven,
           g);
}

TEST_F(AccelerogramFormat, SevenHeaderLinesBlankTailAndEndMark) {
  expect(
      "Data for somewhere\n7 points at equal spacing of 0.02 sec\nformat 8F10.5, i.e., 8 points "
      "in\n"
      "a row\nThe units are (g)\n*** Begin data ***\nNPTS=  7, DT= .02000 SEC\n" +
          rows + "*** End Data ***\n\n\n",
      0.02, seven, g);
}

TEST_F(AccelerogramFormat, LineEndsOfEverySystem) {
  const std::string text = "A RECORD\n" + unit_line + "NPTS=  7, DT= .02 SEC\n" + rows;
  for (const std::string end : {"\r\n", "\r\r\n", "\r", "  \t\n"}) {
    std::string other;
    for (const char c : text) other += c == '\n' ? end : std::string(1, c);
    expect(other, 0.02, seven, g);
  }
  expect(text.substr(0, text.size() - 1), 0.02, seven, g);  // no end of line at the end of the file
}

TEST_F(AccelerogramFormat, SurplusZerosAreDropped) {
  const std::string header = unit_line + "NPTS= 7, DT= .02\n";
  expect(header + "  .1E-02  -.25  .5\n  -.125  .0625  .03\n  -.01  .0\n", 0.02, seven, g);
  expect(header + "  .1E-02  -.25  .5\n  -.125  .0625  .03\n  -.01\t0\t\t0\n 0 0 0\n", 0.02, seven,
         g);
}

TEST_F(AccelerogramFormat, BareColumnTakesUnitAndTimeStepFromTheOptions) {
  expect("1.5\n-2\n+.5D+01\n0\n", 0.01, {1.5, -2, 5, 0}, 0.01, options("cm/s2", 0.01));
}

TEST_F(AccelerogramFormat, BareRowsWithoutHeader) {
  expect(rows, 0.005, seven, 1, options("m/s2", 0.005));
}

TEST_F(AccelerogramFormat, TwoColumnsGiveTheTimeStep) {
  expect("0.00\t0.1\n0.02\t0.2\n0.04\t-0.3\n", 0.02, {0.1, 0.2, -0.3}, g, options("g"));
  expect("   0   0.1\n  2.0000e-002  0.2\n  4.0000e-002  -0.3", 0.02, {0.1, 0.2, -0.3}, 1,
         options("m/s2"));
  expect("a record of 17 January\nTime[s] Accel[g]\n0.0000\t0.1\n0.0100\t0.2\n0.0200\t0.3", 0.01,
         {0.1, 0.2, 0.3}, g);
}

TEST_F(AccelerogramFormat, CommaSeparatedColumnsByNumber) {
  const std::string text = "\xEF\xBB\xBFTime,Xg,Yg,Zg\n0,1,10,100\n0.05,2,20,200\n0.1,3,30,300";
  expect(text, 0.05, {100, 200, 300}, 1, options("m/s2", 0, 4));
  expect(text, 0.05, {1, 2, 3}, 1, options("m/s2", 0, 2));
  expect(text, 0.05, {10, 20, 30}, 1, options("m/s2", 0.05, 3));
  expect("time,acc (g)\n0,0\n0.02,-6.00E-05\n", 0.02, {0, -6e-5}, g);
  expect("0;1\n0.1;2\n0.2;3\n", 0.1, {1, 2, 3}, 0.01, options("cm/s2"));
  expect("north,east\n1,2\n5,3\n4,6\n", 0.1, {1, 5, 4}, 1, options("m/s2", 0.1, 1));
}

TEST_F(AccelerogramFormat, TimeIsFoundBehindAnIndex) {
  expect("index,time,acc\n0,0,1\n1,0.05,2\n2,0.1,3\n", 0.05, {1, 2, 3}, 1, options("m/s2", 0, 3));
  expect("1 0 1\n2 0.05 2\n3 0.1 3\n", 0.05, {1, 2, 3}, 1, options("m/s2", 0, 3));
  expect("1 0.5\n2 0.25\n3 0.5\n", 0.05, {0.5, 0.25, 0.5}, 1, options("m/s2", 0.05));
}

TEST_F(AccelerogramFormat, LongStepsWhereTheOptionSaysSo) {
  expect("0 1\n0.5 2\n1 3\n", 0.5, {1, 2, 3}, 1, options("m/s2", 0.5));
  expect("# unit m/s2, dt = 2\n1\n2\n", 2, {1, 2}, 1, options("", 2));
}

TEST_F(AccelerogramFormat, SaysHowItReadTheFile) {
  const auto read = [&](const std::string& text, RecordedMotion motion) {
    motion.file = write("record", text);
    return read_accelerogram(motion);
  };
  const Accelerogram announced = read(unit_line + "NPTS= 7, DT= .02\n" + rows, {});
  EXPECT_EQ(announced.layout, "rows of 3 values that follow one another");
  EXPECT_EQ(announced.unit, "g (header)");
  EXPECT_TRUE(announced.doubts.empty());
  const Accelerogram bare = read(rows, options("m/s2", 0.02));
  EXPECT_EQ(bare.unit, "m/s2 (as asked)");
  ASSERT_EQ(bare.doubts.size(), 1u);  // three columns would look alike
  EXPECT_EQ(read("t,ax,az\n0,1,3\n0.1,2,4\n", options("m/s2", 0, 3)).layout,
            "column 3 of 3 (az), time in column 1");
  EXPECT_EQ(read("1\n2\n", options("m/s2", 0.1)).layout, "one column");
}

TEST_F(AccelerogramFormat, RoundedTimesKeepTheMeanStep) {
  const double step = 1.0 / 158;
  std::string text;
  std::vector<double> values;
  char line[64];
  for (int i = 0; i <= 400; ++i) {
    std::snprintf(line, sizeof line, "%.4f %d\n", i * step, i);
    text += line;
    values.push_back(i);
  }
  RecordedMotion motion = options("m/s2");
  motion.file = write("rounded", text);
  EXPECT_NEAR(read_accelerogram(motion).time_step, step, 1e-6 * step * 100);
}

TEST_F(AccelerogramFormat, CommentsOfEveryKind) {
  expect(
      "% corrected accelerogram\n% 4 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  "
      "(UNITS: CM/SEC/SEC)\n   1.257   -2.644\n    3.5      4.0\n",
      0.02, {1.257, -2.644, 3.5, 4}, 0.01);
  expect("%place n  17 Jan; somewhere\n%   4    5.00000E-03  0  0  0.  0.\n 1. 2. 3.\n 4. 0. 0.\n",
         0.005, {1, 2, 3, 4}, 0.01, options("cm/s2"));
  expect(
      "; at a station, dt=0.02, time window = 60s, acc. in cm/s/s\n"
      ";NS component, Peak given in unit [g]\n0.02 0.50\n 1 2 3\n 4 5\n",
      0.02, {1, 2, 3, 4, 5}, 0.01);
  expect("# unit: m/s2, dt = 0.1\n1\n# halfway\n2\n", 0.1, {1, 2}, 1);
}

TEST_F(AccelerogramFormat, SamplingInOtherWords) {
  const std::vector<double> three{0.1, -0.2, 0.3};
  for (const std::string words :
       {"Sampling Freq(Hz) 50Hz", "SAMPLING_INTERVAL_S: 0.020000\nNDATA: 3",
        "NO. OF POINTS: 3  EQUALLY SPACED INTERVALS OF: .02 SEC", "50 sps", "#SampleRate(Hz): 50",
        "SAMPLING RATE: 50 samples/s", "at 50 samples/sec", "SAMPLING INTERVAL (sec) : 0.02",
        "Sampling interval (ms): 20", "sampling rate = 0.02 s",
        "VEL. DE MUESTREO, C1-C6 (muestras/s) : /50/50/50",
        "INTERVALO DE MUESTREO, C1-C6 (s) : /.02/.02", "NUMBER OF DATA : 3\nSampling rate 50 Hz",
        "Sampling rate 200 Hz, DT= .02 SEC"}) {
    expect("Acceleration, cm/s2\n" + words + "\n.1\n-.2\n.3\n", 0.02, three, 0.01);
  }
}

TEST_F(AccelerogramFormat, SamplingVelocityIsNoVelocity) {
  expect(
      "ARCHIVO ESTANDAR DE ACELERACION\nVEL. DE MUESTREO, C1 (muestras/s)      : /50\n"
      "UNIDADES DE LOS DATOS                  : Gal (cm/s/s)\n---------+---------\n   CANAL-1\n"
      "---------+---------\n     0.000\n    30.290\n   -56.474\n",
      0.02, {0, 30.29, -56.474}, 0.01);
}

TEST_F(AccelerogramFormat, UnitsOfTablesAndOfOldFilms) {
  expect("Acceleration in mm/s/s\n1\n-2\n3\n", 0.02, {1, -2, 3}, 0.001, options("", 0.02));
  expect("1\n-2\n3\n", 0.02, {1, -2, 3}, 0.001, options("mm/s2", 0.02));
  expect("UNITS ARE SECONDS AND G/10\n 0.00  .1  .02  -.2  .04  .3\n 0.06  .4  .08  -.5\n", 0.02,
         {.1, -.2, .3, .4, -.5}, g / 10);
}

TEST_F(AccelerogramFormat, DecimalCommas) {
  const std::vector<double> values{0, 0.08, -0.14, 0.23};
  expect("acc [m/s2]\n0,00\n0,08\n-0,14\n0,23\n", 0.02, values, 1, options("", 0.02));
  expect("t [s];a [m/s2]\n0,00;0,00\n0,02;0,08\n0,04;-0,14\n0,06;0,23\n", 0.02, values, 1);
  expect("0,00\t0,00\n0,02\t0,08\n0,04\t-0,14\n0,06\t0,23\n", 0.02, values, 1, options("m/s2"));
  expect("dt = 0,02 s; cm/s2\n0,00E+00\n8,00E-02\n-1,40E-01\n2,30E-01\n", 0.02, values, 0.01);
}

TEST_F(AccelerogramFormat, TimesInOtherLanguages) {
  const std::vector<double> values{0.5, 0.08, -0.14, 0.23};
  expect("Zeit (s);a (m/s2)\n0,00;0,50\n0,02;0,08\n0,04;-0,14\n0,06;0,23\n", 0.02, values, 1);
  expect("sec,m/s2\n0.00,0.50\n0.02,0.08\n0.04,-0.14\n0.06,0.23\n", 0.02, values, 1);
}

TEST_F(AccelerogramFormat, AColumnOfComponentsWithoutTimes) {
  const std::string rows =
      "0.01 -1.4 -0.3\n0.04 1.8 0.2\n0.05 -1.8 1.8\n5.5 0.9 -4.1\n-4.4 7.4 0.9\n-11 -0.5 -7.4\n";
  for (const std::string head : {"dt = 0.02 s, units: cm/s2\n", "dt = 0.02 s\nN E Z\n"}) {
    expect(head + rows, 0.02, {0.01, 0.04, 0.05, 5.5, -4.4, -11}, 0.01, options("cm/s2", 0, 1));
    expect(head + rows, 0.02, {-1.4, 1.8, -1.8, 0.9, 7.4, -0.5}, 0.01, options("cm/s2", 0, 2));
  }
}

TEST_F(AccelerogramFormat, TimesRoundedToMilliseconds) {
  std::string text = "t [s], a [m/s2]\n";
  std::vector<double> values;
  char line[64];
  for (int i = 0; i < 128; ++i) {
    std::snprintf(line, sizeof line, "%.3f,%d\n", i / 128.0, i % 5 - 2);
    text += line;
    values.push_back(i % 5 - 2);
  }
  expect(text, 1.0 / 128, values, 1);
}

TEST_F(AccelerogramFormat, TellsComponentAndFirstTime) {
  const auto read = [&](const std::string& text, int column = 0) {
    return read_accelerogram({write("record", text), "", 0, column});
  };
  EXPECT_EQ(read("A STATION 1/17/94, SOMEWHERE, 228\n" + unit_line + "NPTS= 7, DT= .02\n" + rows)
                .component,
            "228");
  EXPECT_EQ(read("STATION: X\nCOMP. N10E\nUNIT: cm/s/s, DT= .02\n1\n-2\n").component, "N10E");
  EXPECT_EQ(read("t, north (g), up (g)\n0,0,2\n.02,.1,3\n", 3).component, "up (g)");
  const Accelerogram late = read("t, north (g)\n3.2,0\n3.22,.1\n3.24,-.1\n");
  EXPECT_DOUBLE_EQ(late.start, 3.2);
  EXPECT_TRUE(late.has_times);
  EXPECT_DOUBLE_EQ(late.end(), 3.24);
  EXPECT_EQ(late.at(3.199), 0);
  EXPECT_NEAR(late.at(3.21), 0.05 * g, 1e-9);
}

TEST_F(AccelerogramFormat, AChannelOfZerosIsDoubted) {
  const Accelerogram dead = read_accelerogram({write("record", "0\n0\n0.0\n0\n"), "m/s2", 0.01, 0});
  ASSERT_EQ(dead.doubts.size(), 1U);
  EXPECT_NE(dead.doubts[0].find("all values are zero"), std::string::npos);
}

TEST_F(AccelerogramFormat, FirstRowMayHoldCountAndTimeStep) {
  expect("name of the motion\n3 0.0100\n1.5E-03\n2.5E-03\n-1E-03\n", 0.01, {1.5e-3, 2.5e-3, -1e-3},
         1, options("m/s2"));
}

TEST_F(AccelerogramFormat, FixedWidthValuesMayTouch) {
  expect(
      "(UNITS: CM/SEC/SEC) 6 POINTS OF ACCEL DATA EQUALLY SPACED AT .02 SEC\n"
      "  1234.567-12345.678123456.789\n-23456.789     1.000     2.000\n",
      0.02, {1234.567, -12345.678, 123456.789, -23456.789, 1, 2}, 0.01);
  expect("-.25E-01-.50E-01 .75E-01\n 0.1E-01 0.2E-01 0.3E-01\n", 0.02,
         {-.025, -.05, .075, .01, .02, .03}, g, options("g", 0.02));
}

TEST_F(AccelerogramFormat, QuotedHeaderOfShake) {
  expect(
      "\"Some Eqk\",\"A place\",\"init. vel:\",\" .307 c/s\",\"disp: -0.016 cm\"\r\n"
      "\"Total No. of Points :\",5,\"@ DT =\",.02\r\n"
      "\"Peak Acceleration (g) =\",.3,\"@ Time (sec) :\",.04\r\n"
      " -0.100000  0.200000  0.300000 -0.100000\r\n  0.050000  0.000000  0.000000  0.000000\r\n",
      0.02, {-.1, .2, .3, -.1, .05}, g);
}

TEST_F(AccelerogramFormat, JsonWithOneZeroTooMany) {
  expect("{\n\"numPoints\": 3,\n\"dT\": 0.02,\n\"accel_data\": [0.1, -0.2, 0.3, 0.0]\n}\n", 0.02,
         {0.1, -0.2, 0.3}, g, options("g"));
}

TEST_F(AccelerogramFormat, AnotherQuantityAfterTheValuesIsLeftOut) {
  expect(
      "NPTS= 6, DT= .02 ACCELERATION (CM/S/S)\n 1. 2.\n 3. 4.\n 5. 6.\n"
      "6 POINTS OF VELOC DATA\n 9. 9.\n",
      0.02, {1, 2, 3, 4, 5, 6}, 0.01);
}

TEST_F(AccelerogramFormat, PeakAndDuration) {
  const Accelerogram a{{0.5, -2, 1}, 0.25};
  EXPECT_EQ(a.peak(), 2);
  EXPECT_EQ(a.duration(), 0.5);
  EXPECT_EQ(Accelerogram{}.duration(), 0);
}

}  // namespace accelerogram_format_test
}  // namespace pounding
