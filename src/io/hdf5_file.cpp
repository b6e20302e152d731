#include "io/hdf5_file.h"

#include <algorithm>
#include <fcntl.h>
#include <filesystem>
#include <stdexcept>
#include <unistd.h>

#include "common/error.h"
#include "io/new_file.h"

namespace pounding {

Hdf5File::Hdf5File(const std::string& path, Kind kind) : path_(path), kind_(kind) {
  prepare_hdf5();
  free_name(path);
  const hid_t access = checked(H5Pcreate(H5P_FILE_ACCESS), "create");
  const hid_t creation = checked(H5Pcreate(H5P_FILE_CREATE), "create");
  H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
  if (kind == Kind::sealed) H5Pset_userblock(creation, seal_size);
  file_ = H5Fcreate(path.c_str(), H5F_ACC_EXCL, creation, access);  // never through a link
  H5Pclose(creation);
  H5Pclose(access);
  checked(file_, "create it");
}

Hdf5File::~Hdf5File() {
  close_handles();
}

herr_t Hdf5File::close_handles() {
  herr_t status = 0;
  for (const Dataset& dataset : datasets_) status = std::min(status, H5Dclose(dataset.id));
  datasets_.clear();
  if (file_ >= 0) status = std::min(status, H5Fclose(file_));
  file_ = -1;
  return status;
}

void Hdf5File::stay_readable() {
  checked(H5Fstart_swmr_write(file_), "open for readers");
}

void Hdf5File::flush() {
  checked(H5Fflush(file_, H5F_SCOPE_GLOBAL), "write");
}

void Hdf5File::move_to(const std::string& path) {
  std::error_code failure;
  std::filesystem::rename(path_, path, failure);
  if (failure) throw UserError(path + ": could not be written (" + failure.message() + ")");
  path_ = path;
}

void Hdf5File::let_others_write() {
  checked(close_handles(), "write");
}

void Hdf5File::close() {
  if (kind_ == Kind::sealed) return close(std::vector<OpenBytes>{});
  let_others_write();
  sync();
}

void Hdf5File::close(const std::vector<OpenBytes>& open) {
  let_others_write();
  seal_file(path_, open);
}

void Hdf5File::sync() const {
  const int file = open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  const int status = fsync(file);
  ::close(file);
  checked(status, "write to the disk");
}

void Hdf5File::mark(const std::string& attribute, double value) {
  require_no_link(path_);
  file_ = checked(H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), "open again");
  const hid_t id = H5Aopen_by_name(file_, "/", attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  checked(id, "find its attribute " + attribute);
  const herr_t status = H5Awrite(id, H5T_NATIVE_DOUBLE, &value);
  H5Aclose(id);
  checked(status, "write its attribute " + attribute);
  checked(close_handles(), "write");
  sync();
}

hid_t Hdf5File::checked(hid_t id, const std::string& what) const {
  if (id < 0) throw UserError(path_ + ": HDF5 could not " + what + " (is the disk full?)");
  return id;
}

Hdf5File::Dataset& Hdf5File::find(const std::string& name) {
  const auto found = std::find_if(datasets_.begin(), datasets_.end(),
                                  [&](const Dataset& dataset) { return dataset.name == name; });
  if (found == datasets_.end()) throw std::runtime_error(path_ + ": no dataset " + name);
  return *found;
}

void Hdf5File::create_dataset(const std::string& name, std::size_t columns,
                              const std::string& unit) {
  const int rank = columns == 0 ? 1 : 2;
  const hsize_t now[2] = {0, columns};
  const hsize_t most[2] = {H5S_UNLIMITED, columns};
  const hsize_t chunk[2] = {4096, std::max<hsize_t>(1, columns)};
  const hid_t space = checked(H5Screate_simple(rank, now, most), "describe " + name);
  const hid_t properties = checked(H5Pcreate(H5P_DATASET_CREATE), "describe " + name);
  H5Pset_chunk(properties, rank, chunk);
  Dataset dataset{name, -1, columns, 0};
  dataset.id = checked(H5Dcreate2(file_, name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT,
                                  properties, H5P_DEFAULT),
                       "create dataset " + name);
  H5Pclose(properties);
  H5Sclose(space);
  datasets_.push_back(dataset);
  write_attribute(name, "unit", unit);
}

void Hdf5File::append(const std::string& name, std::span<const double> values) {
  Dataset& dataset = find(name);
  const hsize_t columns = std::max<hsize_t>(1, dataset.columns);
  const hsize_t count[2] = {values.size() / columns, columns};
  if (count[0] == 0) return;
  const hsize_t total[2] = {dataset.rows + count[0], columns};
  const hsize_t start[2] = {dataset.rows, 0};
  const int rank = dataset.columns == 0 ? 1 : 2;
  checked(H5Dset_extent(dataset.id, total), "extend " + name);
  const hid_t space = checked(H5Dget_space(dataset.id), "extend " + name);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr);
  const hid_t memory = checked(H5Screate_simple(rank, count, nullptr), "extend " + name);
  const herr_t status =
      H5Dwrite(dataset.id, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data());
  H5Sclose(memory);
  H5Sclose(space);
  checked(status, "write " + name);
  dataset.rows = total[0];
}

hid_t Hdf5File::create(const std::string& name, hid_t type, hid_t space, hid_t properties) const {
  const hid_t links = checked(H5Pcreate(H5P_LINK_CREATE), "describe " + name);
  H5Pset_create_intermediate_group(links, 1);
  const hid_t dataset =
      H5Dcreate2(file_, name.c_str(), type, space, links, properties, H5P_DEFAULT);
  H5Pclose(links);
  H5Pclose(properties);
  H5Sclose(space);
  return checked(dataset, "create dataset " + name);
}

void Hdf5File::write_array(const std::string& name, std::size_t columns,
                           std::span<const double> values) {
  write_values(name, columns, H5T_NATIVE_DOUBLE, values.size(), values.data());
}

void Hdf5File::write_integers(const std::string& name, std::size_t columns,
                              std::span<const std::int32_t> values) {
  write_values(name, columns, H5T_NATIVE_INT32, values.size(), values.data());
}

void Hdf5File::write_long_integers(const std::string& name, std::span<const std::int64_t> values) {
  write_values(name, 0, H5T_NATIVE_INT64, values.size(), values.data());
}

void Hdf5File::write_bytes(const std::string& name, std::span<const std::uint8_t> values) {
  write_values(name, 0, H5T_NATIVE_UINT8, values.size(), values.data());
}

void Hdf5File::write_virtual(const std::string& name, hid_t type, std::size_t rows,
                             std::size_t columns, const std::string& source,
                             std::span<const VirtualRows> parts) {
  const int rank = columns == 0 ? 1 : 2;
  const hsize_t size[2] = {rows, columns};
  const hid_t space = checked(H5Screate_simple(rank, size, nullptr), "describe " + name);
  const hid_t properties = checked(H5Pcreate(H5P_DATASET_CREATE), "describe " + name);
  for (const VirtualRows& part : parts) {
    const hsize_t start[2] = {part.first, 0};
    const hsize_t count[2] = {part.count, columns};
    const hid_t whole = checked(H5Screate_simple(rank, count, nullptr), "describe " + name);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr);
    const herr_t status =
        H5Pset_virtual(properties, space, source.c_str(), part.dataset.c_str(), whole);
    H5Sclose(whole);
    checked(status, "describe " + name);
  }
  H5Sselect_all(space);
  checked(H5Dclose(create(name, type, space, properties)), "write " + name);
}

void Hdf5File::write_values(const std::string& name, std::size_t columns, hid_t type,
                            std::size_t count, const void* values) {
  const int rank = columns == 0 ? 1 : 2;
  const hsize_t width = std::max<hsize_t>(1, columns);
  const hsize_t size[2] = {count / width, width};
  const hid_t space = checked(H5Screate_simple(rank, size, nullptr), "describe " + name);
  const hid_t properties = checked(H5Pcreate(H5P_DATASET_CREATE), "describe " + name);
  if (size[0] > 0) {
    const hsize_t chunk[2] = {std::min<hsize_t>(size[0], 65536), width};
    H5Pset_chunk(properties, rank, chunk);
    H5Pset_fletcher32(properties);
  }
  const hid_t dataset = create(name, type, space, properties);
  const herr_t status = H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  H5Dclose(dataset);
  checked(status, "write " + name);
}

std::int64_t Hdf5File::reserve(const std::string& name, const std::vector<std::size_t>& shape) {
  const std::vector<hsize_t> size(shape.begin(), shape.end());
  const int rank = static_cast<int>(size.size());
  const hid_t space = checked(H5Screate_simple(rank, size.data(), nullptr), "describe " + name);
  const hid_t properties = checked(H5Pcreate(H5P_DATASET_CREATE), "describe " + name);
  H5Pset_alloc_time(properties, H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER);
  const hid_t dataset = create(name, H5T_NATIVE_DOUBLE, space, properties);
  const haddr_t offset = H5Dget_offset(dataset);
  H5Dclose(dataset);
  if (offset == HADDR_UNDEF) checked(-1, "take the place of " + name);
  return static_cast<std::int64_t>(offset);
}

void Hdf5File::write_strings(const std::string& name, const std::vector<std::string>& values) {
  const PaddedTexts texts(values);
  const hid_t type = texts.type();
  const hsize_t count = values.size();
  const hid_t space = H5Screate_simple(1, &count, nullptr);
  const hid_t dataset =
      checked(H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
              "create " + name);
  const herr_t status =
      values.empty() ? 0
                     : H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.block.data());
  H5Dclose(dataset);
  H5Sclose(space);
  H5Tclose(type);
  checked(status, "write " + name);
}

void Hdf5File::write_texts(const std::string& name, const std::vector<std::string>& columns,
                           const std::vector<std::string>& values) {
  const PaddedTexts texts(values);
  const hid_t type = texts.type();
  const hsize_t size[2] = {values.size() / columns.size(), columns.size()};
  const hid_t space = checked(H5Screate_simple(2, size, nullptr), "describe " + name);
  const hid_t properties = checked(H5Pcreate(H5P_DATASET_CREATE), "describe " + name);
  const hid_t dataset = create(name, type, space, properties);
  const herr_t status = H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.block.data());
  H5Dclose(dataset);
  H5Tclose(type);
  checked(status, "write " + name);
  std::string names;
  for (const std::string& column : columns) names += (names.empty() ? "" : ",") + column;
  write_attribute(name, "columns", names);
}

void Hdf5File::create_number(const std::string& name) {
  const hsize_t size = 1;
  const hid_t space = checked(H5Screate_simple(1, &size, nullptr), "describe " + name);
  const hid_t properties = checked(H5Pcreate(H5P_DATASET_CREATE), "describe " + name);
  H5Pset_alloc_time(properties, H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(properties, H5D_FILL_TIME_ALLOC);
  Dataset dataset{name, -1, 0, 0};
  dataset.id = H5Dcreate2(file_, name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, properties,
                          H5P_DEFAULT);
  H5Pclose(properties);
  H5Sclose(space);
  checked(dataset.id, "create dataset " + name);
  datasets_.push_back(dataset);
  write_number(name, 0);
}

void Hdf5File::write_number(const std::string& name, double value) {
  checked(H5Dwrite(find(name).id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value),
          "write " + name);
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name, double value) {
  const hid_t owner = checked(H5Oopen(file_, object.c_str(), H5P_DEFAULT), "open " + object);
  const hid_t space = H5Screate(H5S_SCALAR);
  const hid_t attribute =
      H5Acreate2(owner, name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT);
  const herr_t status = H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value);
  H5Aclose(attribute);
  H5Sclose(space);
  H5Oclose(owner);
  checked(status, "write attribute " + name);
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name,
                               const std::string& value) {
  const hid_t owner = checked(H5Oopen(file_, object.c_str(), H5P_DEFAULT), "open " + object);
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, std::max<std::size_t>(1, value.size()));
  const hid_t space = H5Screate(H5S_SCALAR);
  const hid_t attribute = H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT);
  const herr_t status = H5Awrite(attribute, type, value.empty() ? " " : value.data());
  H5Aclose(attribute);
  H5Sclose(space);
  H5Tclose(type);
  H5Oclose(owner);
  checked(status, "write attribute " + name);
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name,
                               const std::vector<std::int64_t>& values) {
  const hid_t owner = checked(H5Oopen(file_, object.c_str(), H5P_DEFAULT), "open " + object);
  const hsize_t count = values.size();
  const hid_t space = count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr);
  const hid_t attribute =
      H5Acreate2(owner, name.c_str(), H5T_NATIVE_INT64, space, H5P_DEFAULT, H5P_DEFAULT);
  const herr_t status = H5Awrite(attribute, H5T_NATIVE_INT64, values.data());
  H5Aclose(attribute);
  H5Sclose(space);
  H5Oclose(owner);
  checked(status, "write attribute " + name);
}

PaddedTexts::PaddedTexts(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) width = std::max(width, text.size());
  for (std::string text : texts) {
    text.resize(width, '\0');
    block += text;
  }
}

hid_t PaddedTexts::type() const {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, width);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  return type;
}

void prepare_hdf5() {
  static const bool prepared = [] {
    H5dont_atexit();
    H5open();
    return H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  }();
  static_cast<void>(prepared);
}

}  // namespace pounding
