#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <hdf5.h>

namespace pounding {

/// Reads HDF5 files that may be anything: errors throw std::runtime_error of one line that begins
/// with the path and names the fault. HDF5 itself prints nothing.
class Hdf5Reader {
 public:
  /// Shape (rows, columns); `columns` is 0 for a plain vector.
  struct Shape {
    std::size_t rows = 0;
    std::size_t columns = 0;
  };

  /// `sealed`: HDF5 sees it only if its seal is right, see file_seal.h; `left_open`: its writer may
  /// have been killed after Hdf5File::stay_readable().
  enum class Kind { plain, sealed, left_open };
  explicit Hdf5Reader(const std::string& path, Kind kind = Kind::plain);
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;
  ~Hdf5Reader() { H5Fclose(file_); }

  /// Names in a group, sorted; empty if there is no such group.
  std::vector<std::string> names(const std::string& group) const;
  Shape shape(const std::string& dataset) const;
  /// Sizes along all dimensions of a dataset.
  std::vector<std::size_t> extent(const std::string& dataset) const;
  /// Where a dataset of doubles that lies in one piece begins in the file [bytes].
  std::int64_t offset(const std::string& dataset) const;
  /// `count` rows from row `first`, shape (count, columns).
  std::vector<double> rows(const std::string& dataset, std::size_t first, std::size_t count) const;
  /// The whole of a dataset.
  std::vector<double> array(const std::string& dataset) const;
  /// Strings of fixed length.
  std::vector<std::string> strings(const std::string& dataset) const;
  /// Attribute of a dataset, of a group, or of the file ("/").
  double number(const std::string& object, const std::string& attribute) const;
  std::string text(const std::string& object, const std::string& attribute) const;

 private:
  hid_t open_dataset(const std::string& dataset) const;
  hid_t open_attribute(const std::string& object, const std::string& attribute) const;
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  std::uintmax_t bytes_ = 0;  ///< of the file when it was opened
  hid_t file_ = -1;
};

}  // namespace pounding
