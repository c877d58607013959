#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

#include "signweave/motion/blend.h"
#include "signweave/motion/motion.h"
#include "signweave/synthesis/junction.h"

namespace signweave {

/// A transition between two tokens, as it was made.
struct MadeTransition {
  JunctionCuts cuts;
  std::optional<GroundTransform> transform;  ///< of the stretch after it
  std::shared_ptr<const Motion> frames;
};

/// The transitions that were made last, for all who sign the same tokens one after the other: a loop, or an utterance
/// that many watch. Threads may share it.
class TransitionCache {
 public:
  /// Holds no more than so many bytes of frames.
  explicit TransitionCache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// The key tells all that a transition depends on.
  std::shared_ptr<const MadeTransition> find(const std::string& key);
  void keep(const std::string& key, std::shared_ptr<const MadeTransition> made);
  void clear();

  struct Counts {
    std::uint64_t found = 0;
    std::uint64_t missed = 0;
    std::size_t bytes = 0;
  };
  Counts counts() const;

 private:
  struct Held {
    std::string key;
    std::shared_ptr<const MadeTransition> made;
    std::size_t bytes = 0;
  };

  std::size_t most_bytes_;
  mutable std::mutex mutex_;
  std::list<Held> held_;  ///< the one used last comes first
  std::unordered_map<std::string, std::list<Held>::iterator> by_key_;
  Counts counts_;
};

}  // namespace signweave
