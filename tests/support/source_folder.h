#pragma once

#include <string>

namespace pounding {

/// Folder of the checkout that the tests were built from.
std::string source_folder();

}  // namespace pounding
