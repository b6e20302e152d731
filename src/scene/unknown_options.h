#pragma once

#include <optional>
#include <string>

#include "scene/option_table.h"

namespace pounding {

/// Refuses the first option that the table does not explain for the listed names, naming the
/// nearest one that it does. A structure, material, section, contact, probe, support, force, load
/// or item of equipment that is wholly defined but not used is allowed: it may belong to a library,
/// or be switched off by `-contacts none`. Throws UserError.
void refuse_unknown_options(const OptionsDatabase& database, const ListedNames& in_use);

/// Complaint about the value of an option of PETSc or SLEPc, if it is wrong: "expected ...".
/// Those that print take no file: they could write anywhere.
std::optional<std::string> petsc_value_fault(const std::string& name, const std::string& value);

}  // namespace pounding
