#include "io/padded_texts.h"

#include <algorithm>

namespace pounding {

PaddedTexts::PaddedTexts(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) width = std::max(width, text.size());
  for (std::string text : texts) {
    text.resize(width, '\0');
    block += text;
  }
}

hid_t PaddedTexts::type() const {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, width);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  return type;
}

}  // namespace pounding
