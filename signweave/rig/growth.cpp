#include "signweave/rig/growth.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "signweave/core/text.h"
#include "signweave/rig/body_shape.h"

namespace signweave {
namespace {

using enum Part;

/// Drops each part that does not grow from the previous one.
void drop_unconnected(const Skeleton& skeleton, std::initializer_list<Part> line, RigMap& map) {
  JointIndex above = kNoJoint;
  for (const Part part : line) {
    if (!map.has(part)) continue;
    const JointIndex joint = map[part].joint;
    if (map[part].evidence == Evidence::name && above != kNoJoint && !grows_from(skeleton, joint, above)) {
      map[part] = {};
      continue;
    }
    above = joint;
  }
}

/// Drops all names of a limb if their order is impossible, because it is unknown which of them is wrong.
void drop_unordered_limb(const Skeleton& skeleton, std::initializer_list<Part> line, RigMap& map) {
  const bool named =
      std::none_of(line.begin(), line.end(), [&](Part part) { return map[part].evidence == Evidence::file; });
  JointIndex above = kNoJoint;
  bool grown = true;
  for (const Part part : line) {
    if (!map.has(part)) continue;
    if (above != kNoJoint && !grows_from(skeleton, map[part].joint, above)) grown = false;
    above = map[part].joint;
  }
  if (grown) return;
  if (!named) return drop_unconnected(skeleton, line, map);
  for (const Part part : line) map[part] = {};
}

}  // namespace

void drop_impossible_parts(const Skeleton& skeleton, RigMap& map) {
  drop_unconnected(skeleton, {neck, head, head_top}, map);
  drop_unconnected(skeleton, {head, jaw}, map);
  for (const Side side : kSides) {
    drop_unconnected(skeleton, {head, of(side, left_eye)}, map);
    drop_unordered_limb(
        skeleton, {of(side, left_clavicle), of(side, left_upper_arm), of(side, left_forearm), of(side, left_hand)},
        map);
    drop_unordered_limb(skeleton, {of(side, left_thigh), of(side, left_shin), of(side, left_foot), of(side, left_toes)},
                        map);
    for (const Finger finger : kFingers) {
      const auto point = [&](FingerPoint at) { return finger_part(side, finger, at); };
      drop_unordered_limb(skeleton,
                          {point(FingerPoint::proximal), point(FingerPoint::intermediate), point(FingerPoint::distal),
                           point(FingerPoint::tip)},
                          map);
      // Some rigs let two fingers grow from one joint of the palm, so the metacarpal is not checked as part of the
      // chain.
      for (std::size_t i = 0; i < kFingerPoints; ++i) {
        drop_unconnected(skeleton, {of(side, left_hand), point(static_cast<FingerPoint>(i))}, map);
      }
    }
  }
}

void require_possible_parts(const Skeleton& skeleton, const RigMap& map) {
  const auto line = [&](std::initializer_list<Part> parts) {
    const PartPlace* above = nullptr;
    Part inner = pelvis;
    for (const Part part : parts) {
      const PartPlace& place = map[part];
      if (place.evidence != Evidence::file) continue;
      if (above != nullptr && !grows_from(skeleton, place.joint, above->joint)) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("{} = {} is not beyond {} = {}; parts are named from the trunk outwards", name_of(part),
                                printable(skeleton.joint(place.joint).name), name_of(inner),
                                printable(skeleton.joint(above->joint).name)));
      }
      above = &place;
      inner = part;
    }
  };
  line({pelvis, neck, head});
  for (const Side side : kSides) {
    line({of(side, left_clavicle), of(side, left_upper_arm), of(side, left_forearm), of(side, left_hand)});
    line({of(side, left_thigh), of(side, left_shin), of(side, left_foot), of(side, left_toes)});
    for (const Finger finger : kFingers) {
      line({of(side, left_hand), finger_part(side, finger, FingerPoint::proximal),
            finger_part(side, finger, FingerPoint::intermediate), finger_part(side, finger, FingerPoint::distal),
            finger_part(side, finger, FingerPoint::tip)});
    }
  }
}

}  // namespace signweave
