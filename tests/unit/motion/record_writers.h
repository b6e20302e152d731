#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "motion/accelerogram.h"

/// Writers of records in published formats, for tests of their readers.
namespace pounding::record_writers {

template <class... Values>
std::string printed(const char* format, Values... values) {
  char buffer[400];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

/// 64 values every 0.02 s that die away.
inline std::vector<double> wave() {
  std::vector<double> values;
  for (int i = 0; i < 64; ++i) values.push_back(500 * std::exp(-0.02 * i) * std::sin(0.314 * i));
  return values;
}

inline std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

inline std::vector<double> wave_of_mean_zero() {
  std::vector<double> values = wave();
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / 64;
  for (double& value : values) value -= mean;
  return values;
}

inline double peak_of(const std::vector<double>& values) {
  double peak = 0;
  for (const double value : values) peak = std::max(peak, std::abs(value));
  return peak;
}

/// Rows of so many values, each printed by a format.
inline std::string rows(const std::vector<double>& values, std::size_t width, const char* format,
                        bool fill = false) {
  std::string text;
  std::size_t i = 0;
  for (; i < values.size() || (fill && i % width != 0); ++i) {
    text += printed(format, i < values.size() ? values[i] : 0.0);
    if (i % width == width - 1) text += "\n";
  }
  return i % width == 0 ? text : text + "\n";
}

/// Numbers of a header, none of them special.
inline std::vector<double> numbers(std::size_t count) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(static_cast<double>(1 + 7 * i % 20));
  return values;
}

/// [gal]
inline std::string knet(const std::vector<double>& values, int offset) {
  std::string text = printed(
      "Origin Time       2020/01/02 03:04:00\nStation Code      TST001\nSampling Freq(Hz) 50Hz\n"
      "Duration Time(s)  1\nDir.              N-S\nScale Factor      3920(gal)/6182761\n"
      "Max. Acc. (gal)   %.3f\nMemo.             \n",
      peak_of(values));
  std::vector<double> counts;
  for (const double value : values) counts.push_back(std::round(value * 6182761 / 3920 + offset));
  return text + rows(counts, 8, "%8.0f ");
}

/// [cm/s2]
inline std::string keyed(const std::vector<double>& values) {
  return printed(
             "EVENT_NAME: A TEST\nVS30_M/S: \nSAMPLING_INTERVAL_S: 0.020000\nNDATA: %zu\n"
             "STREAM: HNE\nUNITS: cm/s^2\nPGA_CM/S^2: %.6f\nDATA_TYPE: ACCELERATION\n",
             values.size(), peak_of(values)) +
         rows(values, 1, "%.6f");
}

/// [mm/s2]; `rest`: velocity and displacement below.
inline std::string geonet(const std::vector<double>& values, const char* name, bool rest) {
  std::string text = printed(
      "Corrected accelerogram 20200102_TEST\nSite TEST\nInstr Period: 0.0050 s   Damping: 0.700\n"
      "Number of points  %zu    Duration 1.28 sec\nInstrument corrected data at 0.020 sec "
      "intervals\n"
      "Component %s  An Axis\nAcceleration:  peak %.1f mm/s/s at   0.10 sec\n"
      "Velocity:      peak   20.00 mm/s   at   0.20 sec\n",
      values.size(), name, peak_of(values));
  std::vector<double> whole = numbers(40), real = numbers(60);
  whole[30] = 128;
  whole[33] = static_cast<double>(values.size());
  real[24] = 0.01;
  real[25] = 0.02;
  text += rows(whole, 10, "%8.0f") + rows(real, 10, "%8.2f") + rows(values, 10, "%8.1f", true);
  if (rest) text += rows(values, 10, "%8.2f", true) + rows(values, 10, "%8.3f", true);
  return text;
}

/// [cm/s2], of volume 1 in g
inline std::string csmip(const std::vector<double>& values, int channel, const char* name,
                         bool corrected) {
  const char* title = corrected ? "Corrected accelerogram" : "UNCORRECTED ACCELEROGRAM DATA";
  std::string text = printed("%s   00001-S0001       Chan  %d: %s\n", title, channel, name);
  if (corrected) {
    text += printed(
        "    64 points of instrument- and baseline-corrected accel, veloc and displ data\n"
        "At equally-spaced intervals of    .020  sec.\nPeak acceleration = %9.3f    cm/sec/sec\n",
        peak_of(values));
  }
  text += rows(numbers(100), 16, "%5.0f") + rows(numbers(50), 8, "%10.6f");
  if (!corrected) {
    return text + "64 POINTS OF ACCEL DATA EQUALLY SPACED AT .020 SEC.  (UNITS: G)\n" +
           rows(values, 8, " %.6f");
  }
  // Fields of 12, so that values touch.
  for (const char* quantity : {"accel", "veloc", "displ"}) {
    text += printed("    64 points of %s data equally spaced at  .020 sec, in cm/%s\n", quantity,
                    quantity[0] == 'a' ? "sec2. (8f11.6)" : "sec.  (8f11.6)");
    text += rows(values, 8, "%11.6f");
  }
  return text + printed("/&  ----------  End of data for channel  %d  ----------\n", channel);
}

inline std::string cosmos(const std::vector<double>& values, const char* unit) {
  std::string text =
      "Corrected acceleration    (Format v01.20 with 13 text lines)\nRecord of a test\n"
      "Sta Chan   1: 90 deg (Rcrdr Chan  1) Location:\n"
      " 100 Integer-header values follow on  10 lines, Format= (10I8)\n";
  std::vector<double> real = numbers(100);
  real[33] = 0.005;
  real[61] = 20;  // ms
  text += rows(numbers(100), 10, "%8.0f") +
          " 100 Real-header values follow on  20 lines, Format= (5F15.6)\n" +
          rows(real, 5, "%15.6f") + "   1 Comment line(s) follow, each starting with a \"|\":\n|\n";
  for (const char* quantity : {"acceleration", "velocity"}) {
    text += printed("%8zu %s pts, approx   1 secs, units=%s,Format=(8F10.5)\n", values.size(),
                    quantity, unit);
    text += rows(values, 8, "%10.5f");
    text += printed("End-of-data for Chan  1 %s\n", quantity);
  }
  return text;
}

/// [g/10]; `pairs`: each value behind its time.
inline std::string bhrc(const std::vector<double>& values, const char* name, bool pairs) {
  std::string text = printed(
      "* VOL1DS FILE:  5522/01\nInst Type = SSA-2\n\nCOMP %s        \n"
      "INSTR PERIOD =  .019 SEC   DAMPING =  .640\n"
      "NO. OF POINTS = %6zu      DURATION = %7.3f\nUNITS ARE SECONDS AND G/10\n   \n",
      name, values.size(), 0.02 * static_cast<double>(values.size()));
  text += rows(numbers(88), 14, "%5.0f") + rows(numbers(38), 6, "%13.6E");
  std::vector<double> all;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (pairs) all.push_back(0.02 * static_cast<double>(i));
    all.push_back(values[i]);
  }
  return text + rows(all, 10, " %12.5E");
}

/// [cm/s2]; 8E10.4 without a blank
inline std::string smc(const std::vector<double>& values, const char* title, double rate) {
  std::string text = printed("%s      \n*\nTST\n", title);
  text += "     2020   1   2    0304 A test\nMoment Mag=      7.1\n";
  text += "station = Somewhere   component=    225 \n*\n*\n*\n*\n*\n";
  std::vector<double> whole(48, -32768), real(50, 1.7e38);
  whole[13] = 225;
  whole[15] = 2;
  whole[16] = static_cast<double>(values.size());
  real[1] = rate;
  real[29] = *std::max_element(values.begin(), values.end());
  real[31] = *std::min_element(values.begin(), values.end());
  text += rows(whole, 8, "%10.0f") + rows(real, 5, "%15.7E") + "|\n|a comment, 3 words\n";
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = values[i];
    const int exponent = value == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value))));
    text += printed("%7.4fE%+d", value / std::pow(10, exponent), exponent);
    if (i % 8 == 7) text += "\n";
  }
  return text;
}

}  // namespace pounding::record_writers
