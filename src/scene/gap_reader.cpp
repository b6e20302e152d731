#include "scene/gap_reader.h"

#include <algorithm>

#include "scene/option_values.h"

namespace pounding {
namespace {

constexpr const char* patches_option = "<contact>_gap_patches";

/// "place,place,radius,gap; place,place,place,place,gap": a disc or a rectangle each.
std::vector<GapPatch> read_patches(OptionReader& options, const OptionReader::Names& names) {
  std::vector<GapPatch> patches;
  const std::string text = options.path(patches_option, names);
  if (text.empty()) return patches;
  for (const std::string& piece : split(text, ';')) {
    const auto refuse = [&](const std::string& why) {
      options.refuse(patches_option, names, "'" + shown_value(piece) + "' " + why);
    };
    const std::optional<std::vector<double>> found = parse_reals(piece);
    if (!found || (found->size() != 4 && found->size() != 5)) {
      refuse("is neither four numbers nor five");
    }
    const std::vector<double>& number = *found;
    GapPatch patch;
    patch.gap = number.back();
    if (patch.gap < 0) refuse("has a gap below 0; 0 is a joint that is filled there");
    if (number.size() == 4) {
      patch.radius = number[2];
      if (!(patch.radius > 0)) refuse("has no radius above 0");
      patch.low = patch.high = {number[0], number[1]};
    } else {
      patch.low = {number[0], number[1]};
      patch.high = {number[2], number[3]};
      if (!(patch.low[0] < patch.high[0] && patch.low[1] < patch.high[1])) {
        refuse("has its corners not in the order of the places");
      }
    }
    patches.push_back(patch);
  }
  return patches;
}

}  // namespace

InitialGap read_gap(OptionReader& options, const std::string& contact, bool is_wall) {
  const OptionReader::Names names{contact};
  InitialGap gap;
  if (options.text("<contact>_gap", names) != "geometry") {
    gap.values = options.reals("<contact>_gap", names);
    const std::size_t count = gap.values.size();
    if (count != 1 && count != 2 && count != 4) {
      options.refuse("<contact>_gap", names, "wrong count of numbers");
    }
  } else if (is_wall) {
    options.refuse("<contact>_gap", names, "a wall has no geometry, give its distance");
  }
  gap.deviation = options.real("<contact>_gap_deviation", names);
  if (gap.deviation > 0) {
    gap.length = options.real("<contact>_gap_length", names);
    gap.seed = options.integer("<contact>_gap_seed", names);
  }
  gap.patches = read_patches(options, names);
  return gap;
}

}  // namespace pounding
