#pragma once

namespace pounding {

/// Before the first use of HDF5: it shall report errors by what its functions return only, and not
/// write to files that failed once more when the program ends. Any number of calls.
void prepare_hdf5();

}  // namespace pounding
