#include "common/error.h"

#include <filesystem>

#include "common/facts.h"

namespace pounding {

void require_finite_file(const std::string& path, const std::string& place, std::uintmax_t most) {
  std::error_code failure;
  const std::filesystem::file_status status = std::filesystem::status(path, failure);
  if (failure || !std::filesystem::exists(status)) return;
  refuse_if(std::filesystem::is_directory(status), place + path + ": is a folder; give a file");
  refuse_if(
      !std::filesystem::is_regular_file(status),
      place + path + ": is a device, a pipe or a socket, which may have no end; " + "give a file");
  const std::uintmax_t size = std::filesystem::file_size(path, failure);
  refuse_if(!failure && size > most, place + path + ": holds " + std::to_string(size / 1000000) +
                                         " MB, which is no such file; at most " +
                                         std::to_string(most / 1000000) + " MB are read");
}

std::string place_text(const Vector3& place) {
  return sentence("{}", {place});
}

}  // namespace pounding
