#pragma once

#include <span>
#include <string>
#include <vector>

#include <hdf5.h>

namespace pounding {

/// An HDF5 file written by one rank: two-dimensional datasets that grow by rows. Errors throw
/// std::runtime_error naming file and dataset.
class Hdf5File {
 public:
  explicit Hdf5File(const std::string& path);
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  ~Hdf5File();

  /// An empty dataset of `columns` doubles per row (a plain vector if `columns` is 0), with its
  /// unit.
  void create_dataset(const std::string& name, std::size_t columns, const std::string& unit);
  /// Appends rows; `values` has shape (rows, columns).
  void append(const std::string& name, std::span<const double> values);
  void write_strings(const std::string& name, const std::vector<std::string>& values);
  void write_attribute(const std::string& dataset, const std::string& name, double value);
  void write_attribute(const std::string& dataset, const std::string& name,
                       const std::string& value);

 private:
  struct Dataset {
    std::string name;
    hid_t id = -1;
    hsize_t columns = 0;
    hsize_t rows = 0;
  };
  Dataset& find(const std::string& name);
  hid_t checked(hid_t id, const std::string& what) const;
  hid_t attribute_owner(const std::string& dataset);

  std::string path_;
  hid_t file_ = -1;
  std::vector<Dataset> datasets_;
};

}  // namespace pounding
