#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <hdf5.h>

#include "io/file_seal.h"

namespace pounding {

/// A handle of HDF5 of any kind, which is closed at the end of its scope: a dataset even where it
/// cannot be flushed, which H5Idec_ref would leave open, and its file with it.
class Hdf5Handle {
 public:
  explicit Hdf5Handle(hid_t id) : id_(id) {}
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  ~Hdf5Handle() {
    if (id_ >= 0) H5Iget_type(id_) == H5I_DATASET ? H5Dclose(id_) : H5Idec_ref(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
};

/// Rows of a virtual dataset that are the whole of a dataset of another file.
struct VirtualRows {
  std::string dataset;
  std::size_t first = 0;
  std::size_t count = 0;
};

/// An HDF5 file written by one rank: two-dimensional datasets that grow by rows, and arrays written
/// at once. Its metadata carry checksums. Errors throw UserError naming file and dataset.
class Hdf5File {
 public:
  /// `sealed`: closing seals it, see file_seal.h; otherwise it is plain HDF5.
  enum class Kind { plain, sealed };
  explicit Hdf5File(const std::string& path, Kind kind = Kind::plain);
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  ~Hdf5File() { close_handles(); }

  /// An empty dataset of `columns` doubles per row (a plain vector if `columns` is 0), with its
  /// unit.
  void create_dataset(const std::string& name, std::size_t columns, const std::string& unit);
  /// Appends rows; `values` has shape (rows, columns).
  void append(const std::string& name, std::span<const double> values);
  /// A dataset of final size with a checksum, shape (rows, columns) or a plain vector if `columns`
  /// is 0; groups in its name come into being.
  void write_array(const std::string& name, std::size_t columns, std::span<const double> values) {
    write_values(name, columns, H5T_NATIVE_DOUBLE, values.size(), values.data());
  }
  /// An array of whole numbers of 4 bytes each, otherwise as write_array().
  void write_integers(const std::string& name, std::size_t columns,
                      std::span<const std::int32_t> values) {
    write_values(name, columns, H5T_NATIVE_INT32, values.size(), values.data());
  }
  /// A plain vector of whole numbers of 8 bytes each, or of 1 byte each, otherwise as
  /// write_array().
  void write_long_integers(const std::string& name, std::span<const std::int64_t> values) {
    write_values(name, 0, H5T_NATIVE_INT64, values.size(), values.data());
  }
  void write_bytes(const std::string& name, std::span<const std::uint8_t> values) {
    write_values(name, 0, H5T_NATIVE_UINT8, values.size(), values.data());
  }
  /// A dataset of shape (rows, columns), or a plain vector if `columns` is 0, that holds no values
  /// of its own: `parts` are read from the file `source`, in the folder of this one, and rows of
  /// no part are 0. `type`: HDF5's, of one value.
  void write_virtual(const std::string& name, hid_t type, std::size_t rows, std::size_t columns,
                     const std::string& source, std::span<const VirtualRows> parts);
  /// An array of doubles in one piece whose place in the file is taken at once and filled by others
  /// once this one is closed; returns where it begins [bytes].
  std::int64_t reserve(const std::string& name, const std::vector<std::size_t>& shape);
  void write_strings(const std::string& name, const std::vector<std::string>& values) {
    const hsize_t count = values.size();
    write_padded(name, values, {&count, 1});
  }
  /// A table of texts, shape (rows, columns), with the names of the columns, between commas, as its
  /// attribute `columns`.
  void write_texts(const std::string& name, const std::vector<std::string>& columns,
                   const std::vector<std::string>& values);
  /// A dataset of a single number, 0 at first, whose place in the file is taken at once: writing it
  /// anew needs no space.
  void create_number(const std::string& name);
  void write_number(const std::string& name, double value);
  /// Attribute of a dataset, of a group, or of the file ("/").
  void write_attribute(const std::string& object, const std::string& name, double value) {
    put_attribute(object, name, H5T_NATIVE_DOUBLE, 1, &value);
  }
  void write_attribute(const std::string& object, const std::string& name,
                       const std::string& value);
  /// A vector of whole numbers of 8 bytes each; a single one is a number.
  void write_attribute(const std::string& object, const std::string& name,
                       const std::vector<std::int64_t>& values) {
    put_attribute(object, name, H5T_NATIVE_INT64, values.size(), values.data());
  }

  /// Begins to append rows, in an order in which the file is readable at any moment,
  /// by other programs at the same time and after this one is killed (single writer, multiple
  /// readers).
  void stay_readable() { checked(H5Fstart_swmr_write(file_), "open for readers"); }
  /// Hands all that was written to the operating system.
  void flush() { checked(H5Fflush(file_, H5F_SCOPE_GLOBAL), "write"); }
  /// Another name in the same file system.
  void move_to(const std::string& path);
  /// Nothing more is written here, but others may fill places that were reserved, until close().
  void let_others_write() { checked(close_handles(), "write"); }
  /// Everything is on the disk, or this throws.
  void close();
  /// Everything is on the disk, sealed but for these places, or this throws.
  void close(const std::vector<OpenBytes>& open);
  /// Sets an attribute of a whole closed file that is there already.
  void mark(const std::string& attribute, double value);

 private:
  struct Dataset {
    std::string name;
    hid_t id = -1;
    hsize_t columns = 0;
    hsize_t rows = 0;
  };
  Dataset& find(const std::string& name);
  void write_values(const std::string& name, std::size_t columns, hid_t type, std::size_t count,
                    const void* values);
  void write_padded(const std::string& name, const std::vector<std::string>& values,
                    std::span<const hsize_t> size);
  /// A single value is a number, more are a vector.
  void put_attribute(const std::string& object, const std::string& name, hid_t type, hsize_t count,
                     const void* values);
  Hdf5Handle space(const std::string& name, std::span<const hsize_t> size) const;
  Hdf5Handle properties(const std::string& name) const;  ///< of a dataset to be made
  /// A dataset with the groups in its name, which the caller closes.
  hid_t create(const std::string& name, hid_t type, hid_t size, hid_t how) const;
  hid_t checked(hid_t id, const std::string& what) const;
  herr_t close_handles();
  void sync() const;

  std::string path_;
  Kind kind_;
  hid_t file_ = -1;
  std::vector<Dataset> datasets_;
};

/// Texts of one length as HDF5 holds them, side by side and padded with zeros to the longest, at
/// least one character. Whoever makes `type` closes it.
struct PaddedTexts {
  explicit PaddedTexts(const std::vector<std::string>& texts);

  hid_t type() const;

  std::size_t width = 1;
  std::string block;
};

/// Prepares HDF5 before its first use: it shall report errors by the values of its functions only,
/// and not write to files that failed once more when the program ends. Any number of calls, the
/// first before MPI_Init: where MPI is there when HDF5 begins, it closes its files at MPI_Finalize,
/// and falls over those that a full disk left half closed.
void prepare_hdf5();

}  // namespace pounding
