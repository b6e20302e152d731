#pragma once

#include <filesystem>
#include <string>

namespace pounding {

/// Throws UserError, with `option` at its head, where a text file of Gmsh's format 2 lists two
/// elements under one number: Gmsh keeps one of them in silence. Serial.
void check_element_numbers(const std::string& option, const std::filesystem::path& file);

}  // namespace pounding
