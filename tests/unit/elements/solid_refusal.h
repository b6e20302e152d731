#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dense_model.h"

namespace pounding::testing_support {

inline ElementProperties concrete(double poisson = 0.2) {
  return {.young = 30e9, .poisson = poisson, .density = 2400};
}

/// Expects that a solid of this shape is refused for its Jacobian; `why` names the shape.
inline void expect_refused(ElementType type, const std::vector<double>& x, const std::string& why) {
  try {
    dense_element(type, x, concrete());
    ADD_FAILURE() << why << " accepted";
  } catch (const ElementError& error) {
    EXPECT_NE(std::string(error.what()).find("non-positive Jacobian"), std::string::npos) << why;
  }
}

}  // namespace pounding::testing_support
