#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motion/accelerogram.h"
#include "motion_files.h"
#include "record_writers.h"

namespace pounding {
namespace record_formats_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing_support::MotionFiles;
using testing_support::refusal;
using namespace record_writers;

class RecordFormats : public MotionFiles {
 protected:
  Accelerogram read(const std::string& text, int column = 0, const std::string& unit = "",
                    double time_step = 0) const {
    return read_accelerogram({write("record", text), unit, time_step, column});
  }
  std::string refused(const std::string& text, int column = 0, const std::string& unit = "",
                      double time_step = 0) const {
    return refusal([&] { read(text, column, unit, time_step); });
  }
  /// Values of `wave()` times `factor`, each to half of the last decimal that the file has.
  static void expect_wave(const Accelerogram& record, double factor, double tolerance) {
    EXPECT_DOUBLE_EQ(record.time_step, 0.02);
    const std::vector<double> expected = wave();
    ASSERT_EQ(record.acceleration.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(record.acceleration[i], factor * expected[i], tolerance) << i;
    }
    EXPECT_TRUE(record.doubts.empty());
  }
};

TEST_F(RecordFormats, KnetIsCountsByScaleLessTheirMean) {
  constexpr double scale = 3920.0 / 6182761;  // gal
  const Accelerogram record = read(knet(wave_of_mean_zero(), 20000));
  EXPECT_EQ(record.acceleration.size(), wave().size());
  for (std::size_t i = 0; i < record.acceleration.size(); ++i) {
    EXPECT_NEAR(record.acceleration[i], 0.01 * wave_of_mean_zero()[i], 0.01 * scale) << i;
  }
  EXPECT_EQ(record.component, "N-S");
  EXPECT_EQ(record.unit, "cm/s2 (header)");
  EXPECT_THAT(record.layout, HasSubstr("3920/6182761"));
  EXPECT_THAT(refused(knet(wave_of_mean_zero(), 20000), 2), HasSubstr("1 component"));
  EXPECT_THAT(refused(knet(wave_of_mean_zero(), 20000), 0, "g"), HasSubstr("header says cm/s2"));
  EXPECT_THAT(refused(knet(wave_of_mean_zero(), 20000), 0, "", 0.01), HasSubstr("contradict"));
  std::string other = knet(wave_of_mean_zero(), 20000);
  other.replace(other.find("3920"), 4, "7840");
  EXPECT_THAT(refused(other), HasSubstr("states a peak"));
}

TEST_F(RecordFormats, KeysAndOneColumn) {
  const Accelerogram record = read(keyed(wave()));
  expect_wave(record, 0.01, 1e-8);
  EXPECT_EQ(record.component, "HNE");
  EXPECT_THAT(refused(keyed(wave()) + "1.0\n"), HasSubstr("there are more"));
  std::string velocity = keyed(wave());
  velocity.replace(velocity.find("DATA_TYPE: ACCELERATION"), 23, "DATA_TYPE: VELOCITY    ");
  EXPECT_THAT(refused(velocity), HasSubstr("velocity"));
  const std::string text = keyed(wave());
  EXPECT_THAT(refused(text.substr(0, text.size() - 20)), HasSubstr("64 values but"));
}

TEST_F(RecordFormats, NewZealand) {
  for (const bool rest : {false, true}) {
    const std::string text = geonet(wave(), "N10E", rest) + geonet(scaled(wave(), 2), "Up", rest);
    const Accelerogram first = read(text, 1);
    expect_wave(first, 0.001, 0.5e-4 * 1.001);
    EXPECT_EQ(first.component, "N10E");
    expect_wave(read(text, 2), 0.002, 0.5e-4 * 1.001);
    EXPECT_THAT(refused(text), AllOf(HasSubstr("2 components (1: N10E, 2: Up)"),
                                     HasSubstr("give column: 1 to 2")));
  }
  // numbers in mm/s2 may be asked for as m/s2, by those who scale them
  const Accelerogram scaled_by_hand = read(geonet(wave(), "N10E", false), 0, "m/s2");
  EXPECT_NEAR(scaled_by_hand.peak(), peak_of(wave()), 0.05);
  ASSERT_EQ(scaled_by_hand.doubts.size(), 1U);
  EXPECT_THAT(scaled_by_hand.doubts[0], HasSubstr("mm/s2"));
  std::string contradiction = geonet(wave(), "N10E", false);
  contradiction.replace(contradiction.find("points  64"), 10, "points  60");
  EXPECT_THAT(refused(contradiction), HasSubstr("60 points"));
  std::string shifted = geonet(wave(), "N10E", false);
  shifted.replace(shifted.find("peak "), 5, "peak 9");
  EXPECT_THAT(refused(shifted), HasSubstr("states a peak"));
}

TEST_F(RecordFormats, BlocksOfCalifornia) {
  for (const bool corrected : {true, false}) {
    const std::string text =
        csmip(corrected ? wave() : scaled(wave(), 1e-3), 1, "90 Deg", corrected);
    const Accelerogram one = read(text);
    expect_wave(one, corrected ? 0.01 : 1e-3 * standard_gravity, corrected ? 1e-8 : 1e-5);
    EXPECT_EQ(one.component, "Chan 1: 90 Deg");
  }
  const std::string two =
      csmip(wave(), 1, "90 Deg", true) + csmip(scaled(wave(), 1.5), 2, "Up", true);
  expect_wave(read(two, 2), 0.015, 1e-8);
  EXPECT_THAT(refused(two), HasSubstr("2 components (1: Chan 1: 90 Deg, 2: Chan 2: Up)"));
  EXPECT_THAT(refused(two, 3), HasSubstr("not 3"));
}

TEST_F(RecordFormats, Cosmos) {
  const Accelerogram record = read(cosmos(wave(), "cm/s^2"));
  expect_wave(record, 0.01, 1e-7);
  EXPECT_EQ(record.component, "Chan 1: 90 deg");
  expect_wave(read(cosmos(wave(), "cm/sec2 (04)")), 0.01, 1e-7);
  EXPECT_THAT(refused(cosmos(wave(), "counts(50)")), HasSubstr("volume 0"));
}

TEST_F(RecordFormats, TenthsOfGOfIran) {
  const std::vector<double> small = scaled(wave(), 1e-3);
  for (const bool pairs : {false, true}) {
    const std::string text = bhrc(small, "L 324", pairs) + bhrc(scaled(small, 2), "V", pairs);
    expect_wave(read(text, 1), 1e-4 * standard_gravity, 1e-5);
    expect_wave(read(text, 2), 2e-4 * standard_gravity, 2e-5);
    EXPECT_EQ(read(text, 1).component, "L 324");
    EXPECT_THAT(refused(text), HasSubstr("2 components (1: L 324, 2: V)"));
    EXPECT_THAT(refused(text.substr(0, text.size() * 9 / 10), 2), HasSubstr("values"));
  }
}

TEST_F(RecordFormats, SmcWithTouchingValues) {
  const Accelerogram record = read(smc(wave(), "2 CORRECTED ACCELEROGRAM", 50));
  EXPECT_EQ(record.component, "225");
  EXPECT_EQ(record.acceleration.size(), wave().size());
  EXPECT_NEAR(record.peak(), 0.01 * peak_of(wave()), 6e-5);
  EXPECT_NEAR(record.acceleration[11], 0.01 * wave()[11], 6e-5);
  EXPECT_THAT(refused(smc(wave(), "3 VELOCITY", 50)), HasSubstr("3 VELOCITY"));
  EXPECT_THAT(refused(smc(wave(), "1 UNCORRECTED ACCELEROGRAM", 1.7e38)),
              HasSubstr("without a sampling rate"));
}

TEST_F(RecordFormats, NumbersBelowAnAnnouncedBlockAreRefused) {
  const std::string row = rows(scaled(wave(), 0.01), 8, "%11.6f").substr(0, 8 * 11 + 1);
  const auto with_row = [&](std::string text, const char* before) {
    return text.insert(text.find(before), row);
  };
  for (const std::string& text :
       {with_row(csmip(wave(), 1, "Up", true), "    64 points of veloc"),
        csmip(scaled(wave(), 1e-3), 1, "Up", false) + row,
        with_row(cosmos(wave(), "cm/s^2"), "End-of-data for Chan  1 acceleration")}) {
    EXPECT_THAT(refused(text), AllOf(HasSubstr("numbers below the 64 values that line"),
                                     HasSubstr("announces; correct the file")))
        << text.substr(0, 40);
  }
}

TEST_F(RecordFormats, WhatIsCutIsRefused) {
  for (const std::string& text :
       {keyed(wave()), geonet(wave(), "N10E", true), csmip(wave(), 1, "Up", true),
        cosmos(wave(), "cm/s^2"), smc(wave(), "2 CORRECTED ACCELEROGRAM", 50)}) {
    // in the header, and among the values of the acceleration
    for (const double part : {0.2, text.starts_with("EVENT") ? 0.8 : 0.45}) {
      const auto size = static_cast<std::size_t>(part * static_cast<double>(text.size()));
      EXPECT_THAT(refused(text.substr(0, text.rfind('\n', size) + 1), 0, "cm/s2", 0.02),
                  HasSubstr("record"))
          << text.substr(0, 40) << part;
    }
  }
}

}  // namespace record_formats_test
}  // namespace pounding
