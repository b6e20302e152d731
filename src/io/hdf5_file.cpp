#include "io/hdf5_file.h"

#include <algorithm>
#include <array>
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
  const Hdf5Handle access(checked(H5Pcreate(H5P_FILE_ACCESS), "create"));
  const Hdf5Handle creation(checked(H5Pcreate(H5P_FILE_CREATE), "create"));
  H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
  if (kind == Kind::sealed) H5Pset_userblock(creation, seal_size);
  file_ = H5Fcreate(path.c_str(), H5F_ACC_EXCL, creation, access);  // never through a link
  checked(file_, "create it");
}

herr_t Hdf5File::close_handles() {
  herr_t status = 0;
  for (const Dataset& dataset : datasets_) status = std::min(status, H5Dclose(dataset.id));
  datasets_.clear();
  if (file_ >= 0) status = std::min(status, H5Fclose(file_));
  file_ = -1;
  return status;
}

void Hdf5File::move_to(const std::string& path) {
  std::error_code failure;
  std::filesystem::rename(path_, path, failure);
  if (failure) throw UserError(path + ": could not be written (" + failure.message() + ")");
  path_ = path;
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
  {
    const Hdf5Handle id(H5Aopen_by_name(file_, "/", attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT));
    checked(id, "find its attribute " + attribute);
    checked(H5Awrite(id, H5T_NATIVE_DOUBLE, &value), "write its attribute " + attribute);
  }
  let_others_write();
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

Hdf5Handle Hdf5File::space(const std::string& name, std::span<const hsize_t> size) const {
  return Hdf5Handle(checked(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr),
                            "describe " + name));
}

Hdf5Handle Hdf5File::properties(const std::string& name) const {
  return Hdf5Handle(checked(H5Pcreate(H5P_DATASET_CREATE), "describe " + name));
}

void Hdf5File::create_dataset(const std::string& name, std::size_t columns,
                              const std::string& unit) {
  const int rank = columns == 0 ? 1 : 2;
  const hsize_t now[2] = {0, columns};
  const hsize_t most[2] = {H5S_UNLIMITED, columns};
  const hsize_t chunk[2] = {4096, std::max<hsize_t>(1, columns)};
  const Hdf5Handle rows(checked(H5Screate_simple(rank, now, most), "describe " + name));
  const Hdf5Handle chunked = properties(name);
  H5Pset_chunk(chunked, rank, chunk);
  datasets_.push_back({name, create(name, H5T_NATIVE_DOUBLE, rows, chunked), columns, 0});
  write_attribute(name, "unit", unit);
}

void Hdf5File::append(const std::string& name, std::span<const double> values) {
  Dataset& dataset = find(name);
  const hsize_t columns = std::max<hsize_t>(1, dataset.columns);
  const hsize_t count[2] = {values.size() / columns, columns};
  if (count[0] == 0) return;
  const hsize_t total[2] = {dataset.rows + count[0], columns};
  const hsize_t start[2] = {dataset.rows, 0};
  checked(H5Dset_extent(dataset.id, total), "extend " + name);
  const Hdf5Handle whole(checked(H5Dget_space(dataset.id), "extend " + name));
  H5Sselect_hyperslab(whole, H5S_SELECT_SET, start, nullptr, count, nullptr);
  const Hdf5Handle memory = space(name, std::span(count).first(dataset.columns == 0 ? 1 : 2));
  checked(H5Dwrite(dataset.id, H5T_NATIVE_DOUBLE, memory, whole, H5P_DEFAULT, values.data()),
          "write " + name);
  dataset.rows = total[0];
}

hid_t Hdf5File::create(const std::string& name, hid_t type, hid_t size, hid_t how) const {
  const Hdf5Handle links(checked(H5Pcreate(H5P_LINK_CREATE), "describe " + name));
  H5Pset_create_intermediate_group(links, 1);
  return checked(H5Dcreate2(file_, name.c_str(), type, size, links, how, H5P_DEFAULT),
                 "create dataset " + name);
}

void Hdf5File::write_virtual(const std::string& name, hid_t type, std::size_t rows,
                             std::size_t columns, const std::string& source,
                             std::span<const VirtualRows> parts) {
  const std::size_t rank = columns == 0 ? 1 : 2;
  const hsize_t size[2] = {rows, columns};
  const Hdf5Handle all = space(name, std::span(size).first(rank));
  const Hdf5Handle mapped = properties(name);
  for (const VirtualRows& part : parts) {
    const hsize_t start[2] = {part.first, 0};
    const hsize_t count[2] = {part.count, columns};
    const Hdf5Handle whole = space(name, std::span(count).first(rank));
    H5Sselect_hyperslab(all, H5S_SELECT_SET, start, nullptr, count, nullptr);
    checked(H5Pset_virtual(mapped, all, source.c_str(), part.dataset.c_str(), whole),
            "describe " + name);
  }
  H5Sselect_all(all);
  checked(H5Dclose(create(name, type, all, mapped)), "write " + name);
}

void Hdf5File::write_values(const std::string& name, std::size_t columns, hid_t type,
                            std::size_t count, const void* values) {
  const std::size_t rank = columns == 0 ? 1 : 2;
  const hsize_t width = std::max<hsize_t>(1, columns);
  const hsize_t size[2] = {count / width, width};
  const Hdf5Handle whole = space(name, std::span(size).first(rank));
  const Hdf5Handle checksums = properties(name);
  if (size[0] > 0) {
    const hsize_t chunk[2] = {std::min<hsize_t>(size[0], 65536), width};
    H5Pset_chunk(checksums, static_cast<int>(rank), chunk);
    H5Pset_fletcher32(checksums);
  }
  const Hdf5Handle dataset(create(name, type, whole, checksums));
  checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "write " + name);
}

std::int64_t Hdf5File::reserve(const std::string& name, const std::vector<std::size_t>& shape) {
  const Hdf5Handle whole = space(name, std::vector<hsize_t>(shape.begin(), shape.end()));
  const Hdf5Handle early = properties(name);
  H5Pset_alloc_time(early, H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(early, H5D_FILL_TIME_NEVER);
  const Hdf5Handle dataset(create(name, H5T_NATIVE_DOUBLE, whole, early));
  const haddr_t offset = H5Dget_offset(dataset);
  if (offset == HADDR_UNDEF) checked(-1, "take the place of " + name);
  return static_cast<std::int64_t>(offset);
}

void Hdf5File::write_padded(const std::string& name, const std::vector<std::string>& values,
                            std::span<const hsize_t> size) {
  const PaddedTexts texts(values);
  const Hdf5Handle type(texts.type());
  const Hdf5Handle whole = space(name, size);
  const Hdf5Handle dataset(create(name, type, whole, H5P_DEFAULT));
  if (values.empty()) return;
  checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.block.data()),
          "write " + name);
}

void Hdf5File::write_texts(const std::string& name, const std::vector<std::string>& columns,
                           const std::vector<std::string>& values) {
  write_padded(name, values,
               std::array<hsize_t, 2>{values.size() / columns.size(), columns.size()});
  std::string names;
  for (const std::string& column : columns) names += (names.empty() ? "" : ",") + column;
  write_attribute(name, "columns", names);
}

void Hdf5File::create_number(const std::string& name) {
  const Hdf5Handle one = space(name, std::array<hsize_t, 1>{1});
  const Hdf5Handle early = properties(name);
  H5Pset_alloc_time(early, H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(early, H5D_FILL_TIME_ALLOC);
  datasets_.push_back({name, create(name, H5T_NATIVE_DOUBLE, one, early), 0, 0});
  write_number(name, 0);
}

void Hdf5File::write_number(const std::string& name, double value) {
  checked(H5Dwrite(find(name).id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value),
          "write " + name);
}

void Hdf5File::put_attribute(const std::string& object, const std::string& name, hid_t type,
                             hsize_t count, const void* values) {
  const Hdf5Handle owner(checked(H5Oopen(file_, object.c_str(), H5P_DEFAULT), "open " + object));
  const Hdf5Handle size(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr));
  const Hdf5Handle attribute(H5Acreate2(owner, name.c_str(), type, size, H5P_DEFAULT, H5P_DEFAULT));
  checked(H5Awrite(attribute, type, values), "write attribute " + name);
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name,
                               const std::string& value) {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, std::max<std::size_t>(1, value.size()));
  put_attribute(object, name, type, 1, value.empty() ? " " : value.data());
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
