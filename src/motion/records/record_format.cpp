#include "motion/records/record_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <regex>

#include "common/array_reductions.h"
#include "common/error.h"

namespace pounding {

std::span<const RecordFormat> record_formats() {
  static constexpr std::array formats{RecordFormat{"K-NET, KiK-net", is_knet, read_knet},
                                      RecordFormat{"ESM, ITACA, AFAD", is_keyed, read_keyed},
                                      RecordFormat{"GeoNet V1A, V2A", is_geonet, read_geonet},
                                      RecordFormat{"CSMIP V1, V2", is_csmip, read_csmip},
                                      RecordFormat{"COSMOS V1, V2", is_cosmos, read_cosmos},
                                      RecordFormat{"BHRC", is_bhrc, read_bhrc},
                                      RecordFormat{"SMC", is_smc, read_smc}};
  return formats;
}

const RecordFormat* format_of(std::span<const TextLine> lines) {
  for (const RecordFormat& format : record_formats()) {
    if (format.recognises(lines)) return &format;
  }
  return nullptr;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::optional<double> number_in(std::string_view text) {
  static const std::regex pattern(R"([-+]?(?:\d+\.?\d*|\.\d+)(?:[EeDd][-+]?\d+)?)");
  std::match_results<std::string_view::const_iterator> match;
  const std::string_view head = text.substr(0, 200);
  if (!std::regex_search(head.begin(), head.end(), match, pattern)) return {};
  return parse_number(match[0].str());
}

NumberBlock read_block(const std::string& file, std::span<const TextLine> lines, std::size_t begin,
                       std::size_t count) {
  NumberBlock block;
  std::size_t width = 0;
  for (block.end = begin; block.values.size() < count; ++block.end) {
    if (block.end >= lines.size()) {
      throw UserError(file + ": the header announces " + std::to_string(count) + " values but " +
                      std::to_string(block.values.size()) +
                      " are found; the header or the file is not the right one");
    }
    const TextLine& line = lines[block.end];
    const auto row = parse_row(line);
    if (!row) {
      throw UserError(at_line(file, line.number) + "'" + first_bad_word(line.text) +
                      "' where the header announces numbers, " +
                      std::to_string(block.values.size()) + " of " + std::to_string(count) +
                      " values read; correct the file");
    }
    if (width == 0) width = row->values.size();
    const std::size_t size = row->values.size(), left = count - block.values.size();
    const bool surplus_is_zero =
        std::all_of(row->values.begin() + static_cast<std::ptrdiff_t>(std::min(size, left)),
                    row->values.end(), [](double value) { return value == 0; });
    if ((size < width && size < left) || size > width || !surplus_is_zero) {
      throw UserError(at_line(file, line.number) + std::to_string(size) + " numbers where " +
                      std::to_string(std::min(width, left)) +
                      " are expected; the header or the file is not the right one");
    }
    block.values.insert(block.values.end(), row->values.begin(),
                        row->values.begin() + static_cast<std::ptrdiff_t>(std::min(size, left)));
  }
  return block;
}

void require_end(const std::string& file, std::span<const TextLine> lines, const NumberBlock& block,
                 int announced) {
  if (block.end >= lines.size() || !parse_row(lines[block.end])) return;
  throw UserError(at_line(file, lines[block.end].number) + "numbers below the " +
                  std::to_string(block.values.size()) + " values that line " +
                  std::to_string(announced) + " announces; correct the file");
}

std::size_t count_of(const std::string& file, int line, double announced) {
  refuse_if(!(announced >= 2 && announced <= 1e9) || announced != std::floor(announced),
            at_line(file, line) + "the header announces " + text_of(announced) +
                " values, which cannot be; correct the file");
  return static_cast<std::size_t>(announced);
}

double agreed_step(const RecordedMotion& motion, int line, double time_step) {
  refuse_if(!(time_step >= 1e-5 && time_step <= 1), at_line(motion.file, line) + "time step " +
                                                        text_of(time_step) +
                                                        " s, which cannot be; correct the file");
  refuse_if(motion.time_step != 0 && !(std::abs(motion.time_step / time_step - 1) < 1e-3),
            at_line(motion.file, line) + "time step " + text_of(time_step) +
                " s of the header and " + text_of(motion.time_step) +
                " s contradict one another (option time_step); leave time_step out");
  return time_step;
}

std::size_t choose_component(const RecordedMotion& motion, const std::vector<std::string>& names) {
  const std::size_t size = names.size();
  if (motion.column == 0 && size == 1) return 0;
  if (motion.column > 0 && static_cast<std::size_t>(motion.column) <= size) {
    return static_cast<std::size_t>(motion.column) - 1;
  }
  std::string list;
  for (std::size_t i = 0; i < size; ++i) {
    list += (i == 0 ? "" : ", ") + std::to_string(i + 1) + ": " + names[i];
  }
  throw UserError(motion.file + ": holds " + std::to_string(size) +
                  (size == 1 ? " component (" : " components (") + list +
                  "); give column: " + (size == 1 ? "1 or none" : "1 to " + std::to_string(size)) +
                  (motion.column > 0 ? ", not " + std::to_string(motion.column) : ""));
}

void require_peak(const std::string& file, int line, double stated,
                  const std::vector<double>& values, double part) {
  const double peak = largest_magnitude(values);
  stated = std::abs(stated);
  if (std::abs(peak - stated) <= part * std::max(stated, peak)) return;
  throw UserError(at_line(file, line) + "the header states a peak of " + text_of(stated) +
                  " but the values' is " + text_of(peak) +
                  "; are they all there, and is the header theirs?");
}

}  // namespace pounding
