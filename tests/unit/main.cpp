#include <gtest/gtest.h>
#include <slepcsys.h>

int main(int count, char** words) {
  testing::InitGoogleTest(&count, words);
  SlepcInitialize(&count, &words, nullptr, nullptr);
  const int status = RUN_ALL_TESTS();
  SlepcFinalize();
  return status;
}
