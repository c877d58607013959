#include "signweave/live/clip_chain.h"

#include <algorithm>

#include "signweave/render/plan.h"

namespace signweave {

void ClipChain::begin(std::shared_ptr<Woven> clip) {
  clips_.clear();
  add(std::move(clip));
}

void ClipChain::add(std::shared_ptr<Woven> clip) {
  clip->number = next_number_++;
  clips_.push_back(std::move(clip));
  if (clips_.size() > kMostClips) clips_.pop_front();
}

void ClipChain::end_with(const std::shared_ptr<Woven>& clip) {
  if (std::ranges::find(clips_, clip) == clips_.end()) {
    begin(clip);
    return;
  }
  while (clips_.back() != clip) clips_.pop_back();
  next_number_ = clip->number + 1;
}

void ClipChain::replace_back(std::shared_ptr<Woven> clip) {
  clip->number = clips_.back()->number;
  clips_.back() = std::move(clip);
}

std::optional<LiveScore> ClipChain::score(const Weaver& weaver, const SourceRef& skeleton, std::int64_t next,
                                          std::int64_t end) const {
  if (clips_.empty()) return std::nullopt;
  Plan plan;
  for (const std::shared_ptr<Woven>& clip : clips_) {
    plan.laid.push_back(clip->laid);
    if (plan.laid.size() > 1) plan.cuts.push_back(*clip->cuts);
  }
  Laid& front = plan.laid.front();
  Laid& back = plan.laid.back();
  front.before = clips_.front()->cuts ? 0 : front.preparation;  // what led to it is not of this score
  const std::int64_t begin = front.begin();
  for (Laid& laid : plan.laid) laid.core -= begin;
  plan.frames = end - begin;
  back.core_frames = std::min(back.core_frames, plan.frames - back.core);
  back.after = plan.frames - back.core_end();
  return LiveScore{
      .score = score_of(plan, weaver.settings(), skeleton), .next = next - begin, .first_clip = clips_.front()->number};
}

}  // namespace signweave
