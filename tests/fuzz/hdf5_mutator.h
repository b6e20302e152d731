#pragma once

#include <string>

#include "fuzz/mutator.h"

namespace pounding::fuzz {

/// Changes an HDF5 file through HDF5 itself, so that it stays one: a value of a dataset or an
/// attribute becomes an extreme one, a dataset or a group is dropped, renamed, or replaced by one
/// of another shape or kind. A file that HDF5 cannot open is left as it is.
void change_hdf5(const std::string& path, Random& random);

}  // namespace pounding::fuzz
