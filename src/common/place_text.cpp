#include "common/place_text.h"

#include <sstream>

namespace pounding {

std::string place_text(const Vector3& place) {
  std::ostringstream text;
  text << "(" << place[0] << ", " << place[1] << ", " << place[2] << ")";
  return text.str();
}

}  // namespace pounding
