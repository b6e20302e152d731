#include "driver/run_identity.h"

#include <bit>
#include <cstdio>

#include "scene/option_table.h"
#include "scene/resolved_options.h"

namespace pounding {
namespace {

/// Fowler-Noll-Vo hash (FNV-1a, 64 bits) of numbers, by their bits.
class Hash {
 public:
  void add(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (int shift = 0; shift < 64; shift += 8) {
      hash_ = (hash_ ^ (bits >> shift & 0xff)) * 0x100000001b3;
    }
  }
  std::string text() const {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash_));
    return digits;
  }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

std::string hash_of(const GroundMotion& motion) {
  Hash hash;
  for (int direction = 0; direction < 3; ++direction) {
    const Accelerogram& component = motion.component(direction);
    hash.add(component.time_step);
    hash.add(static_cast<double>(component.acceleration.size()));
    for (const double value : component.acceleration) {
      hash.add(value);
    }
  }
  return hash.text();
}

}  // namespace

std::map<std::string, std::string> lasting_options(const std::string& resolved) {
  std::map<std::string, std::string> options;
  for (const auto& [name, value] : resolved_values(resolved)) {
    if (!may_change_on_restart(name)) {
      options[name] = value;
    }
  }
  return options;
}

RunIdentity identity_of(const std::string& resolved, const Model& model) {
  return {lasting_options(resolved), model.time_step, hash_of(*model.motion)};
}

}  // namespace pounding
