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

/// A generated transition between two tokens.
struct MadeTransition {
  JunctionCuts cuts;
  std::optional<GroundTransform> standing;  ///< of the clip after it
  std::shared_ptr<const Motion> frames;
};

/// A cache of generated transitions for players that sign the same tokens in sequence: a loop, or an utterance with
/// many viewers. When full, it evicts a random entry: evicting the oldest would make many loops that play in turn miss
/// every time. Threads may share it.
class TransitionCache {
 public:
  /// Stores at most this many bytes of frames.
  explicit TransitionCache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// The key contains everything that a transition depends on.
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
