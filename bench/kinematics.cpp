// Forward kinematics of a body of 60 joints per joint and frame, against a naive scalar loop over the same hierarchy
// that does only the arithmetic; and how many times faster than real time hands are measured.

#include <cstdlib>
#include <cstring>

#include "bench/measure.h"
#include "signweave/features/hand_motion.h"
#include "signweave/motion/kinematics.h"
#include "signweave/rig/test_rig.h"

namespace {

using namespace signweave;

/// The naive loop: numbers in arrays, one product and one rotated offset per joint.
class NaiveLoop {
 public:
  explicit NaiveLoop(const Skeleton& skeleton) {
    int translation = 0;
    for (const Joint& joint : skeleton.joints()) {
      parents_.push_back(joint.parent);
      translations_.push_back(joint.translated ? translation++ : -1);
      offsets_.insert(offsets_.end(), {joint.offset.x(), joint.offset.y(), joint.offset.z()});
    }
    rotations_.resize(4 * parents_.size());
    positions_.resize(3 * parents_.size());
  }

  void pose(const float* rotations, const float* translations) {
    for (std::size_t i = 0; i < parents_.size(); ++i) {
      const float* local = translations_[i] < 0 ? &offsets_[3 * i] : translations + 3 * translations_[i];
      const float* b = rotations + 4 * i;
      float* q = &rotations_[4 * i];
      float* p = &positions_[3 * i];
      if (parents_[i] < 0) {
        std::memcpy(q, b, 4 * sizeof(float));
        std::memcpy(p, local, 3 * sizeof(float));
        continue;
      }
      const auto parent = static_cast<std::size_t>(parents_[i]);
      const float x = rotations_[4 * parent], y = rotations_[4 * parent + 1], z = rotations_[4 * parent + 2],
                  w = rotations_[4 * parent + 3];
      q[0] = w * b[0] + x * b[3] + y * b[2] - z * b[1];
      q[1] = w * b[1] + y * b[3] + z * b[0] - x * b[2];
      q[2] = w * b[2] + z * b[3] + x * b[1] - y * b[0];
      q[3] = w * b[3] - x * b[0] - y * b[1] - z * b[2];
      const float tx = 2 * (y * local[2] - z * local[1]);
      const float ty = 2 * (z * local[0] - x * local[2]);
      const float tz = 2 * (x * local[1] - y * local[0]);
      p[0] = positions_[3 * parent] + local[0] + w * tx + y * tz - z * ty;
      p[1] = positions_[3 * parent + 1] + local[1] + w * ty + z * tx - x * tz;
      p[2] = positions_[3 * parent + 2] + local[2] + w * tz + x * ty - y * tx;
    }
  }
  const std::vector<float>& positions() const noexcept { return positions_; }

 private:
  std::vector<int> parents_, translations_;
  std::vector<float> offsets_, rotations_, positions_;
};

/// The test person with legs: 60 joints.
std::shared_ptr<const Skeleton> body() {
  const auto person = whole_person();
  std::vector<Joint> joints(person->joints().begin(), person->joints().end());
  for (const char* side : {"Left", "Right"}) {
    JointIndex joint = *person->find(fmt::format("{}UpLeg", side));
    for (int i = 0; joints.size() < 60 && i < 7; ++i) {
      joints.push_back({fmt::format("{}Leg{}", side, i), joint, {0, -0.1f, 0.01f}, false});
      joint = static_cast<JointIndex>(joints.size()) - 1;
    }
  }
  return std::make_shared<const Skeleton>(joints, std::vector<Tip>(person->tips().begin(), person->tips().end()));
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
  const int rounds = quick ? 11 : 41;
  const std::int64_t frames = quick ? 2'400 : 12'000;
  const Motion motion = moving(body(), frames, 1, {120, 1});
  const auto joints = static_cast<double>(motion.skeleton().joint_count());
  const double nanoseconds = 1e9 / (static_cast<double>(frames) * joints);

  NaiveLoop naive(motion.skeleton());
  const auto naively = [&] {
    for (std::int64_t frame = 0; frame < frames; ++frame) {
      const PoseView pose = motion.pose(frame);
      naive.pose(pose.rotations.front().coeffs().data(), pose.translations.front().data());
      bench::keep(naive.positions());
    }
  };
  ModelPose model;
  const auto ours = [&] {
    for (std::int64_t frame = 0; frame < frames; ++frame) {
      to_model_space(motion.skeleton(), motion.pose(frame), model);
      bench::keep(model);
    }
  };
  naively();
  ours();
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const Eigen::Vector3f theirs(&naive.positions()[3 * i]);
    if ((model.positions[i] - theirs).norm() > 1e-5f) {
      fmt::print(stderr, "bench_kinematics: joint {} differs from the naive loop's\n", i);
      return 1;
    }
  }
  bench::print("kinematics/pose_per_joint", nanoseconds, "ns", bench::compare(rounds, ours, naively), "<= 1.0");

  std::vector<JointIndex> all(motion.skeleton().joint_count());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<JointIndex>(i);
  const JointChains chains(motion.skeleton(), all);
  const auto chained = [&] {
    for (std::int64_t frame = 0; frame < frames; ++frame) {
      chains.to_model_space(motion.pose(frame), model);
      bench::keep(model);
    }
  };
  bench::print("kinematics/chains_per_joint", nanoseconds, "ns", bench::compare(rounds, chained, naively), "<= 1.0");

  const SignerModel signer = [&] {
    SignerModel it{.rig = rig_of_signer(motion.skeleton()), .body = {}};
    it.body = signer_body(motion, it.rig);
    return it;
  }();
  const bench::Compared hands = bench::compare(
      rounds,
      [&] {
        bench::keep(measure_hands(motion, signer, {0, frames}));
      },
      naively);
  bench::print("hands/times_real_time", motion.duration().count() / hands.ours, "x",
               motion.duration().count() / hands.yardstick, hands.ratio, "-");
  return 0;
}
