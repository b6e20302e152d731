#include "io/hdf5_library.h"

#include <hdf5.h>

namespace pounding {

void prepare_hdf5() {
  static const bool prepared = [] {
    H5dont_atexit();
    H5open();
    return H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  }();
  static_cast<void>(prepared);
}

}  // namespace pounding
