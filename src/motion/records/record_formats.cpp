#include "motion/records/record_formats.h"

#include <array>

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

}  // namespace pounding
