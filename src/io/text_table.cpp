#include "io/text_table.h"

#include <hdf5.h>

#include "common/error.h"
#include "io/padded_texts.h"

namespace pounding {
namespace {

/// The names between commas as an attribute. Returns a negative number on failure.
herr_t name_columns(hid_t dataset, const std::vector<std::string>& columns) {
  std::string names;
  for (const std::string& column : columns) names += (names.empty() ? "" : ",") + column;
  const PaddedTexts texts({names});
  const hid_t type = texts.type();
  const hid_t space = H5Screate(H5S_SCALAR);
  const hid_t attribute = H5Acreate2(dataset, "columns", type, space, H5P_DEFAULT, H5P_DEFAULT);
  const herr_t status = attribute < 0 ? -1 : H5Awrite(attribute, type, texts.block.data());
  if (attribute >= 0) H5Aclose(attribute);
  H5Sclose(space);
  H5Tclose(type);
  return status;
}

}  // namespace

void add_text_table(const std::string& path, const std::string& name,
                    const std::vector<std::string>& columns,
                    const std::vector<std::string>& values) {
  const PaddedTexts texts(values);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t type = texts.type();
  const hsize_t size[2] = {values.size() / columns.size(), columns.size()};
  const hid_t space = H5Screate_simple(2, size, nullptr);
  const hid_t dataset =
      file < 0 ? -1
               : H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  herr_t status = dataset < 0 ? -1 : name_columns(dataset, columns);
  if (status >= 0) {
    status = H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.block.data());
  }
  if (dataset >= 0) H5Dclose(dataset);
  H5Sclose(space);
  H5Tclose(type);
  if (file >= 0 && H5Fclose(file) < 0) status = -1;
  if (status < 0) throw UserError(path + ": " + name + " could not be written; is the disk full?");
}

}  // namespace pounding
