#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "motion/records/record_text.h"
#include "motion/records/record_unit.h"
#include "scene/scene.h"

namespace pounding {

/// A record of a format that describes itself: values in the file's unit, and their description.
struct FormatRecord {
  std::vector<double> values;
  double time_step = 0;   ///< [s]
  std::string unit;       ///< name, see record_unit
  std::string component;  ///< as the file names it, with its azimuth where it has one
  std::string layout;     ///< format, and changes of the numbers
  std::vector<std::string> doubts{};
};

/// A published format of records, known by marks that nothing else has. `read` is called for files
/// that `recognises` and throws UserError when they break the promise of the marks.
struct RecordFormat {
  std::string_view name;
  bool (*recognises)(std::span<const TextLine> lines);
  FormatRecord (*read)(const RecordedMotion& motion, std::span<const TextLine> lines);
};

bool is_knet(std::span<const TextLine> lines);
FormatRecord read_knet(const RecordedMotion& motion, std::span<const TextLine> lines);
bool is_keyed(std::span<const TextLine> lines);
FormatRecord read_keyed(const RecordedMotion& motion, std::span<const TextLine> lines);
bool is_geonet(std::span<const TextLine> lines);
FormatRecord read_geonet(const RecordedMotion& motion, std::span<const TextLine> lines);
bool is_csmip(std::span<const TextLine> lines);
FormatRecord read_csmip(const RecordedMotion& motion, std::span<const TextLine> lines);
bool is_cosmos(std::span<const TextLine> lines);
FormatRecord read_cosmos(const RecordedMotion& motion, std::span<const TextLine> lines);
bool is_bhrc(std::span<const TextLine> lines);
FormatRecord read_bhrc(const RecordedMotion& motion, std::span<const TextLine> lines);
bool is_smc(std::span<const TextLine> lines);
FormatRecord read_smc(const RecordedMotion& motion, std::span<const TextLine> lines);

}  // namespace pounding
