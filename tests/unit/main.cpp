#include <gtest/gtest.h>
#include <slepcsys.h>

#include "support/source_folder.h"

std::string pounding::source_folder() {
  return POUNDING_SOURCE_DIR;
}

int main(int count, char** words) {
  testing::InitGoogleTest(&count, words);
  SlepcInitialize(&count, &words, nullptr, nullptr);
  const int status = RUN_ALL_TESTS();
  SlepcFinalize();
  return status;
}
