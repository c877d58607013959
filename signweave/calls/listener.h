#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "signweave/core/error.h"
#include "signweave/database/database.h"

namespace signweave::calls {

/// Receives reports while a call runs; any function may be empty. All are called on the thread of the call.
struct Listener {
  std::function<void(const Notice&)> notice;  ///< something that did not stop the call
  /// A fault in a part of the input, in one line, and what would fix it; the rest is processed.
  std::function<void(const std::string& line, const Remedies&)> fault;
  std::function<void(std::string_view)> stage;  ///< the stage that begins now: its progress starts from 0
  std::function<void(double)> progress;         ///< the completed fraction, in [0, 1]; may throw to cancel

  void notify(const Notice& one) const {
    if (notice) notice(one);
  }
  void notify_all(const std::vector<Notice>& notices) const {
    for (const Notice& one : notices) notify(one);
  }
  void report_fault(const std::string& line, const Remedies& remedies = {}) const {
    if (fault) fault(line, remedies);
  }
  void begin(std::string_view what) const {
    if (stage) stage(what);
  }
  void advance(double fraction) const {
    if (progress) progress(fraction);
  }
};

/// Reports recordings that are damaged and therefore left out.
void report_damage(const Database& database, const Listener& listener);

/// Learns join costs from the corpus and stores them; to be called after a change. If that fails, the fault is reported
/// and the change stays.
void learn(Database& database, const Listener& listener);

}  // namespace signweave::calls
