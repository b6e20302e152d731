#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// A seal in front of an HDF5 file that the program reads back: 512 bytes of text, padded with
/// zeros, which HDF5 passes over (a user block). They hold the length and the CRC-32 (that of zlib)
/// of all bytes behind them, so that HDF5 never sees a damaged file:
///
///     pounding seal 1
///     bytes 123456
///     crc32 0123abcd
///     open 2048 800
///
/// A line `open` names an offset and a number of bytes that change later and are left out of the
/// sum; most files have none. Whoever changes such a file seals it anew: run/seal FILE.
namespace pounding {

inline constexpr std::size_t seal_size = 512;

/// Bytes of a sealed file that change after it is sealed.
struct OpenBytes {
  std::int64_t first = 0;  ///< counted from the beginning of the file
  std::int64_t bytes = 0;
};

/// Seals a file whose first 512 bytes are free, and brings it to the disk. Throws UserError.
void seal_file(const std::string& path, std::vector<OpenBytes> open = {});

/// Ranges that the seal of a file leaves open, in their order; none where there is no seal.
std::vector<OpenBytes> open_bytes(const std::string& path);

/// Throws std::runtime_error, one line that begins with the path: no seal, or the content is not
/// the sealed one.
void check_seal(const std::string& path);

/// Content of a file as a report names it.
struct FileDigest {
  std::uint64_t bytes = 0;
  std::string sha256;  ///< FIPS 180-4, 64 hexadecimal digits
};

/// Reads the file once, a block at a time. Throws UserError if it cannot be read.
FileDigest digest_of_file(const std::string& path);

}  // namespace pounding
