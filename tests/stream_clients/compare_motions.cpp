// compare_motions A.bvh B.bvh: exit status 0 if both are the same motion within the error of a stream's quantisation:
// joints by name, rotations, translations, number and rate of frames. Prints the largest differences.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "signweave/formats/bvh/bvh.h"
#include "signweave/live/frame_codec.h"

namespace {

using namespace signweave;

// The error of BVH's decimals and single precision, on both sides.
constexpr double kRadians = kRotationError + 4e-6;
constexpr double kMetres = 10e-6 + 2e-6;

double angle_between(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b) {
  const Eigen::Quaterniond from = a.cast<double>().normalized();
  const Eigen::Quaterniond to = b.cast<double>().normalized();
  return 2 * std::atan2((from.conjugate() * to).vec().norm(), std::abs(from.dot(to)));
}

struct Worst {
  double by = 0;
  std::int64_t frame = 0;
  std::string joint;

  void see(double difference, std::int64_t at, const Joint& of) {
    if (difference > by) *this = {difference, at, of.name};
  }
};

bool compare(const Motion& a, const Motion& b) {
  if (a.frame_count() != b.frame_count()) {
    throw std::runtime_error(fmt::format("{} frames and {}", a.frame_count(), b.frame_count()));
  }
  if (a.rate() != b.rate()) {
    throw std::runtime_error(fmt::format("{} frames per second and {}", to_string(a.rate()), to_string(b.rate())));
  }
  const Skeleton& skeleton = a.skeleton();
  if (skeleton.joint_count() != b.skeleton().joint_count()) throw std::runtime_error("other joints");
  Worst turned, moved;
  for (JointIndex joint = 0; joint < static_cast<JointIndex>(skeleton.joint_count()); ++joint) {
    const Joint& of = skeleton.joint(joint);
    const std::optional<JointIndex> other = b.skeleton().find(of.name);
    if (!other) throw std::runtime_error("no joint " + of.name);
    moved.see((of.offset - b.skeleton().joint(*other).offset).norm(), -1, of);
    const auto shift = skeleton.translation_of(joint);
    const auto other_shift = b.skeleton().translation_of(*other);
    if (shift.has_value() != other_shift.has_value()) throw std::runtime_error(of.name + " is translated in one");
    for (std::int64_t frame = 0; frame < a.frame_count(); ++frame) {
      const PoseView x = a.pose(frame);
      const PoseView y = b.pose(frame);
      turned.see(
          angle_between(x.rotations[static_cast<std::size_t>(joint)], y.rotations[static_cast<std::size_t>(*other)]),
          frame, of);
      if (shift) moved.see((x.translations[*shift] - y.translations[*other_shift]).cwiseAbs().maxCoeff(), frame, of);
    }
  }
  fmt::print("{} frames; apart by {:.1f} microradians at most ({}, frame {}) and {:.1f} micrometres ({}, frame {})\n",
             a.frame_count(), 1e6 * turned.by, turned.joint, turned.frame, 1e6 * moved.by, moved.joint, moved.frame);
  return a.frame_count() > 0 && turned.by <= kRadians && moved.by <= kMetres;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    // Both are written in centimetres, Y up: guessing could differ for the one that moves less.
    const bvh::ReadOptions options{.up = bvh::UpAxis::y, .unit = 0.01};
    return compare(bvh::read(argv[1], options).motion, bvh::read(argv[2], options).motion) ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "compare_motions: {}\n", error.what());
    return 1;
  }
}
