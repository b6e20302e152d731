#pragma once

#include <string>
#include <vector>

#include <hdf5.h>

namespace pounding {

/// Texts of one length as HDF5 holds them, side by side and padded with zeros to the longest, at
/// least one character. Whoever makes `type` closes it.
struct PaddedTexts {
  explicit PaddedTexts(const std::vector<std::string>& texts);

  hid_t type() const;

  std::size_t width = 1;
  std::string block;
};

}  // namespace pounding
