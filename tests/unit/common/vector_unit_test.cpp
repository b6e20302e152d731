#include "common/vector_unit.h"

#include <string>

#include <gtest/gtest.h>

#include "common/error.h"

namespace pounding {
namespace vector_unit_test {

/// Puts back the unit that was in use.
class VectorUnit : public testing::Test {
 protected:
  ~VectorUnit() override { use_vector_unit(MPI_COMM_SELF, before_); }
  std::string before_ = vector_unit();
};

TEST_F(VectorUnit, IsTheBestOfTheMachineAtFirst) {
  use_vector_unit(MPI_COMM_SELF, "auto");
  EXPECT_EQ(vector_unit(), before_);
}

TEST_F(VectorUnit, EveryCompiledOneUpToTheBestCanBeUsed) {
  for (const std::string& name : compiled_vector_units()) {
    use_vector_unit(MPI_COMM_SELF, name);
    EXPECT_EQ(vector_unit(), name);
    if (name == before_) break;
  }
}

TEST_F(VectorUnit, AnotherIsRefusedByName) {
  std::string built;
  for (const std::string& name : compiled_vector_units()) {
    built += (built.empty() ? "" : ", ") + name;
  }
  try {
    use_vector_unit(MPI_COMM_SELF, "v9");
    FAIL();
  } catch (const UserError& error) {
    EXPECT_EQ(error.what(), "option -vector_unit v9: the program was built for " + built +
                                "; -DPOUNDING_VECTOR_UNITS=all builds it for all units");
  }
  EXPECT_EQ(vector_unit(), before_);
}

}  // namespace vector_unit_test
}  // namespace pounding
