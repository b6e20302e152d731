#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "motion/accelerogram.h"
#include "motion/oscillator_step.h"
#include "motion/response_spectrum.h"
#include "motion_files.h"

namespace pounding {
namespace spectrum_reference_test {

using std::numbers::pi;
using testing_support::shared_file;

double psa(const std::vector<double>& a, double step, double frequency, double xi,
           AfterRecord after = AfterRecord::free_vibration) {
  const std::vector<double> frequencies{frequency};
  return response_spectrum(a, step, frequencies, xi, after)[0].pseudo_acceleration;
}

/// Above half a cycle per step the references, which look for an extremum only where the velocity
/// changes sign from sample to sample, miss some that come in pairs inside a step.
bool comparable(double frequency, double step) {
  return 2 * frequency * step < 1;
}

std::string reference_file(const std::string& name) {
  return source_folder() + "/tests/references/" + name;
}

/// Responses in closed form, see tests/references/README.md.
nlohmann::json responses() {
  return nlohmann::json::parse(std::ifstream(reference_file("oscillator_responses.json")));
}

/// The ground motion of tests/references/earthquake.py.
Accelerogram earthquake() {
  Accelerogram motion{std::vector<double>(4001), 0.005};
  for (std::size_t i = 0; i < motion.acceleration.size(); ++i) {
    const double t = 0.005 * static_cast<double>(i);
    for (int line = 1; line <= 40; ++line) {
      const double frequency = 0.3 * std::pow(110.0, (line - 1) / 39.0);
      const double phase = 2 * pi * std::fmod(line * (1 + std::sqrt(5.0)) / 2, 1.0);
      motion.acceleration[i] += std::sin(2 * pi * frequency * t + phase) / (1 + frequency / 10);
    }
    motion.acceleration[i] *= t < 2 ? t / 2 : std::exp(-std::max(t - 8, 0.0) / 3);
  }
  const double factor = 0.45 * 9.81 / motion.peak();
  for (double& a : motion.acceleration) a *= factor;
  return motion;
}

TEST(ReferenceSpectra, HalfSinePulse) {
  const nlohmann::json pulse_of = responses()["half_sine"];
  const double duration = pulse_of["duration"];
  for (const auto& line : pulse_of["lines"])
    for (const int n : {10, 20, 50, 200, 4000}) {
      const double frequency = line["frequency"];
      std::vector<double> pulse;
      for (int i = 0; i <= n; ++i) pulse.push_back(i == n ? 0 : std::sin(pi * i / n));
      if (n < 1000) {
        const double expected = line["pieces"][std::to_string(n)];
        const double ratio = psa(pulse, duration / n, frequency, 0.05) / expected;
        if (comparable(frequency, duration / n))
          EXPECT_NEAR(ratio, 1, 1e-6) << frequency << " " << n;
        else
          EXPECT_GT(ratio, 1 - 1e-6) << frequency << " " << n;
      } else {
        const double dampings[] = {0, 0.02, 0.05};
        for (std::size_t k = 0; k < 3; ++k) {
          const double expected = line["damped"][k];
          EXPECT_NEAR(psa(pulse, duration / n, frequency, dampings[k]) / expected, 1, 1e-6);
        }
      }
    }
}

TEST(ReferenceSpectra, DiracTriangle) {
  const nlohmann::json lines = responses()["triangle"];
  EXPECT_GT(lines.size(), 20u);
  for (const auto& line : lines) {
    const double h = line[0], expected = line[2];
    EXPECT_NEAR(psa({0, 1 / h, 0}, h, line[1], 0.05) / expected, 1, 1e-6) << h << " " << line[1];
  }
}

TEST(ReferenceSpectra, HarmonicFromRest) {
  const nlohmann::json harmonic = responses()["harmonic"];
  const double frequency = harmonic["frequency"], duration = harmonic["duration"];
  for (const double h : {0.001, 0.0001}) {
    std::vector<double> a;
    for (int i = 0; i <= std::lround(duration / h); ++i)
      a.push_back(std::sin(2 * pi * frequency * i * h));
    for (const auto& line : harmonic["lines"]) {
      const double exact = line[1], expected = line[h == 0.001 ? 2 : 3];
      const double found = psa(a, h, line[0], 0.05, AfterRecord::ignored);
      EXPECT_NEAR(found / expected, 1, 1e-6) << h << " " << line[0];
      EXPECT_NEAR(found / exact, 1, 400 * h * h) << h << " " << line[0];
    }
  }
}

TEST(ReferenceSpectra, CoefficientsToFiftyDigitReferences) {
  const nlohmann::json steps = responses()["steps"];
  EXPECT_EQ(steps.size(), 10u);
  for (const auto& line : steps) {
    const double h = line["step"], theta = line["turn"];
    const auto step = oscillator_step(theta, 0.05);
    const double displacement[2] = {1, h}, load[2] = {h * h, h};
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) {
        const double a = line["state"][i][j], b = line["load"][i][j];
        const double velocity_scale = i == 0 ? displacement[j] : displacement[j] / h;
        EXPECT_NEAR(step.state[i][j] * velocity_scale / a, 1, 1e-12) << theta;
        EXPECT_NEAR(step.load[i][j] * load[i] / b, 1, 1e-12) << theta;
      }
  }
}

TEST(ReferenceSpectra, EarthquakeInClosedForm) {
  const auto record = earthquake();
  std::ifstream lines(reference_file("earthquake_spectrum.csv"));
  int checked = 0;
  for (std::string line; std::getline(lines, line);) {
    double frequency = 0, expected = 0;
    char comma = 0;
    if (!(std::istringstream(line) >> frequency >> comma >> expected)) continue;
    const double found =
        psa(record.acceleration, record.time_step, frequency, 0.05, AfterRecord::ignored);
    EXPECT_NEAR(found / expected, 1, 1e-6) << frequency;
    ++checked;
  }
  EXPECT_EQ(checked, 40);
}

TEST(ReferenceSpectra, StiffAndSoftLimits) {
  // Infinitely stiff: PSA = PGA. Infinitely soft: the mass stays, SD = largest ground displacement.
  const auto record = earthquake();
  const auto& a = record.acceleration;
  const double h = record.time_step;
  double u = 0, v = 0, largest = 0;
  for (std::size_t i = 1; i < a.size(); ++i) {
    u += h * v + h * h * (2 * a[i - 1] + a[i]) / 6;
    v += h * (a[i - 1] + a[i]) / 2;
    largest = std::max(largest, std::abs(u));
  }
  const double soft = 1e-6, omega = 2 * pi * soft;
  EXPECT_NEAR(psa(a, h, soft, 0.05, AfterRecord::ignored) / (omega * omega * largest), 1, 1e-4);
  EXPECT_NEAR(psa(a, h, 1e6, 0.05, AfterRecord::ignored) / record.peak(), 1, 1e-6);
}

TEST(ReferenceSpectra, SpectraOfRecordsFromOtherPrograms) {
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

}  // namespace spectrum_reference_test
}  // namespace pounding
