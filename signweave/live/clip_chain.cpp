#include "signweave/live/clip_chain.h"

#include <algorithm>

#include "signweave/render/plan.h"

namespace signweave {

void ClipChain::begin(std::shared_ptr<LiveClip> clip) {
  clips_.clear();
  add(std::move(clip));
}

void ClipChain::add(std::shared_ptr<LiveClip> clip) {
  clip->number = next_number_++;
  if (!clip->captured.place) clip->captured.place = clips_.empty() ? 0 : clips_.back()->captured.place;
  clips_.push_back(std::move(clip));
  if (clips_.size() > kMostClips) clips_.pop_front();
}

void ClipChain::end_with(const std::shared_ptr<LiveClip>& clip) {
  if (std::ranges::find(clips_, clip) == clips_.end()) clips_ = {clip};
  while (clips_.back() != clip) clips_.pop_back();
  next_number_ = clip->number + 1;
}

void ClipChain::replace_back(std::shared_ptr<LiveClip> clip) {
  clip->number = clips_.back()->number;
  clips_.back() = std::move(clip);
}

std::optional<ShownScore> ClipChain::score(const TransitionBuilder& builder, const SourceRef& skeleton,
                                           std::int64_t next, std::int64_t end, std::size_t most_clips) const {
  if (clips_.empty()) return std::nullopt;
  const std::size_t left_out = clips_.size() - std::min(clips_.size(), std::max<std::size_t>(most_clips, 1));
  Plan plan;
  for (std::size_t i = left_out; i < clips_.size(); ++i) {
    plan.placed.push_back(clips_[i]->placed);
    if (i > left_out) plan.cuts.push_back(*clips_[i]->cuts);
  }
  PlacedClip& front = plan.placed.front();
  PlacedClip& back = plan.placed.back();
  front.before = clips_[left_out]->cuts ? 0 : front.preparation;  // its transition is not part of this score
  const std::int64_t begin = front.begin();
  for (PlacedClip& placed : plan.placed) placed.core -= begin;
  plan.frames = end - begin;
  if (plan.frames <= back.core) return std::nullopt;  // nothing of it is known yet
  back.core_frames = std::min(back.core_frames, plan.frames - back.core);
  back.after = plan.frames - back.core_end();
  return ShownScore{.score = score_of(plan, builder.settings(), skeleton),
                    .next = next - begin,
                    .first_clip = clips_[left_out]->number};
}

}  // namespace signweave
