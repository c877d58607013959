#include "signweave/live/transition_cache.h"

namespace signweave {
namespace {

std::size_t bytes_of(const MadeTransition& made) {
  const Motion& frames = *made.frames;
  return sizeof(MadeTransition) + frames.rotations().size_bytes() + frames.translations().size_bytes() +
         static_cast<std::size_t>(frames.frame_count()) * frames.tracks().size() * sizeof(float);
}

}  // namespace

std::shared_ptr<const MadeTransition> TransitionCache::find(const std::string& key) {
  const std::lock_guard lock(mutex_);
  const auto at = by_key_.find(key);
  if (at == by_key_.end()) {
    ++counts_.missed;
    return nullptr;
  }
  ++counts_.found;
  return held_[at->second].made;
}

void TransitionCache::keep(const std::string& key, std::shared_ptr<const MadeTransition> made) {
  const std::size_t bytes = bytes_of(*made) + 2 * key.size();
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

void TransitionCache::clear() {
  const std::lock_guard lock(mutex_);
  by_key_.clear();
  held_.clear();
  counts_.bytes = 0;
}

TransitionCache::Counts TransitionCache::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

}  // namespace signweave
