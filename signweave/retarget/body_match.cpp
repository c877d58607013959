#include "signweave/retarget/body_match.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace signweave {
namespace {

constexpr std::array kArmParts = {Part::left_upper_arm, Part::left_forearm, Part::left_hand};
constexpr std::array kBends = {FingerPoint::proximal, FingerPoint::intermediate, FingerPoint::distal};

std::string_view side_name(Side side) {
  return side == Side::left ? "left" : "right";
}

std::string list_of(const std::vector<Part>& parts) {
  std::string text;
  for (const Part part : parts) text += (text.empty() ? "" : ", ") + std::string(name_of(part));
  return text;
}

class Matcher {
 public:
  Matcher(const RecordedBody& source, const RecordedBody& target)
      : source_(source), target_(target), from_(source.signer.rig), to_(target.signer.rig) {}

  BodyMatch match() {
    for (const RecordedBody* body : {&source_, &target_}) trunk(*body);
    for (const Side side : kSides) {
      if (!arm(side)) continue;
      fingers(side);
    }
    others();
    for (const RecordedBody* body : {&source_, &target_}) guessed(*body);
    return std::move(match_);
  }

 private:
  void forbid(const std::string& recording, const std::string& what) {
    match_.unsafe.push_back(fmt::format("'{}' has no {}", recording, what));
  }

  void trunk(const RecordedBody& body) {
    const RigMap& rig = body.signer.rig;
    if (!rig.has(Part::pelvis) && !rig.has(Part::spine) && !rig.has(Part::chest)) forbid(body.recording, "trunk");
    std::vector<Part> missing;
    for (const Part part : {Part::left_upper_arm, Part::right_upper_arm}) {
      if (!rig.has(part)) missing.push_back(part);
    }
    if (!missing.empty()) {
      forbid(body.recording, list_of(missing));
    } else if (!body.signer.body) {
      match_.unsafe.push_back(fmt::format("the shoulders of '{}' coincide", body.recording));
    }
  }

  static std::vector<Part> missing_of_arm(const RigMap& rig, Side side) {
    std::vector<Part> missing;
    for (const Part part : {Part::left_forearm, Part::left_hand}) {
      if (!rig.has(of(side, part))) missing.push_back(of(side, part));
    }
    return missing;
  }

  /// Returns true if both bodies have the arm.
  bool arm(Side side) {
    const std::vector<Part> from = missing_of_arm(from_, side);
    const std::vector<Part> to = missing_of_arm(to_, side);
    if (!from.empty() && !to.empty()) {
      match_.approximate.push_back(fmt::format("neither has a {} arm", side_name(side)));
      return false;
    }
    if (!from.empty()) forbid(source_.recording, list_of(from));
    if (!to.empty()) forbid(target_.recording, list_of(to));
    return from.empty() && to.empty();
  }

  void fingers(Side side) {
    const auto has = [&](const RigMap& rig, Finger finger) {
      return rig.has(finger_part(side, finger, FingerPoint::proximal));
    };
    const auto count = [&](const RigMap& rig) {
      return std::ranges::count_if(kFingers, [&](Finger finger) { return has(rig, finger); });
    };
    if (count(to_) == 0) {
      if (count(from_) > 0) {
        match_.approximate.push_back(
            fmt::format("'{}' has no fingers on the {} hand: handshapes are lost", target_.recording, side_name(side)));
      }
      return;
    }
    if (count(from_) == 0) {
      match_.approximate.push_back(
          fmt::format("its {} hand has no fingers: the target's fingers stay still", side_name(side)));
      return;
    }
    std::vector<Part> missing;
    std::vector<Part> lost;
    std::vector<Part> bends;
    for (const Finger finger : kFingers) {
      const Part knuckle = finger_part(side, finger, FingerPoint::proximal);
      if (!has(from_, finger) && has(to_, finger)) missing.push_back(knuckle);
      if (has(from_, finger) && !has(to_, finger)) lost.push_back(knuckle);
      for (const FingerPoint point : kBends) {
        const Part part = finger_part(side, finger, point);
        if (has(from_, finger) && to_.has(part) && !from_.has(part)) bends.push_back(part);
      }
    }
    if (!missing.empty()) forbid(source_.recording, list_of(missing));
    if (!lost.empty()) {
      match_.approximate.push_back(
          fmt::format("'{}' has no {}: their movement is lost", target_.recording, list_of(lost)));
    }
    if (!bends.empty()) match_.approximate.push_back(fmt::format("it has no {}: they stay still", list_of(bends)));
  }

  /// Parts that are less important for signs: the head, legs, and joints of the face.
  void others() {
    std::vector<Part> still;
    std::vector<Part> lost;
    for (const Part part : {Part::head, Part::jaw, Part::left_eye, Part::right_eye, Part::left_clavicle,
                            Part::right_clavicle, Part::left_foot, Part::right_foot}) {
      if (to_.has(part) && !from_.has(part)) still.push_back(part);
      if (from_.has(part) && !to_.has(part)) lost.push_back(part);
    }
    if (!still.empty())
      match_.approximate.push_back(fmt::format("it has no {}: they do not move on their own", list_of(still)));
    if (!lost.empty()) {
      match_.approximate.push_back(
          fmt::format("'{}' has no {}: their movement is lost", target_.recording, list_of(lost)));
    }
  }

  void guessed(const RecordedBody& body) {
    const RigMap& rig = body.signer.rig;
    std::vector<Part> parts;
    const auto look = [&](Part part) {
      if (rig.has(part) && rig[part].confidence < kSurePart) parts.push_back(part);
    };
    for (const Side side : kSides) {
      for (const Part part : kArmParts) look(of(side, part));
      for (const Finger finger : kFingers) look(finger_part(side, finger, FingerPoint::proximal));
    }
    if (!parts.empty()) {
      match_.unsafe.push_back(fmt::format("the joints of '{}' for {} are guesses", body.recording, list_of(parts)));
    }
  }

  const RecordedBody& source_;
  const RecordedBody& target_;
  const RigMap& from_;
  const RigMap& to_;
  BodyMatch match_;
};

}  // namespace

BodyMatch match_bodies(const RecordedBody& source, const RecordedBody& target) {
  return Matcher(source, target).match();
}

}  // namespace signweave
