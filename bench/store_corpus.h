#pragma once

// The reads of bench/store: the demo corpus in memory, the requests, and the memcpy of what they request.

#include <cstring>
#include <random>

#include "bench/measure.h"
#include "demo/corpus.h"
#include "signweave/motion/motion.h"
#include "signweave/motion_db/access_mode.h"

namespace signweave::bench {

struct Corpus {
  struct PlacedSign {
    std::size_t motion = 0;
    FrameRange frames;
  };
  std::vector<Motion> motions;
  std::vector<PlacedSign> signs;
  JointSet hand;  ///< the right hand and its fingers

  std::int64_t frame_count() const {
    std::int64_t frames = 0;
    for (const Motion& motion : motions) frames += motion.frame_count();
    return frames;
  }
};

inline Corpus make_corpus(double minutes) {
  Corpus corpus;
  for (const demo::Script& script : demo::corpus_scripts(minutes)) {
    demo::SyntheticRecording made = demo::make_recording(script, {100, 1}, 1);
    for (const demo::PlacedSign& sign : made.timeline.signs) {
      corpus.signs.push_back({corpus.motions.size(), {sign.begin, sign.end}});
    }
    corpus.motions.push_back(std::move(made.motion));
  }
  const Skeleton& skeleton = corpus.motions.front().skeleton();
  for (std::size_t joint = 0; joint < skeleton.joint_count(); ++joint) {
    const auto index = static_cast<JointIndex>(joint);
    if (skeleton.joint(index).name.starts_with("RightHand")) corpus.hand.push_back(index);
  }
  return corpus;
}

/// A range of frames of one motion.
struct Ask {
  std::size_t motion = 0;
  FrameRange frames;
};

/// A kind of request, with many instances at random positions.
struct Question {
  std::string_view name;
  JointSet joints;           ///< empty: all
  AccessMode::Kind fits;     ///< the mode designed for it
  bool from_source = false;  ///< read through a StoredSource that has verified everything: poses only, into used memory
  std::vector<Ask> asks = {};
};

inline std::vector<Question> questions(const Corpus& corpus) {
  using Kind = AccessMode::Kind;
  std::vector<Question> all = {
      {.name = "whole", .joints = {}, .fits = Kind::full},
      {.name = "sign", .joints = {}, .fits = Kind::by_frame},
      {.name = "hand", .joints = corpus.hand, .fits = Kind::by_joint},
      {.name = "hand_of_sign", .joints = corpus.hand, .fits = Kind::by_joint_and_frame},
      {.name = "sign_again", .joints = {}, .fits = Kind::by_frame, .from_source = true},
      {.name = "frame_again", .joints = {}, .fits = Kind::by_frame, .from_source = true},
  };
  std::mt19937 random(1);
  for (Question& question : all) {
    const int asks = question.name == "frame_again" ? 200'000 : 4'000;
    for (int i = 0; i < asks; ++i) {
      const Corpus::PlacedSign& sign = corpus.signs[random() % corpus.signs.size()];
      const std::size_t motion = random() % corpus.motions.size();
      const std::int64_t frames = corpus.motions[motion].frame_count();
      if (question.name.find("sign") != std::string_view::npos) {
        question.asks.push_back({sign.motion, sign.frames});
      } else if (question.name == "frame_again") {
        const auto frame = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(frames));
        question.asks.push_back({motion, {frame, frame + 1}});
      } else {
        question.asks.push_back({motion, {0, frames}});
      }
    }
  }
  return all;
}

inline std::size_t bytes_asked(const Corpus& corpus, const Question& question, const Ask& ask) {
  const Motion& motion = corpus.motions[ask.motion];
  const Skeleton& skeleton = motion.skeleton();
  std::size_t frame = question.joints.size() * sizeof(Eigen::Quaternionf);
  if (question.joints.empty()) {
    frame = skeleton.joint_count() * sizeof(Eigen::Quaternionf) +
            skeleton.translation_count() * sizeof(Eigen::Vector3f) +
            (question.from_source ? 0 : motion.tracks().size() * sizeof(float));
  }
  return static_cast<std::size_t>(ask.frames.size()) * frame;
}

/// The yardstick: copies the same numbers from the motions in memory to a buffer laid out as the answer.
class BareCopy {
 public:
  explicit BareCopy(const Corpus& corpus) : corpus_(corpus) {
    for (const Motion& motion : corpus.motions) {
      rotations_.resize(std::max(rotations_.size(), motion.rotations().size()));
      translations_.resize(std::max(translations_.size(), motion.translations().size()));
      tracks_.resize(motion.tracks().size());
      for (std::vector<float>& track : tracks_) {
        track.resize(std::max(track.size(), static_cast<std::size_t>(motion.frame_count())));
      }
    }
  }

  void operator()(const Question& question, const Ask& ask) {
    const Motion& motion = corpus_.motions[ask.motion];
    const std::size_t joints = motion.skeleton().joint_count();
    const std::size_t moved = motion.skeleton().translation_count();
    const auto begin = static_cast<std::size_t>(ask.frames.begin);
    const auto count = static_cast<std::size_t>(ask.frames.size());
    if (question.joints.empty()) {
      copy(rotations_.data(), motion.rotations().subspan(begin * joints, count * joints));
      copy(translations_.data(), motion.translations().subspan(begin * moved, count * moved));
      for (std::size_t i = 0; !question.from_source && i < tracks_.size(); ++i) {
        copy(tracks_[i].data(), std::span(motion.tracks()[i].values).subspan(begin, count));
      }
    } else {  // the joints of a hand are adjacent
      const auto first = static_cast<std::size_t>(question.joints.front());
      for (std::size_t frame = 0; frame < count; ++frame) {
        copy(rotations_.data() + frame * joints + first,
             motion.rotations().subspan((begin + frame) * joints + first, question.joints.size()));
      }
    }
    keep(rotations_);
  }

 private:
  template <typename T>
  static void copy(T* to, std::span<const T> from) {
    if (!from.empty()) std::memcpy(static_cast<void*>(to), static_cast<const void*>(from.data()), from.size_bytes());
  }

  const Corpus& corpus_;
  std::vector<Eigen::Quaternionf> rotations_;
  std::vector<Eigen::Vector3f> translations_;
  std::vector<std::vector<float>> tracks_;
};

}  // namespace signweave::bench
