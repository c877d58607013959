// The correction of one arm's place on another trunk, per frame, against the forward kinematics of the whole body,
// which a renderer needs for each frame at least once if it looks at anything in model space. Applying it is on the
// frame path; finding it happens once per stroke.

#include "bench/measure.h"
#include "signweave/render/place_correction.h"
#include "signweave/render/test_signing_person.h"

int main() {
  using namespace signweave;
  using namespace signweave::testing_person;
  constexpr std::int64_t kFrames = 100;
  const Person person;
  const Motion source = person.stroke(in_front, kFrames);
  const Motion composed = on_other_trunk(source, [&](float t, MutablePoseView pose) {
    pose.rotations[slot(*person.skeleton, "Spine")] = turn(15, Eigen::Vector3f::UnitX());
    pose.rotations[slot(*person.skeleton, "Spine2")] = turn(20 * t, Eigen::Vector3f::UnitY());
  });
  ArmPlacer placer = person.placer();
  const ComposedStroke stroke{
      .name = "X", .source = person.all_of(source), .composed = person.all_of(composed), .from_source = {false, true}};
  const PlaceCorrection correction = *placer.corrections(stroke)[1];
  const std::vector<float> weights(kFrames, 1.0f);
  Motion made = composed;
  ModelPose model;
  const auto kinematics = [&] {
    for (std::int64_t frame = 0; frame < kFrames; ++frame) {
      to_model_space(*person.skeleton, source.pose(frame), model);
      bench::keep(model);
    }
  };
  constexpr double kScale = 1e6 / kFrames;
  bench::print("place_apply", kScale, "us/arm/frame",
               bench::compare(
                   51,
                   [&] {
                     placer.apply(correction, person.all_of(source), weights, made.poses({0, kFrames}));
                     bench::keep(made);
                   },
                   kinematics, 10),
               "<= 4");
  bench::print("place_find", kScale, "us/arm/frame",
               bench::compare(
                   21, [&] { bench::keep(placer.corrections(stroke)); }, kinematics, 2),
               "-");
}
