#pragma once

#include <optional>
#include <string>

namespace pounding {

/// Complaint about the value of an option of PETSc or SLEPc, if it is wrong: "expected ...".
/// Those that print take no file: they could write anywhere.
std::optional<std::string> petsc_value_fault(const std::string& name, const std::string& value);

}  // namespace pounding
