#pragma once

#include <cstddef>
#include <string>

/// A seal in front of an HDF5 file that the program reads back: 512 bytes of text, padded with
/// zeros, which HDF5 passes over (a user block). They hold the length and the CRC-32 (that of zlib)
/// of all bytes behind them, so that HDF5 never sees a damaged file:
///
///     pounding seal 1
///     bytes 123456
///     crc32 0123abcd
///
/// Whoever changes such a file seals it anew: run/seal FILE.
namespace pounding {

inline constexpr std::size_t seal_size = 512;

/// Seals a file whose first 512 bytes are free, and brings it to the disk. Throws UserError.
void seal_file(const std::string& path);

/// Throws std::runtime_error, one line that begins with the path: no seal, or the content is not
/// what was sealed.
void check_seal(const std::string& path);

}  // namespace pounding
