#include "motion/signal_treatment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motion_files.h"

namespace pounding {
namespace signal_treatment_test {

using ::testing::ElementsAre;
using testing_support::refusal;

// Ten samples 1 ... 10 every 0.1 s; sample k stands for [0.1 k, 0.1 (k + 1)].
SampledSignal ramp() {
  SampledSignal signal;
  for (int k = 1; k <= 10; ++k) signal.acceleration.push_back(k);
  signal.time_step = 0.1;
  signal.first_time = 0.05;
  return signal;
}

// Contacts within the samples 6 and 7, and within sample 2.
const std::vector<TimeWindow> contacts{{0.61, 0.79}, {0.22, 0.28}};

std::vector<double> treated(Treatment treatment) {
  const SampledSignal signal = ramp();
  return treat(signal, find_peaks(signal, contacts, 0), treatment, 1e-3).acceleration;
}

TEST(SignalTreatment, PeaksAreTheSamplesDuringContacts) {
  const auto peaks = find_peaks(ramp(), contacts, 0);
  ASSERT_EQ(peaks.size(), 2u);
  EXPECT_EQ(peaks[0].first, 2u);
  EXPECT_EQ(peaks[0].last, 3u);
  EXPECT_NEAR(peaks[0].impulse, 0.3, 1e-15);
  EXPECT_EQ(peaks[1].first, 6u);
  EXPECT_EQ(peaks[1].last, 8u);
  EXPECT_NEAR(peaks[1].impulse, 1.5, 1e-15);
}

TEST(SignalTreatment, MarginsWidenAndMergePeaks) {
  const auto wide = find_peaks(ramp(), contacts, 0.05);
  ASSERT_EQ(wide.size(), 2u);
  EXPECT_EQ(wide[0].first, 1u);
  EXPECT_EQ(wide[0].last, 4u);
  const auto merged = find_peaks(ramp(), contacts, 0.2);
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_EQ(merged[0].first, 0u);
  EXPECT_EQ(merged[0].last, 10u);
}

TEST(SignalTreatment, EndsOfStepsBelongToNeitherNeighbour) {
  const std::vector<TimeWindow> exact{{0.2, 0.3}}, outside{{-3, -2}, {1.5, 2}};
  const auto peaks = find_peaks(ramp(), exact, 0);
  ASSERT_EQ(peaks.size(), 1u);
  EXPECT_EQ(peaks[0].first, 2u);
  EXPECT_EQ(peaks[0].last, 3u);
  EXPECT_TRUE(find_peaks(ramp(), outside, 0).empty());
}

TEST(SignalTreatment, TheFiveTreatments) {
  EXPECT_THAT(treated(Treatment::complete), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10));
  EXPECT_THAT(treated(Treatment::all_peaks), ElementsAre(0, 0, 3, 0, 0, 0, 7, 8, 0, 0));
  EXPECT_THAT(treated(Treatment::highest_peak), ElementsAre(0, 0, 0, 0, 0, 0, 7, 8, 0, 0));
  EXPECT_THAT(treated(Treatment::without_peaks), ElementsAre(1, 2, 0, 4, 5, 6, 0, 0, 9, 10));
  EXPECT_THAT(treated(Treatment::dirac), ElementsAre(0, ::testing::DoubleNear(1500, 1e-9), 0));
}

TEST(SignalTreatment, TheDiracStandsAtThePeakWithItsImpulse) {
  const SampledSignal signal = ramp();
  const auto dirac = treat(signal, find_peaks(signal, contacts, 0), Treatment::dirac, 1e-3);
  EXPECT_EQ(dirac.time_step, 1e-3);
  EXPECT_NEAR(dirac.first_time, 0.7 - 1e-3, 1e-12);
  EXPECT_THAT(refusal([&] { treat(signal, find_peaks(signal, contacts, 0), Treatment::dirac, 0); }),
              ::testing::HasSubstr("time step"));
}

TEST(SignalTreatment, TheHighestPeakIsThatOfTheLargestImpulseOfEitherSign) {
  SampledSignal signal = ramp();
  signal.acceleration = {0, -9, 0, 0, 5, 5, -20, 14, 0, 0};
  const std::vector<TimeWindow> windows{{0.4, 0.6}, {0.1, 0.2}, {0.6, 0.8}};
  // The last two windows touch samples 4 ... 7: one peak of 0.4; the single sample has -0.9.
  const auto peaks = find_peaks(signal, windows, 0);
  ASSERT_EQ(peaks.size(), 2u);
  EXPECT_EQ(highest_peak(peaks).first, 1u);
}

TEST(SignalTreatment, WithoutContactsNothingIsAPeak) {
  const SampledSignal signal = ramp();
  EXPECT_EQ(treat(signal, {}, Treatment::without_peaks, 0).acceleration, signal.acceleration);
  EXPECT_EQ(treat(signal, {}, Treatment::all_peaks, 0).acceleration, std::vector<double>(10));
}

}  // namespace signal_treatment_test
}  // namespace pounding
