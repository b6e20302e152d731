#pragma once

#include "contact/contact_operator.h"
#include "contact/interface_compliance.h"

namespace pounding {

/// Delassus operator H = L T M^-1 T^T L^T: the entry of two rows of L [1/kg], the same on every
/// rank.
double delassus_entry(const ContactOperator& contact, const InterfaceCompliance& compliance,
                      int row, int column);

}  // namespace pounding
