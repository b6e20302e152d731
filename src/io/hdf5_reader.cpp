#include "io/hdf5_reader.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "io/file_seal.h"
#include "io/hdf5_file.h"

namespace pounding {
namespace {

std::string without_padding(const std::string& text) {
  return text.substr(0, text.find('\0'));
}

}  // namespace

Hdf5Reader::Hdf5Reader(const std::string& path, Kind kind) : path_(path) {
  prepare_hdf5();
  if (!std::filesystem::is_regular_file(path)) fail("no such file");
  bytes_ = std::filesystem::file_size(path);
  if (kind == Kind::sealed) check_seal(path);
  if (H5Fis_hdf5(path.c_str()) <= 0) fail("not an HDF5 file, or its beginning is damaged");
  file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_ < 0 && kind == Kind::left_open) {
    file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, H5P_DEFAULT);
  }
  if (file_ < 0) fail("truncated or damaged, or in use by a program that still runs");
}

void Hdf5Reader::fail(const std::string& what) const {
  throw std::runtime_error(path_ + ": " + what);
}

std::vector<std::string> Hdf5Reader::names(const std::string& group) const {
  const Hdf5Handle object(H5Gopen2(file_, group.c_str(), H5P_DEFAULT));
  if (object < 0) return {};
  H5G_info_t info{};
  H5Gget_info(object, &info);
  std::vector<std::string> names;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    const auto name = [&](char* buffer, std::size_t size) {
      return H5Lget_name_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC, i, buffer, size,
                                H5P_DEFAULT);
    };
    const auto length = name(nullptr, 0);
    if (length < 0) fail("the names in '" + group + "' cannot be read: the file is damaged");
    std::string text(static_cast<std::size_t>(length), '\0');
    name(text.data(), text.size() + 1);
    names.push_back(text);
  }
  std::ranges::sort(names);
  return names;
}

hid_t Hdf5Reader::open_dataset(const std::string& dataset) const {
  const hid_t id = H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT);
  if (id < 0) fail("there is no dataset '" + dataset + "'");
  return id;
}

Hdf5Reader::Shape Hdf5Reader::shape(const std::string& dataset) const {
  const Hdf5Handle data(open_dataset(dataset));
  const Hdf5Handle space(H5Dget_space(data));
  hsize_t size[2] = {0, 0};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank != 1 && rank != 2) fail("dataset '" + dataset + "' has not one or two dimensions");
  H5Sget_simple_extent_dims(space, size, nullptr);
  if (size[0] > bytes_ / std::max<hsize_t>(1, size[1])) {
    fail("dataset '" + dataset + "' claims more values than the file has bytes: it is damaged");
  }
  return {size[0], size[1]};
}

std::vector<std::size_t> Hdf5Reader::extent(const std::string& dataset) const {
  const Hdf5Handle data(open_dataset(dataset));
  const Hdf5Handle space(H5Dget_space(data));
  std::vector<hsize_t> size(std::max(0, H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, size.data(), nullptr);
  return {size.begin(), size.end()};
}

std::int64_t Hdf5Reader::offset(const std::string& dataset) const {
  const Hdf5Handle data(open_dataset(dataset));
  const Hdf5Handle type(H5Dget_type(data));
  const haddr_t offset = H5Dget_offset(data);
  if (H5Tequal(type, H5T_NATIVE_DOUBLE) <= 0 || offset == HADDR_UNDEF) {
    fail("dataset '" + dataset + "' is not one piece of doubles");
  }
  return static_cast<std::int64_t>(offset);
}

std::vector<double> Hdf5Reader::rows(const std::string& dataset, std::size_t first,
                                     std::size_t count) const {
  const Shape whole = shape(dataset);
  if (first + count > whole.rows) {
    fail("dataset '" + dataset + "' has " + std::to_string(whole.rows) + " rows instead of " +
         std::to_string(first + count) + " or more");
  }
  std::vector<double> values(count * std::max<std::size_t>(1, whole.columns));
  if (values.empty()) return values;
  const Hdf5Handle data(open_dataset(dataset));
  const Hdf5Handle space(H5Dget_space(data));
  const hsize_t start[2] = {first, 0};
  const hsize_t size[2] = {count, whole.columns};
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, size, nullptr);
  const Hdf5Handle memory(H5Screate_simple(whole.columns == 0 ? 1 : 2, size, nullptr));
  if (H5Dread(data, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()) < 0) {
    fail("dataset '" + dataset + "' cannot be read: the file is damaged");
  }
  return values;
}

std::vector<double> Hdf5Reader::array(const std::string& dataset) const {
  return rows(dataset, 0, shape(dataset).rows);
}

std::vector<std::string> Hdf5Reader::strings(const std::string& dataset) const {
  const std::size_t count = shape(dataset).rows;
  const Hdf5Handle data(open_dataset(dataset));
  const Hdf5Handle type(H5Dget_type(data));
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0) {
    fail("dataset '" + dataset + "' does not hold strings of fixed length");
  }
  const std::size_t width = H5Tget_size(type);
  if (count * width > bytes_) fail("dataset '" + dataset + "' claims more than the file has");
  std::string block(count * width, '\0');
  if (count > 0 && H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, block.data()) < 0) {
    fail("dataset '" + dataset + "' cannot be read: the file is damaged");
  }
  std::vector<std::string> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(without_padding(block.substr(i * width, width)));
  }
  return values;
}

hid_t Hdf5Reader::open_attribute(const std::string& object, const std::string& attribute) const {
  const hid_t id =
      H5Aopen_by_name(file_, object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  if (id < 0) fail("'" + object + "' has no attribute '" + attribute + "'");
  return id;
}

double Hdf5Reader::number(const std::string& object, const std::string& attribute) const {
  const Hdf5Handle id(open_attribute(object, attribute));
  const Hdf5Handle space(H5Aget_space(id));
  double value = 0;
  if (H5Sget_simple_extent_npoints(space) != 1 || H5Aread(id, H5T_NATIVE_DOUBLE, &value) < 0) {
    fail("attribute '" + attribute + "' of '" + object + "' is not a number");
  }
  return value;
}

std::string Hdf5Reader::text(const std::string& object, const std::string& attribute) const {
  const Hdf5Handle id(open_attribute(object, attribute));
  const Hdf5Handle type(H5Aget_type(id));
  const Hdf5Handle space(H5Aget_space(id));
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 ||
      H5Sget_simple_extent_npoints(space) != 1) {
    fail("attribute '" + attribute + "' of '" + object + "' is not a string of fixed length");
  }
  std::string value(H5Tget_size(type), '\0');
  if (H5Aread(id, type, value.data()) < 0) {
    fail("attribute '" + attribute + "' of '" + object + "' cannot be read");
  }
  return without_padding(value);
}

}  // namespace pounding
