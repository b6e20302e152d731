#pragma once

#include <string>

#include <gtest/gtest.h>

#include "common/error.h"

namespace pounding::testing_support {

/// The message of the UserError that `action` throws, one line; empty where it throws none.
template <typename Action>
std::string refusal_of(Action&& action) {
  try {
    action();
  } catch (const UserError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  return {};
}

}  // namespace pounding::testing_support
