#pragma once

#include <cstdint>
#include <string>

namespace pounding {

/// Content of a file as a report names it.
struct FileDigest {
  std::uint64_t bytes = 0;
  std::string sha256;  ///< FIPS 180-4, 64 hexadecimal digits
};

/// Reads the file once, a block at a time. Throws UserError if it cannot be read.
FileDigest digest_of_file(const std::string& path);

}  // namespace pounding
