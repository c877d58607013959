#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "signweave/annotation/sign.h"
#include "signweave/database/database.h"
#include "signweave/kv/test_folder.h"

namespace signweave::testing_database {

using kv::TestFolder;

/// A motion of two joints whose numbers depend on `seed`, so that motions of different seeds differ.
inline Motion small_motion(std::int64_t frames, int seed) {
  const auto skeleton = std::make_shared<const Skeleton>(
      std::vector<Joint>{{"Hips", kNoJoint, {0, 1, 0}, true}, {"Hand", 0, {0.5f, 0, 0}, false}},
      std::vector<Tip>{{1, {0.1f, 0, 0}}});
  Motion motion(skeleton, {100, 1}, frames);
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const float angle = 0.001f * static_cast<float>(frame) + 0.1f * static_cast<float>(seed);
    motion.pose(frame).rotations[1] = Eigen::AngleAxisf(angle, Eigen::Vector3f::UnitX());
    motion.pose(frame).translations[0].x() = static_cast<float>(seed) + 0.001f * static_cast<float>(frame);
  }
  return motion;
}

/// Signs of 400 ms one after another, each with preparation, stroke and retraction.
inline AnnotationDocument small_document(const std::vector<std::string>& glosses) {
  AnnotationDocument document;
  document.types = {{"gloss", Stereotype::none, {}}, {"phase", Stereotype::time_subdivision, {}}};
  Tier signs{.id = "Gloss", .type = "gloss"};
  Tier phases{.id = "Phase", .type = "phase", .parent = "Gloss"};
  int id = 1;
  const auto next_id = [&] { return fmt::format("a{}", id++); };
  for (std::size_t i = 0; i < glosses.size(); ++i) {
    const Milliseconds at(400 * static_cast<int>(i));
    const std::string sign = next_id();
    signs.annotations.push_back({.id = sign, .label = glosses[i], .span = {at, at + 400ms}});
    phases.annotations.push_back({.id = next_id(), .label = "Preparation", .span = {at, at + 100ms}, .parent = sign});
    phases.annotations.push_back(
        {.id = next_id(), .label = "Stroke", .span = {at + 100ms, at + 300ms}, .parent = sign});
    phases.annotations.push_back(
        {.id = next_id(), .label = "Retraction", .span = {at + 300ms, at + 400ms}, .parent = sign});
  }
  document.tiers = {std::move(signs), std::move(phases)};
  return document;
}

inline Recording small_recording(const std::string& name, int seed, const std::vector<std::string>& glosses,
                                 std::int64_t frames = 300) {
  Recording recording{.name = name, .signer = fmt::format("s{}", seed)};
  recording.motion = MotionPart{.motion = small_motion(frames, seed)};
  AnnotationDocument document = small_document(glosses);
  TierNames tiers = guess_tier_names(document);
  recording.annotation = AnnotationPart{.document = std::move(document), .tiers = std::move(tiers)};
  recording.clock = {.frame_time = Seconds(0.01)};
  return recording;
}

inline bool same_poses(const Motion& a, const Motion& b) {
  if (a.frame_count() != b.frame_count() || !(a.skeleton() == b.skeleton()) || a.rate() != b.rate()) return false;
  for (std::size_t i = 0; i < a.rotations().size(); ++i) {
    if (a.rotations()[i].coeffs() != b.rotations()[i].coeffs()) return false;
  }
  for (std::size_t i = 0; i < a.translations().size(); ++i) {
    if (a.translations()[i] != b.translations()[i]) return false;
  }
  return true;
}

}  // namespace signweave::testing_database
