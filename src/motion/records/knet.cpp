#include <algorithm>
#include <cmath>
#include <numeric>
#include <regex>

#include "common/error.h"
#include "motion/records/record_format.h"

/// K-NET and KiK-net: lines of keys down to "Memo.", then integers of a recorder with its offset.
namespace pounding {

namespace {

struct KnetHeader {
  std::optional<double> rate, numerator, denominator, peak;
  int rate_line = 0, scale_line = 0, peak_line = 0;
  std::string component;
  std::size_t end = 0;  ///< the first line of values
};

/// The direction of a component: KiK-net numbers those at depth 1 to 3 and at the surface 4 to 6.
std::string direction_of(const std::string& text) {
  static constexpr const char* numbered[] = {"N-S at depth",   "E-W at depth",   "U-D at depth",
                                             "N-S at surface", "E-W at surface", "U-D at surface"};
  const bool number = text.size() == 1 && text[0] >= '1' && text[0] <= '6';
  return number ? numbered[text[0] - '1'] : text;
}

KnetHeader read_knet_header(std::span<const TextLine> lines) {
  static const std::regex scale(R"(^Scale Factor\s+([\d.]+)\s*\(gal\)\s*/\s*([\d.]+))");
  KnetHeader header;
  std::smatch match;
  for (std::size_t i = 0; i < std::min(lines.size(), head_lines); ++i) {
    const std::string text = lines[i].text.substr(0, head_lines);
    if (text.starts_with("Sampling Freq")) {
      header.rate = number_in(std::string_view(text).substr(text.find(')') + 1));
      header.rate_line = lines[i].number;
    } else if (std::regex_search(text, match, scale)) {
      header.numerator = parse_number(match[1].str());
      header.denominator = parse_number(match[2].str());
      header.scale_line = lines[i].number;
    } else if (text.starts_with("Max. Acc.")) {
      header.peak = number_in(std::string_view(text).substr(text.find(')') + 1));
      header.peak_line = lines[i].number;
    } else if (text.starts_with("Dir.")) {
      header.component = direction_of(trimmed(std::string_view(text).substr(4)));
    } else if (text.starts_with("Memo")) {
      header.end = i + 1;
      break;
    }
  }
  return header;
}

std::vector<double> read_counts(const std::string& file, std::span<const TextLine> lines) {
  std::vector<double> counts;
  for (const TextLine& line : lines) {
    if (line.text.empty()) continue;
    const auto row = parse_row(line);
    if (!row || row->decimals != 0) {
      throw UserError(at_line(file, line.number) + "'" + line.text.substr(0, 40) +
                      "' is no row of whole numbers, as K-NET has them; correct the file");
    }
    counts.insert(counts.end(), row->values.begin(), row->values.end());
  }
  if (counts.size() < 2) throw UserError(file + ": holds fewer than 2 values");
  return counts;
}

double peak_about(const std::vector<double>& counts, double offset) {
  double peak = 0;
  for (const double count : counts) peak = std::max(peak, std::abs(count - offset));
  return peak;
}

/// The mean of the counts; 0 where the peak that the header states is that of the counts as they
/// are and not of those less their mean.
double offset_of(const std::vector<double>& counts, double stated_peak) {
  constexpr double equal = 2e-3;
  const double mean =
      std::accumulate(counts.begin(), counts.end(), 0.0) / static_cast<double>(counts.size());
  const auto is_stated = [&](double peak) {
    return std::abs(peak - stated_peak) <= equal * stated_peak;
  };
  return is_stated(peak_about(counts, 0)) && !is_stated(peak_about(counts, mean)) ? 0 : mean;
}

}  // namespace

bool is_knet(std::span<const TextLine> lines) {
  const KnetHeader header = read_knet_header(lines);
  return header.rate_line > 0 && header.scale_line > 0 && header.end > 0;
}

FormatRecord read_knet(const RecordedMotion& motion, std::span<const TextLine> lines) {
  const KnetHeader header = read_knet_header(lines);
  refuse_if(!header.rate || !(*header.rate > 0),
            at_line(motion.file, header.rate_line) + "no sampling frequency");
  const double scale = header.numerator.value_or(0) / header.denominator.value_or(0);
  refuse_if(!(scale > 0) || !std::isfinite(scale),
            at_line(motion.file, header.scale_line) + "a scale factor that cannot be");
  choose_component(motion, {header.component});
  FormatRecord record;
  record.values = read_counts(motion.file, lines.subspan(header.end));
  const double offset = offset_of(record.values, header.peak.value_or(0) / scale);
  for (double& value : record.values) value = (value - offset) * scale;
  if (header.peak && *header.peak > 0) {
    require_peak(motion.file, header.peak_line, *header.peak, record.values);
  }
  record.time_step = agreed_step(motion, header.rate_line, 1 / *header.rate);
  record.unit = "cm/s2";
  record.component = header.component;
  record.layout = "K-NET, counts x " + text_of(*header.numerator) + "/" +
                  text_of(*header.denominator) + " gal" +
                  (offset == 0 ? ", no offset" : " less their mean");
  return record;
}

}  // namespace pounding
