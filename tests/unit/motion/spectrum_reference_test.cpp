#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "motion/accelerogram.h"
#include "motion/response_spectrum.h"
#include "motion_files.h"

namespace pounding {
namespace {

using std::numbers::pi;
using testing_support::shared_file;

class ReferenceSpectra : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto file = shared_file("fixtures/D1_spectra.json");
    if (file.empty()) GTEST_SKIP() << "no reference data: set POUNDING_SHARED";
    reference_ = nlohmann::json::parse(std::ifstream(file));
  }

  static double psa(const std::vector<double>& a, double step, double frequency, double xi,
                    AfterRecord after = AfterRecord::free_vibration) {
    const std::vector<double> frequencies{frequency};
    return response_spectrum(a, step, frequencies, xi, after)[0].pseudo_acceleration;
  }

  /// Above half a cycle per step the reference, which looks for an extremum only where the velocity
  /// changes sign from sample to sample, misses some that come in pairs inside a step.
  static bool comparable(double frequency, double step) { return 2 * frequency * step < 1; }

  static Accelerogram quake() {
    return read_accelerogram({shared_file("fixtures/A3_synthetic_quake_pga045g.csv"), "m/s2"});
  }

  nlohmann::json reference_;
};

TEST_F(ReferenceSpectra, HalfSinePulse) {
  const double duration = reference_["half_sine"]["td"];
  for (const auto& row : reference_["half_sine"]["table"])
    for (const int n : {10, 20, 50, 200, 4000}) {
      std::vector<double> pulse;
      for (int i = 0; i <= n; ++i) pulse.push_back(i == n ? 0 : std::sin(pi * i / n));
      if (n < 1000) {
        const double expected = row["pl_N" + std::to_string(n)];
        const double ratio = psa(pulse, duration / n, row["f"], 0.05) / expected;
        if (comparable(row["f"], duration / n))
          EXPECT_NEAR(ratio, 1, 1e-6) << row["f"] << " " << n;
        else
          EXPECT_GT(ratio, 1 - 1e-6) << row["f"] << " " << n;
      } else {
        for (const std::string xi : {"0", "0.02", "0.05"}) {
          const double expected = row["xi" + xi];
          EXPECT_NEAR(psa(pulse, duration / n, row["f"], std::stod(xi)) / expected, 1, 1e-6);
        }
      }
    }
}

TEST_F(ReferenceSpectra, DiracTriangle) {
  for (const auto& row : reference_["dirac_triangle"]) {
    const double h = row["dt"], expected = row["PSA_over_J"];
    EXPECT_NEAR(psa({0, 1 / h, 0}, h, row["f"], 0.05) / expected, 1, 1e-6) << h << " " << row["f"];
  }
}

TEST_F(ReferenceSpectra, HarmonicFromRest) {
  const auto& harmonic = reference_["harmonic"];
  const double frequency = harmonic["fe"], duration = harmonic["T"];
  for (const double h : {0.001, 0.0001}) {
    std::vector<double> a;
    for (int i = 0; i <= std::lround(duration / h); ++i)
      a.push_back(std::sin(2 * pi * frequency * i * h));
    for (const auto& row : harmonic["table"]) {
      const double expected = row[h == 0.001 ? "nj_dt0.001" : "nj_dt0.0001"], exact = row["exact"];
      const double found = psa(a, h, row["f"], 0.05, AfterRecord::ignored);
      EXPECT_NEAR(found / expected, 1, 1e-6) << h << " " << row["f"];
      EXPECT_NEAR(found / exact, 1, 400 * h * h) << h << " " << row["f"];
    }
  }
}

TEST_F(ReferenceSpectra, CoefficientsToFiftyDigitReferences) {
  for (const auto& row : reference_["coefficients"]) {
    const double h = row["dt"], theta = row["w_dt"];
    const auto step = oscillator_step(theta, 0.05);
    const double displacement[2] = {1, h}, load[2] = {h * h, h};
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) {
        const double a = row["A"][i][j], b = row["B"][i][j];
        const double velocity_scale = i == 0 ? displacement[j] : displacement[j] / h;
        EXPECT_NEAR(step.state[i][j] * velocity_scale / a, 1, 1e-12) << theta;
        EXPECT_NEAR(step.load[i][j] * load[i] / b, 1, 1e-12) << theta;
      }
  }
}

TEST_F(ReferenceSpectra, SyntheticQuake) {
  const auto record = quake();
  const std::vector<double> frequencies = reference_["quake_psa"]["f"];
  const auto spectrum = response_spectrum(record.acceleration, record.time_step, frequencies, 0.05);
  int checked = 0;
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const double expected = reference_["quake_psa"]["PSA"][i];
    const double ratio = spectrum[i].pseudo_acceleration / expected;
    if (comparable(frequencies[i], record.time_step)) {
      EXPECT_NEAR(ratio, 1, 1e-9) << frequencies[i];
      ++checked;
    } else {
      EXPECT_GT(ratio, 1 - 1e-9) << frequencies[i];
      EXPECT_LT(ratio, 1.003) << frequencies[i];
    }
  }
  EXPECT_GT(checked, 40);
}

TEST_F(ReferenceSpectra, StiffAndSoftLimits) {
  const auto record = quake();
  EXPECT_NEAR(record.peak(), double(reference_["limits"]["PGA"]), 1e-12);
  for (std::size_t i = 0; i < reference_["limits"]["f"].size(); ++i) {
    const double f = reference_["limits"]["f"][i], expected = reference_["limits"]["PSA"][i];
    const double ratio =
        psa(record.acceleration, record.time_step, f, 0.05, AfterRecord::ignored) / expected;
    EXPECT_NEAR(ratio, 1, f == 400 ? 1e-3 : 1e-9) << f;  // 400 Hz: a pair of extrema in one step
  }
}

TEST_F(ReferenceSpectra, SpectraOfRecordsFromOtherPrograms) {
  const auto motion = shared_file("records/reference_spectra/test_motion_dt0p01.txt");
  if (motion.empty()) GTEST_SKIP() << "no reference records";
  const auto record = read_accelerogram({motion, "m/s2"});
  std::ifstream lines(shared_file("records/reference_spectra/test_motion_dt0p01_rs.txt"));
  int checked = 0;
  for (std::string line; std::getline(lines, line);) {
    double period = 0, acceleration = 0, displacement = 0;
    char comma = 0;
    std::istringstream(line) >> period >> comma >> acceleration >> comma >> displacement;
    const std::vector<double> frequencies{1 / period};
    const auto point =
        response_spectrum(record.acceleration, record.time_step, frequencies, 0.05)[0];
    // The other program takes the largest sample, below the extremum by up to this.
    const double missed = 1 - std::cos(pi * record.time_step / period);
    EXPECT_NEAR(point.displacement / displacement, 1, 0.01 + missed + 1e-5 / displacement);
    EXPECT_NEAR(point.pseudo_acceleration / acceleration, 1, 0.002 + missed) << period;
    ++checked;
  }
  EXPECT_EQ(checked, 100);
}

}  // namespace
}  // namespace pounding
