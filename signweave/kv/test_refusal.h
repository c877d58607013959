#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "signweave/core/error.h"

namespace signweave::kv {

/// For tests: the code and text of the Error that an action throws; fails the test if it throws none.
inline ErrorCode refusal_of(const std::function<void()>& action, std::string* text = nullptr) {
  try {
    action();
  } catch (const Error& error) {
    if (text) *text = error.what();
    return error.code();
  }
  ADD_FAILURE() << "nothing was thrown";
  return ErrorCode::cancelled;
}

}  // namespace signweave::kv
