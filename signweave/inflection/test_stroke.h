#pragma once

// For tests: strokes of the person of render's tests, changed in space.

#include <memory>
#include <utility>

#include "signweave/inflection/aim.h"
#include "signweave/inflection/inflected_source.h"
#include "signweave/render/test_signing_person.h"

namespace signweave::testing_inflection {

using testing_person::Person;

inline constexpr std::size_t kRight = static_cast<std::size_t>(Side::right);

/// The left hand rests, the right one moves as `wrist` says during the stroke, and is still before and after it.
inline Person::WristAt right_alone(std::function<Eigen::Vector3f(float)> wrist) {
  return [wrist = std::move(wrist)](Side side, float t) {
    return side == Side::left ? Eigen::Vector3f(0.25f, 0.85f, 0.1f) : wrist(std::clamp(2 * t - 0.5f, 0.0f, 1.0f));
  };
}
/// From the chest outwards.
inline Eigen::Vector3f outward(float t) {
  return {-0.12f - 0.03f * t, 1.25f + 0.04f * t, 0.2f + 0.22f * t};
}

/// A person with one stroke, which has frames before and after it.
struct Stroke {
  static constexpr FrameRange kCore{20, 60};
  Person person;
  std::shared_ptr<const SignerRig> rig;
  std::shared_ptr<const MotionSource> source;
  StrokeChanger changer;
  CapturedStroke captured;

  explicit Stroke(const Person::WristAt& wrist)
      : rig(std::make_shared<SignerRig>(SignerRig{person.signer, person.groups})),
        source(std::make_shared<MemorySource>(person.stroke(wrist, 80, false))),
        changer(*person.skeleton, rig),
        captured(captured_stroke(changer, *source, kCore)) {}

  std::shared_ptr<InflectedSource> changed(StrokeChange change) const {
    change.before = change.after = 15;
    return std::make_shared<InflectedSource>(source, rig, kCore, std::move(change));
  }
  Locus locus(std::string_view text) const { return resolve(read_locus(text), {}, 0, *person.signer.body); }
  HandInSpace hand(const MotionSource& of, std::int64_t frame, Side side) {
    Pose pose(*person.skeleton);
    of.read({frame, frame + 1}, {pose.rotations, pose.translations});
    return changer.look(std::as_const(pose).view(), captured.space, side);
  }
  Motion all(const MotionSource& of) const {
    Motion motion(of.skeleton(), of.rate(), of.frame_count());
    of.read({0, of.frame_count()}, motion.poses({0, of.frame_count()}));
    return motion;
  }
};

}  // namespace signweave::testing_inflection
