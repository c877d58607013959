#pragma once

#include <cstdint>
#include <string>

#include "signweave/database/database.h"

/// Internal to `database`: receives the findings of a check while it runs.
namespace signweave {

class CheckListener {
 public:
  virtual ~CheckListener() = default;
  virtual void begin(std::uint32_t recordings) = 0;
  /// The check of a recording begins; `name` is "catalogue entry N" until its name is known.
  virtual void slot(std::uint32_t number, const std::string& name) = 0;
  /// Called from time to time while a recording is checked.
  virtual void alive() = 0;
  virtual void fault(const std::string& text) = 0;
};

/// Checks the recordings from slot `first` to the last.
void check_slots(const Database& database, std::uint32_t first, CheckListener& listener);

}  // namespace signweave
