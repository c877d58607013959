#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "signweave/core/error.h"
#include "signweave/database/database.h"

namespace signweave::calls {

/// Who is told what while a call runs; any may be empty. All are called on the thread of the call.
struct Listener {
  std::function<void(const Notice&)> notice;  ///< something that stopped nothing
  /// A part of the input is at fault, in one line, and what would fix it; the rest is done.
  std::function<void(const std::string& line, const Remedies&)> fault;
  std::function<void(std::string_view)> stage;  ///< what begins now: its progress starts from 0
  std::function<void(double)> progress;         ///< the part that is done, in [0, 1]; may throw to cancel

  void tell(const Notice& one) const {
    if (notice) notice(one);
  }
  void tell_all(const std::vector<Notice>& notices) const {
    for (const Notice& one : notices) tell(one);
  }
  void blame(const std::string& line, const Remedies& remedies = {}) const {
    if (fault) fault(line, remedies);
  }
  void begin(std::string_view what) const {
    if (stage) stage(what);
  }
  void advance(double fraction) const {
    if (progress) progress(fraction);
  }
};

/// Tells of recordings that are damaged and therefore left out.
void tell_damage(const Database& database, const Listener& listener);

/// After a change: what the corpus teaches of joins is learned and stored. That it could not be stored is told; what
/// was changed stays.
void learn(Database& database, const Listener& listener);

}  // namespace signweave::calls
