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

/// A number of bytes, about.
std::size_t bytes_in(const Motion& frames) noexcept;
inline std::size_t held_bytes(const MadeTransition& made) noexcept {
  return sizeof(MadeTransition) + bytes_in(*made.frames);
}

/// A cache of generated frames for players that sign the same tokens in sequence: a loop, or an utterance with many
/// viewers. When full, it evicts a random entry: evicting the oldest would make many loops that play in turn miss
/// every time. `held_bytes` says how large a Made is. Threads may share it.
template <typename Made>
class MadeCache {
 public:
  /// Stores at most this many bytes of frames.
  explicit MadeCache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// The key contains everything that the frames depend on.
  std::shared_ptr<const Made> find(const std::string& key) {
    const std::lock_guard lock(mutex_);
    const auto at = by_key_.find(key);
    if (at == by_key_.end()) {
      ++counts_.missed;
      return nullptr;
    }
    ++counts_.found;
    return held_[at->second].made;
  }

  void keep(const std::string& key, std::shared_ptr<const Made> made) {
    const std::size_t bytes = held_bytes(*made) + 2 * key.size();
    const std::lock_guard lock(mutex_);
    if (bytes > most_bytes_ || by_key_.contains(key)) return;
    while (counts_.bytes + bytes > most_bytes_) {
      const std::size_t gone = random_() % held_.size();
      counts_.bytes -= held_[gone].bytes;
      by_key_.erase(held_[gone].key);
      if (gone + 1 < held_.size()) {
        held_[gone] = std::move(held_.back());
        by_key_[held_[gone].key] = gone;
      }
      held_.pop_back();
    }
    by_key_.emplace(key, held_.size());
    held_.push_back({.key = key, .made = std::move(made), .bytes = bytes});
    counts_.bytes += bytes;
  }

  void clear() {
    const std::lock_guard lock(mutex_);
    by_key_.clear();
    held_.clear();
    counts_.bytes = 0;
  }

  struct Counts {
    std::uint64_t found = 0;
    std::uint64_t missed = 0;
    std::size_t bytes = 0;
  };
  Counts counts() const {
    const std::lock_guard lock(mutex_);
    return counts_;
  }

 private:
  struct Held {
    std::string key;
    std::shared_ptr<const Made> made;
    std::size_t bytes = 0;
  };

  std::size_t most_bytes_;
  mutable std::mutex mutex_;
  std::vector<Held> held_;
  std::unordered_map<std::string, std::size_t> by_key_;  ///< index in held_
  std::minstd_rand random_;
  Counts counts_;
};

using TransitionCache = MadeCache<MadeTransition>;

}  // namespace signweave
