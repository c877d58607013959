#pragma once

#include <cstdint>
#include <string>

#include "signweave/database/database.h"

/// Inside this module only: who is told of what a check sees, as it sees it.
namespace signweave {

class CheckListener {
 public:
  virtual ~CheckListener() = default;
  virtual void begin(std::uint32_t recordings) = 0;
  /// One recording's turn; its name, or "catalogue entry N" as long as it is not known.
  virtual void slot(std::uint32_t number, const std::string& name) = 0;
  /// Every now and then within a recording's turn.
  virtual void alive() = 0;
  virtual void fault(const std::string& text) = 0;
};

/// Checks the recordings from slot `first` on.
void check_slots(const Database& database, std::uint32_t first, CheckListener& listener);

}  // namespace signweave
