#include "fidelity/mesh_error.h"

#include <gtest/gtest.h>

namespace pounding {
namespace mesh_error_test {

TEST(MeshError, IsNotTakenUpWithoutMemory) {
  EXPECT_EQ(no_room(8, 3e9, 3e9), "");
  EXPECT_EQ(no_room(8, 40e9, 3e9),
            "split once it has about 8 times the dofs and takes about 40 GB, of which 3 are free; "
            "run it where there are more");
}

TEST(MeshError, OrderIsThatOfThreeBetweenOneAndTwo) {
  EXPECT_DOUBLE_EQ(order_of(0.04, 0.01), 2);
  EXPECT_DOUBLE_EQ(order_of(0.02, 0.01), 1);
  EXPECT_DOUBLE_EQ(order_of(0.01, 0.01), 1);
  EXPECT_DOUBLE_EQ(order_of(0.1, 0), 2);
  EXPECT_DOUBLE_EQ((ErrorPart{"step", 2, true, {}, {}}.extrapolation()), 4.0 / 3);
}

}  // namespace mesh_error_test
}  // namespace pounding
