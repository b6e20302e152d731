#pragma once

#include <optional>
#include <string>

namespace pounding {

/// What is wrong with the value of an option of PETSc or SLEPc, if anything is: "expected ...".
/// Those that print take no file: they could write anywhere.
std::optional<std::string> petsc_value_fault(const std::string& name, const std::string& value);

}  // namespace pounding
