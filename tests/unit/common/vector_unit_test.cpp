#include "common/vector_unit.h"

#include <gtest/gtest.h>

namespace pounding {
namespace {

TEST(VectorUnit, TheMachineThatRunsItHasIt) {
  EXPECT_EQ(missing_vector_unit(), nullptr);
  testing::internal::CaptureStderr();
  EXPECT_TRUE(fits_this_machine());
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace pounding
