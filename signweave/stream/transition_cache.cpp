#include "signweave/stream/transition_cache.h"

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
  held_.splice(held_.begin(), held_, at->second);
  return at->second->made;
}

void TransitionCache::keep(const std::string& key, std::shared_ptr<const MadeTransition> made) {
  const std::size_t bytes = bytes_of(*made) + 2 * key.size();
  const std::lock_guard lock(mutex_);
  if (bytes > most_bytes_ || by_key_.contains(key)) return;
  held_.push_front({.key = key, .made = std::move(made), .bytes = bytes});
  by_key_.emplace(key, held_.begin());
  counts_.bytes += bytes;
  while (counts_.bytes > most_bytes_) {
    counts_.bytes -= held_.back().bytes;
    by_key_.erase(held_.back().key);
    held_.pop_back();
  }
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
