#include "interactions/laws/hysteresis_path.h"

namespace pounding::interactions {

double skeleton_force(const Skeleton& skeleton, double first_slope, double elongation) {
  if (skeleton.breaks.empty()) return 0;
  if (elongation <= skeleton.breaks.front().elongation) return first_slope * elongation;
  for (std::size_t i = 1; i < skeleton.breaks.size(); ++i) {
    const SkeletonBreak& a = skeleton.breaks[i - 1];
    const SkeletonBreak& b = skeleton.breaks[i];
    if (elongation > b.elongation) continue;
    return a.force +
           (b.force - a.force) * (elongation - a.elongation) / (b.elongation - a.elongation);
  }
  const SkeletonBreak& last = skeleton.breaks.back();
  return last.force + skeleton.last_slope * (elongation - last.elongation);
}

}  // namespace pounding::interactions
