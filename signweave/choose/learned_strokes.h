#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "signweave/database/database.h"
#include "signweave/inflection/learned_stroke.h"
#include "signweave/space/roles.h"

namespace signweave {

/// The loci of a sign of a recording, as annotated over it (loci_over); names that an utterance would have to set up
/// are left out.
LociOfSign captured_loci(const Snapshot& snapshot, std::size_t recording, TimeSpan sign, const SignerBody& body);

/// What is learned from the tokens of glosses about where their strokes go, each when it is first needed. Learning
/// reads the strokes of all tokens with annotated loci. For any number of threads.
class LearnedStrokes {
 public:
  /// Learned again when the database has changed. `why_not` is set if the tokens do not suffice. Throws Error{corrupt}.
  std::shared_ptr<const LearnedStroke::Learned> of(const Snapshot& snapshot, const std::string& gloss, SpaceRole role);

 private:
  std::mutex mutex_;
  std::shared_ptr<const Contents> contents_;
  std::map<std::pair<std::string, SpaceRole>, std::shared_ptr<const LearnedStroke::Learned>> known_;
};

/// Of more tokens than this, as many are taken, evenly spread. Reading one takes about a millisecond.
inline constexpr std::size_t kMostLearnedTokens = 200;

}  // namespace signweave
