#pragma once

#include <string>
#include <vector>

namespace pounding {

/// Adds a table of texts to a closed HDF5 file: a dataset of strings of one length, shape (rows,
/// columns), with the names of the columns, between commas, as its attribute `columns`; the group
/// in its name is there already. Throws UserError naming the file.
void add_text_table(const std::string& path, const std::string& name,
                    const std::vector<std::string>& columns,
                    const std::vector<std::string>& values);

}  // namespace pounding
