#include "fuzz/hdf5_mutator.h"

#include <cmath>
#include <limits>
#include <vector>

#include <hdf5.h>

namespace pounding::fuzz {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const std::vector<double> extremes{
    0,        -1,        1,      0.5,          1e300,         -1e300, std::nan(""),
    infinity, -infinity, 1e-300, 2147483648.0, -2147483649.0, 9.3e18, 7,
    1e9};

struct Objects {
  std::vector<std::string> all;
  std::vector<std::string> datasets;
};

herr_t note(hid_t, const char* name, const H5O_info_t* info, void* data) {
  auto* const objects = static_cast<Objects*>(data);
  if (std::string(name) != ".") {
    objects->all.emplace_back(name);
    if (info->type == H5O_TYPE_DATASET) {
      objects->datasets.emplace_back(name);
    }
  }
  return 0;
}

/// Some values of a dataset of numbers become extreme.
void change_values(hid_t file, const std::string& name, Random& random) {
  const hid_t dataset = H5Dopen(file, name.c_str(), H5P_DEFAULT);
  const hid_t type = H5Dget_type(dataset);
  const hid_t space = H5Dget_space(dataset);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (H5Tget_class(type) == H5T_FLOAT && count > 0) {
    std::vector<double> values(static_cast<std::size_t>(count));
    H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    for (std::size_t times = 1 + random.below(3); times-- > 0;) {
      values[random.below(values.size())] = random.one_of(extremes);
    }
    H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }
  H5Sclose(space);
  H5Tclose(type);
  H5Dclose(dataset);
}

/// A dataset of another shape, or of integers, in the place of whatever was there.
void replace(hid_t file, const std::string& name, Random& random) {
  H5Ldelete(file, name.c_str(), H5P_DEFAULT);
  const hsize_t shape[3] = {random.below(20), random.below(8), random.below(3)};
  const int rank = static_cast<int>(random.below(4));
  const hid_t space = rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(rank, shape, nullptr);
  const hid_t type = random.chance(4) ? H5T_NATIVE_SHORT : H5T_NATIVE_DOUBLE;
  const hid_t dataset =
      H5Dcreate(file, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  if (dataset >= 0) {
    H5Dclose(dataset);
  }
  H5Sclose(space);
}

/// An attribute of the file or of an object is dropped, or becomes another number or a text.
void change_attribute(hid_t file, const std::string& name, Random& random) {
  const hid_t object = H5Oopen(file, name.c_str(), H5P_DEFAULT);
  H5O_info_t info;
  H5Oget_info(object, &info);
  if (info.num_attrs > 0) {
    char key[256];
    H5Aget_name_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC, random.below(info.num_attrs), key,
                       sizeof key, H5P_DEFAULT);
    H5Adelete(object, key);
    const hid_t space = H5Screate(H5S_SCALAR);
    if (random.chance(3)) {
      const double value = random.one_of(extremes);
      const hid_t attribute =
          H5Acreate(object, key, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT);
      H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value);
      H5Aclose(attribute);
    } else if (random.chance(2)) {
      const std::string text = random.one_of(extreme_numbers()) + " ";
      const hid_t type = H5Tcopy(H5T_C_S1);
      H5Tset_size(type, text.size());
      const hid_t attribute = H5Acreate(object, key, type, space, H5P_DEFAULT, H5P_DEFAULT);
      H5Awrite(attribute, type, text.data());
      H5Aclose(attribute);
      H5Tclose(type);
    }
    H5Sclose(space);
  }
  H5Oclose(object);
}

}  // namespace

void change_hdf5(const std::string& path, Random& random) {
  H5Eset_auto(H5E_DEFAULT, nullptr, nullptr);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  if (file < 0) {
    return;
  }
  for (std::size_t times = 1 + random.below(3); times-- > 0;) {
    Objects objects;
    H5Ovisit(file, H5_INDEX_NAME, H5_ITER_INC, note, &objects);
    if (objects.datasets.empty()) {
      break;
    }
    switch (random.below(6)) {
      case 0:
        H5Ldelete(file, random.one_of(objects.all).c_str(), H5P_DEFAULT);
        break;
      case 1:
        replace(file, random.one_of(objects.all), random);
        break;
      case 2:
        H5Lmove(file, random.one_of(objects.all).c_str(), H5L_SAME_LOC, "elsewhere", H5P_DEFAULT,
                H5P_DEFAULT);
        break;
      case 3:
        change_attribute(file, random.chance(2) ? "/" : random.one_of(objects.all), random);
        break;
      default:
        change_values(file, random.one_of(objects.datasets), random);
        break;
    }
  }
  H5Fclose(file);
}

}  // namespace pounding::fuzz
