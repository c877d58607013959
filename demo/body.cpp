#include "demo/body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace signweave::demo {
namespace {

using Eigen::Vector3f;

/// Follows a target as an overdamped spring does, without overshooting.
class Follower {
 public:
  /// The higher `rate` (per second), the closer it follows: it lags by about 2 / rate seconds.
  Follower(double rate, double start) : rate_(rate), value_(start) {}
  double step(double target, double seconds) {
    const double pull = rate_ * rate_ * (target - value_) - 2 * rate_ * speed_;
    speed_ += pull * seconds;
    value_ += speed_ * seconds;
    return value_;
  }

 private:
  double rate_;
  double value_;
  double speed_ = 0;
};

/// 0 outside, 1 in the middle of a time range, smooth.
double bump(double at, double begin, double end) {
  if (at <= begin || at >= end) return 0;
  const double s = std::sin(std::numbers::pi * (at - begin) / (end - begin));
  return s * s;
}

/// The direction of the eyes from some moment on.
struct Glance {
  double from = 0;  ///< frame
  Gaze gaze = Gaze::viewer;
  float aside = 0, up = 0;  ///< metres at the viewer: a gaze does not rest on one point
};

std::vector<Glance> glances(const Timeline& timeline, Random& random) {
  const double fps = timeline.rate.hertz();
  std::vector<Glance> result = {{}};
  const auto add = [&](double from, Gaze gaze) {
    from = std::max(from, result.back().from + 0.12 * fps);
    result.push_back(
        {from, gaze, static_cast<float>(0.05 * random.normal()), static_cast<float>(0.03 * random.normal())});
  };
  /// Small jumps around the viewer's face until then.
  const auto linger = [&](double until) {
    for (;;) {
      const double next = result.back().from + random.uniform(0.7, 2.4) * fps;
      if (next > until - 0.3 * fps) return;
      add(next, Gaze::viewer);
    }
  };
  for (const PlacedSign& sign : timeline.signs) {
    if (sign.shape->face.gaze != Gaze::hand) continue;
    const double begin = static_cast<double>(sign.stroke_begin) - random.uniform(0.06, 0.20) * fps;
    linger(begin);
    add(begin, Gaze::hand);
    add(static_cast<double>(sign.stroke_end) + random.uniform(-0.10, 0.12) * fps, Gaze::viewer);
  }
  linger(static_cast<double>(timeline.frames));
  return result;
}

struct Turned {
  double yaw, pitch;  ///< of a direction; pitch is positive downwards
};
Turned turned(const Vector3f& direction) {
  return {std::atan2(static_cast<double>(direction.x()), static_cast<double>(direction.z())),
          -std::asin(std::clamp(static_cast<double>(direction.y()), -1.0, 1.0))};
}

Vector3f look_at(const Glance& glance, const Vector3f& right, const Vector3f& left) {
  const Vector3f eyes(0, 1.59f, 0.09f);
  if (glance.gaze == Gaze::viewer) return Vector3f(glance.aside, glance.up, 2.2f).normalized();
  // The hands as a whole, weighted to the one that moves more; slightly above the wrists. The weight of the left hand
  // rises as it approaches the height of the right: with a hard switch the eyes would jump by 25° from frame to frame.
  const float near = std::clamp((left.y() - right.y() + 0.20f) / 0.10f, 0.0f, 1.0f);
  const float share = 0.35f * near * near * (3 - 2 * near);
  const Vector3f hands = right + share * (left - right) + Vector3f(0, 0.07f, 0.05f);
  return (hands - eyes).normalized();
}

/// Head movements that accompany signs and sentences, radians.
struct Gesture {
  double begin, end;  ///< frames
  double nod;
};

}  // namespace

std::vector<BodyFrame> move_body(const Timeline& timeline, const HandPlan& plan, Random& random) {
  return move_body(
      timeline, [&](Side side, double frame) { return plan.at(side, frame); }, random);
}

std::vector<BodyFrame> move_body(const Timeline& timeline, const WristPath& wrist, Random& random) {
  const double fps = timeline.rate.hertz();
  const double seconds_of_frame = 1 / fps;

  // Values that change from sentence to sentence and from sign to sign, as steps that the followers smooth.
  struct Stance {
    double from, weight, tilt, turn;
  };
  std::vector<Stance> stances = {{0, random.uniform(-0.012, 0.012), 0, 0}};
  std::vector<Gesture> gestures;
  for (std::size_t i = 0; i < timeline.signs.size(); ++i) {
    const PlacedSign& sign = timeline.signs[i];
    const auto begin = static_cast<double>(sign.stroke_begin);
    const auto end = static_cast<double>(sign.stroke_end);
    Stance stance = stances.back();
    stance.from = static_cast<double>(sign.begin);
    stance.tilt = 0.035 * random.normal();
    stance.turn = 0.030 * random.normal();
    const double lift = sign.shape->face.brows == Brows::raised ? -0.035 : 0.025;
    gestures.push_back({begin - 0.15 * fps, end + 0.15 * fps, lift * random.uniform(0.5, 1.3)});
    gestures.push_back({begin - 0.05 * fps, begin + 0.40 * fps, random.uniform(0.01, 0.04)});
    stances.push_back(stance);
    if (!ends_unit(timeline, i)) continue;
    gestures.push_back({end - 0.10 * fps, end + 0.55 * fps, random.uniform(0.10, 0.16)});
    stance.from = end;
    const double tilt = random.uniform(0.03, 0.08);
    stance.tilt = random.uniform() < 0.5 ? -tilt : tilt;
    stance.weight = random.uniform(-0.016, 0.016);
    stances.push_back(stance);
  }
  const std::vector<Glance> looks = glances(timeline, random);
  const Wander hips[] = {{random, 0.05, 0.35}, {random, 0.05, 0.35}, {random, 0.05, 0.35}};
  const Wander trunk[] = {{random, 0.05, 0.35}, {random, 0.05, 0.35}, {random, 0.05, 0.35}};
  const Wander head[] = {{random, 0.1, 0.7}, {random, 0.1, 0.7}, {random, 0.1, 0.7}};
  const double breath = random.uniform(0.22, 0.28);

  Follower weight(1.8, stances[0].weight), yaw(7, 0), pitch(6, 0), roll(6, 0);
  Follower head_yaw(9, 0), head_pitch(9, 0), head_roll(4, 0);
  std::vector<BodyFrame> frames(static_cast<std::size_t>(timeline.frames));
  std::size_t stance = 0, look = 0, gesture = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto at = static_cast<double>(i);
    const double seconds = at * seconds_of_frame;
    while (stance + 1 < stances.size() && stances[stance + 1].from <= at) ++stance;
    while (look + 1 < looks.size() && looks[look + 1].from <= at) ++look;
    while (gesture < gestures.size() && gestures[gesture].end + 2 * fps < at) ++gesture;
    const Vector3f right = wrist(Side::right, at);
    const Vector3f left = wrist(Side::left, at);
    BodyFrame& body = frames[i];
    body.breath = std::sin(2 * std::numbers::pi * breath * seconds);

    const double shift = weight.step(stances[stance].weight, seconds_of_frame);
    body.hips = Vector3f(static_cast<float>(shift + 0.004 * hips[0].at(seconds)), 0,
                         static_cast<float>(0.004 * hips[1].at(seconds)));
    body.hips_yaw = 0.012 * hips[2].at(seconds);
    body.hips_roll = 0.6 * shift;

    // The shoulder of the hand that reaches farther moves forward with it, and the trunk turns and leans towards the
    // hands.
    const double aside = 0.5 * static_cast<double>(right.x() + left.x());
    const double reach = static_cast<double>(std::max(right.z(), left.z())) - 0.22;
    const double high = static_cast<double>(std::max(right.y(), left.y())) - 1.30;
    body.yaw = 0.010 * trunk[2].at(seconds) +
               yaw.step(0.24 * static_cast<double>(right.z() - left.z()) + 0.40 * aside, seconds_of_frame);
    body.pitch = 0.008 * trunk[0].at(seconds) + pitch.step(0.22 * reach - 0.06 * high, seconds_of_frame);
    body.roll = 0.010 * trunk[1].at(seconds) - 0.5 * shift + roll.step(-0.26 * aside, seconds_of_frame);

    const Vector3f now = look_at(looks[look], right, left);
    const double leap = std::clamp((at - looks[look].from) / (0.05 * fps), 0.0, 1.0);
    const Vector3f before = look == 0 ? now : look_at(looks[look - 1], right, left);
    body.look = (before + static_cast<float>(leap * leap * (3 - 2 * leap)) * (now - before)).normalized();
    const Turned gaze = turned(body.look);
    double nod = 0;
    for (std::size_t g = gesture; g < gestures.size() && gestures[g].begin < at + 2 * fps; ++g) {
      nod += gestures[g].nod * bump(at, gestures[g].begin, gestures[g].end);
    }
    body.head_yaw = 0.025 * head[0].at(seconds) + 0.35 * body.yaw +
                    head_yaw.step(0.45 * gaze.yaw + stances[stance].turn, seconds_of_frame);
    body.head_pitch =
        0.012 * head[1].at(seconds) + 0.02 + nod + head_pitch.step(std::min(0.36 * gaze.pitch, 0.23), seconds_of_frame);
    body.head_roll =
        0.015 * head[2].at(seconds) + 0.4 * body.roll + head_roll.step(stances[stance].tilt, seconds_of_frame);
  }
  return frames;
}

}  // namespace signweave::demo
