#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <unordered_map>
#include <vector>

#include "signweave/motion/blend.h"
#include "signweave/motion/motion.h"
#include "signweave/render/junction.h"

namespace signweave {

/// A transition between two tokens, as it was made.
struct MadeTransition {
  JunctionCuts cuts;
  std::optional<GroundTransform> standing;  ///< of the clip after it
  std::shared_ptr<const Motion> frames;
};

/// Transitions that were made, for all who sign the same tokens one after the other: a loop, or an utterance that many
/// watch. Where there are too many, any of them goes: many loops that come round in turn would find nothing of theirs
/// if the oldest went. Threads may share it.
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
  std::vector<Held> held_;
  std::unordered_map<std::string, std::size_t> by_key_;  ///< index in held_
  std::minstd_rand random_;
  Counts counts_;
};

}  // namespace signweave
