#include "io/file_seal.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <stdexcept>
#include <unistd.h>
#include <vector>
#include <zlib.h>

#include "common/error.h"

namespace pounding {
namespace {

using Seal = std::array<char, seal_size>;

/// The seal that the bytes of a file behind its first 512 ask for; `readable` is false if they
/// could not be read to their end.
Seal seal_of(std::ifstream& file, bool& readable) {
  std::uint64_t bytes = 0;
  uLong sum = crc32(0, nullptr, 0);
  std::vector<char> block(1 << 20);
  file.seekg(seal_size);
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    sum =
        crc32(sum, reinterpret_cast<const Bytef*>(block.data()), static_cast<uInt>(file.gcount()));
    bytes += static_cast<std::uint64_t>(file.gcount());
  }
  readable = file.eof();
  Seal seal{};
  std::snprintf(seal.data(), seal.size(), "pounding seal 1\nbytes %llu\ncrc32 %08lx\n",
                static_cast<unsigned long long>(bytes), static_cast<unsigned long>(sum));
  return seal;
}

}  // namespace

void seal_file(const std::string& path) {
  bool readable = false;
  std::ifstream content(path, std::ios::binary);
  const Seal seal = seal_of(content, readable);
  const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  const bool written =
      readable && file >= 0 &&
      pwrite(file, seal.data(), seal.size(), 0) == static_cast<ssize_t>(seal_size) &&
      fsync(file) == 0;
  if (file >= 0) close(file);
  if (!written) throw UserError(path + ": could not be written completely (is the disk full?)");
}

void check_seal(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  Seal written{};
  if (!file.read(written.data(), written.size()) ||
      std::string(written.data(), 13) != "pounding seal") {
    throw std::runtime_error(
        path +
        ": not a checkpoint, modal basis or piece of a mesh: it does not begin with "
        "the seal of one; another file, of an older version, or damaged");
  }
  bool readable = false;
  if (seal_of(file, readable) != written || !readable) {
    throw std::runtime_error(path +
                             ": its content is not what was sealed; it is damaged, or it was "
                             "changed and not sealed anew (run/seal; pounding-tools seal)");
  }
}

}  // namespace pounding
