#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motion/accelerogram.h"
#include "motion_files.h"

namespace pounding {
namespace shared_records_test {

using testing_support::refusal;
using testing_support::shared_file;

struct Record {
  std::string file;
  std::string unit;    // option
  double time_step;    // option
  double step;         // [s]
  std::size_t values;  // after the surplus zeros are dropped
  double peak;         // [g]
  int column = 0;      // option
};

const std::vector<Record> records{
    {"elcentro_1940/RSN6_IMPVALL.I_I-ELC180.AT2", "", 0, .01, 5372, .2808},
    {"elcentro_1940/RSN6_IMPVALL.I_I-ELC270-hor2.AT2", "", 0, .01, 5346, .2107},
    {"elcentro_1940/RSN6_IMPVALL.I_I-ELC-UP.AT2", "", 0, .01, 5378, .1781},
    {"elcentro_1940/IELC180.AT2", "", 0, .01, 4000, .3129},
    {"elcentro_1940/IELC180.acc", "g", .01, .01, 4000, .3129},
    {"elcentro_1940/elCentro.AT2", "", 0, .02, 1559, .3188},
    {"elcentro_1940/elCentro_verification.at2", "", 0, .02, 1559, .3188},
    {"elcentro_1940/elCentro_verification.dat", "g", .02, .02, 1559, .3188},
    {"elcentro_1940/el_centro.th", "g", .02, .02, 1560, .3188},
    {"elcentro_1940/elCentro.txt", "g", 0, .02, 1559, .3188},
    {"elcentro_1940/elcentro_chopra.csv", "", 0, .02, 1560, .3188},
    {"elcentro_1940/ElCentro.json", "g", 0, .02, 1560, .3188},
    {"elcentro_1940/elcentro_NS_full.dat", "g", 0, .02, 2688, .3487},
    {"elcentro_1940/elcentro_NS_trunc.dat", "m/s2", 0, .02, 1560, .3189},
    {"northridge_1994/Rinaldi228.AT2", "", 0, .01, 1991, .8741},
    {"northridge_1994/Rinaldi318.AT2", "", 0, .01, 1991, .4723},
    {"northridge_1994/RinaldiUP.AT2", "", 0, .01, 1991, .9582},
    {"northridge_1994/rinaldi_fn.dat", "cm/s2", 0, .005, 2990, .8899},
    {"northridge_1994/sylmar_fn.dat", "cm/s2", 0, .02, 3000, .7323},
    {"northridge_1994/newhall_360.dat", "", 0, .02, 3000, .5896},
    {"northridge_1994/ARL360_crcrlf.at2", "", 0, .02, 2000, .3081},
    {"northridge_1994/ARL360_lf.at2", "", 0, .02, 2000, .3081},
    {"northridge_1994/ALH360.AT2", "", 0, .02, 3000, .0798},
    {"northridge_1994/Northridge_castaic090.dat", "", 0, .01, 3989, .5683},
    {"northridge_1994/RSN960_NORTHR_LOS270.AT2", "", 0, .01, 1999, .4716},
    {"northridge_1994/HOW330.AT2", "", 0, .01, 2999, .1633},
    {"northridge_1994/SortedEQFile_(120111).txt", "g", 0, .01, 3000, .4158},
    {"northridge_1994/SortedEQFile_(120112).txt", "g", 0, .01, 3000, .5165},
    {"northridge_1994/RSN1690_NORTH151_SYL090-hor1.AT2", "", 0, .02, 1000, .0858},
    {"kobe_1995/RSN1106_KOBE_KJM000.AT2", "", 0, .02, 7500, .8342},
    {"kobe_1995/RSN1106_KOBE_KJM090.AT2", "", 0, .02, 7500, .6297},
    {"kobe_1995/RSN1106_KOBE_KJM-UP.AT2", "", 0, .02, 7500, .3389},
    {"kobe_1995/KOBE_NS", "", 0, .02, 2567, .8342},
    {"kobe_1995/NIS090.AT2", "", 0, .01, 4096, .5027},
    {"kobe_1995/SortedEQFile_(120711).txt", "g", 0, .01, 4097, .5093},
    {"kobe_1995/SortedEQFile_(120712).txt", "g", 0, .01, 4097, .5027},
    {"kobe_1995/Kobe.dat", "m/s2", 0, .02, 1250, .6937},
    {"reference_spectra/RSN1044_DirRot2.AT2", "", 0, .02, 2000, .6972},
    {"reference_spectra/Imperial Valley.dat", "m/s2", 0, .02, 1889, .6115},
    {"reference_spectra/test_motion_dt0p01.txt", "m/s2", 0, .01, 4684, .1438},
    {"other_formats/DIAM.ACC", "", 0, .02, 2000, .1128945},
    {"other_formats/BM68elc.acc", "g", .01, .01, 4000, .0567},
    {"other_formats/case2_scaled.csv", "g", 0, .0063245553, 5001, .5121, 4},
};

TEST(SharedRecords, EveryRecordHasItsKnownPeak) {
  if (shared_file("records").empty()) GTEST_SKIP() << "no reference records";
  for (const auto& record : records) {
    const auto read = read_accelerogram(
        {shared_file("records/" + record.file), record.unit, record.time_step, record.column});
    EXPECT_EQ(read.acceleration.size(), record.values) << record.file;
    EXPECT_TRUE(read.doubts.empty()) << record.file;
    EXPECT_NEAR(read.time_step, record.step, 1e-8 * record.step) << record.file;
    EXPECT_NEAR(read.peak() / standard_gravity, record.peak, 6e-5) << record.file;
  }
}

TEST(SharedRecords, TwoFilesOfOneRecordAgree) {
  if (shared_file("records").empty()) GTEST_SKIP() << "no reference records";
  const auto unix_ends =
      read_accelerogram({shared_file("records/northridge_1994/ARL360_lf.at2"), ""});
  const auto odd_ends =
      read_accelerogram({shared_file("records/northridge_1994/ARL360_crcrlf.at2"), ""});
  EXPECT_EQ(unix_ends.acceleration, odd_ends.acceleration);
  const auto header = read_accelerogram({shared_file("records/kobe_1995/NIS090.AT2"), ""});
  auto times = read_accelerogram({shared_file("records/kobe_1995/SortedEQFile_(120712).txt"), "g"});
  times.acceleration.erase(times.acceleration.begin());
  EXPECT_EQ(header.acceleration, times.acceleration);
}

TEST(SharedRecords, HeaderOfAnotherRecordIsRefused) {
  const auto file = shared_file("records/kobe_1995/KOBE_NS1_badheader.AT2");
  if (file.empty()) GTEST_SKIP() << "no reference records";
  for (const std::string unit : {"", "g", "cm/s2"})
    EXPECT_THAT(refusal([&] { read_accelerogram({file, unit}); }), ::testing::HasSubstr("10102"));
}

}  // namespace shared_records_test
}  // namespace pounding
