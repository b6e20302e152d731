#include "motion/incoherent_wave.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "common/error.h"
#include "io/hdf5_reader.h"
#include "motion/fourier.h"

namespace pounding {
namespace {

/// Part of the peak by which samples of one record may differ, which were read in two ways.
constexpr double same_record = 1e-6;

/// Factor of a wave on the record that it is made of; 0 where it is made of another one.
double factor_on(const Accelerogram& record, const Accelerogram& wave) {
  const std::vector<double>& r = record.acceleration;
  const std::vector<double>& a = wave.acceleration;
  if (r.size() != a.size() || std::abs(record.time_step / wave.time_step - 1) > same_record) {
    return 0;
  }
  const auto largest = static_cast<std::size_t>(
      std::ranges::max_element(a, {}, [](double one) { return std::abs(one); }) - a.begin());
  const double factor = a[largest] / r[largest];
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(std::abs(a[i] - factor * r[i]) <= same_record * std::abs(a[largest]))) return 0;
  }
  return factor;
}

}  // namespace

std::vector<Accelerogram> read_incoherent_wave(const std::string& file,
                                               std::span<const Accelerogram> wave,
                                               Resampling resampling) try {
  const Hdf5Reader reader(file);
  const auto as_applied = [&](std::vector<double> samples) {
    Accelerogram one{std::move(samples), reader.number("/", "time_step")};
    return resampling == Resampling::linear ? one : resample_band_limited(one, resampled_step);
  };
  std::vector<Accelerogram> found;
  for (std::size_t d = 0; d < 3; ++d) {
    const std::string axis = direction_names[d];
    const bool has = !reader.names(axis).empty();
    if (has == wave[d].acceleration.empty()) {
      throw std::runtime_error(
          has ? "it has a part along " + axis + ", and there is no -motion_" + axis
              : "it has no part along " + axis + ", and there is -motion_" + axis);
    }
    if (!has) continue;
    const double factor = factor_on(as_applied(reader.array(axis + "/record")), wave[d]);
    if (factor == 0) throw std::runtime_error("it is of another record than -motion_" + axis);
    for (std::size_t k = 0; k < reader.shape(axis + "/histories").rows; ++k) {
      Accelerogram& history =
          found.emplace_back(as_applied(reader.rows(axis + "/histories", k, 1)));
      history.start = wave[d].start;
      for (double& value : history.acceleration) value *= factor;
      if (!std::ranges::all_of(history.acceleration, [](double a) { return std::isfinite(a); })) {
        throw std::runtime_error("its histories along " + axis + " are no numbers");
      }
    }
  }
  return found;
} catch (const std::runtime_error& error) {
  throw UserError("option -motion_incoherent " + file + ": " + error.what() +
                  "; give a file that run/incoherent makes of this motion");
}

}  // namespace pounding
