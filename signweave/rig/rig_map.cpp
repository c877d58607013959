#include "signweave/rig/rig_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

#include "signweave/core/text.h"
#include "signweave/rig/body_shape.h"
#include "signweave/rig/growth.h"
#include "signweave/rig/name_match.h"
#include "signweave/rig/rig_notices.h"
#include "signweave/rig/sides.h"
#include "signweave/rig/structure.h"

namespace signweave {
namespace {

using Eigen::Vector3f;
using enum Part;

constexpr float kByBoth = 1.0f;        // name and shape agree
constexpr float kByName = 0.9f;        // the shape is inconclusive
constexpr float kAgainstShape = 0.7f;  // the shape indicates another joint
constexpr float kByShape = 0.6f;
constexpr float kFingerByShape = 0.5f;
constexpr float kSideGuessed = 0.5f;  // factor for the rest

bool is_sided(Part part) {
  return part >= left_eye;
}

Side side_of(Part part) {
  const auto number = static_cast<std::size_t>(part);
  if (number >= kNamedParts) return number < kNamedParts + kFingers.size() * kFingerPoints ? Side::left : Side::right;
  return (number - static_cast<std::size_t>(left_eye)) % 2 == 0 ? Side::left : Side::right;
}

/// Builds a map from names, shape and a mapping file.
class Mapper {
 public:
  Mapper(const Motion& motion, const RigNames& file)
      : skeleton_(motion.skeleton()),
        shape_(shape_of(motion)),
        names_(match_names(skeleton_)),
        body_(structure_of(skeleton_, shape_)),
        file_(file) {}

  RigMap map() {
    map_.convention = names_.convention;
    for (std::size_t i = 0; i < kPartCount; ++i) {
      if (names_.joints[i] == kNoJoint) continue;
      map_.places[i] = {
          .joint = names_.joints[i], .offset = Vector3f::Zero(), .evidence = Evidence::name, .confidence = kByName};
    }
    take_file();
    drop_impossible_parts(skeleton_, map_);
    take_limbs();
    take_trunk();
    take_fingers();
    take_ends();
    for (const Part part : names_.ambiguous) {
      if (map_[part].evidence == Evidence::name) map_[part].confidence = std::min(map_[part].confidence, kAgainstShape);
    }
    follow_the_body();
    for (const auto& [part, joint] : file_) {
      if (joint.empty()) map_[part] = {};
    }
    add_notices();
    return std::move(map_);
  }

 private:
  void take_file() {
    std::map<Part, JointIndex> placed_joints;
    for (const auto& [part, name] : file_) {
      if (name.empty()) {
        map_[part] = {};
        continue;
      }
      const std::optional<JointIndex> joint = skeleton_.find(name);
      if (!joint) {
        std::vector<std::string> known;
        for (const Joint& one : skeleton_.joints()) known.push_back(one.name);
        throw Error(ErrorCode::not_found, fmt::format("{} = {}: the skeleton has no such joint{}", name_of(part),
                                                      printable(name), did_you_mean(name, known)));
      }
      for (const auto& [other, place] : placed_joints) {
        if (place != *joint) continue;
        throw Error(ErrorCode::bad_input, fmt::format("{} and {} = {}: a joint plays one part; keep one of the lines",
                                                      name_of(other), name_of(part), printable(name)));
      }
      placed_joints.emplace(part, *joint);
      // A joint plays one part by name; the user's entry takes precedence.
      for (PartPlace& place : map_.places) {
        if (place.joint == *joint && place.evidence == Evidence::name) place = {};
      }
      map_[part] = {.joint = *joint, .offset = Vector3f::Zero(), .evidence = Evidence::file, .confidence = 1};
    }
    require_possible_parts(skeleton_, map_);
  }

  /// Sets a part that the shape indicates. A name, if there is one, takes precedence.
  void take(Part part, JointIndex joint, float confidence) {
    if (joint == kNoJoint) return;
    PartPlace& place = map_[part];
    if (place.evidence == Evidence::name) {
      place.confidence = place.joint == joint ? kByBoth : std::min(place.confidence, kAgainstShape);
    }
    if (place.evidence != Evidence::none || blocked(part)) return;
    const bool taken = std::any_of(map_.places.begin(), map_.places.end(), [&](const PartPlace& other) {
      return other.joint == joint && other.offset.isZero();
    });
    if (taken && part != spine && part != chest) return;
    place = {.joint = joint, .offset = Vector3f::Zero(), .evidence = Evidence::structure, .confidence = confidence};
  }
  bool blocked(Part part) const {
    const auto said = file_.find(part);
    return said != file_.end() && said->second.empty();
  }

  /// How clearly names mark a limb as the left one: above 0 left, below 0 right.
  int named_left(const Limb& limb) const {
    int sum = 0;
    for (std::size_t i = 0; i < kPartCount; ++i) {
      const auto part = static_cast<Part>(i);
      const PartPlace& place = map_.places[i];
      if (!is_sided(part) || !place.known() || !grows_from(skeleton_, place.joint, limb.root)) continue;
      sum += side_of(part) == Side::left ? 1 : -1;
    }
    return sum;
  }

  void take_limbs() {
    bool sides_named = false;
    for (std::vector<Limb>* limbs : {&body_.arms, &body_.legs}) {
      if (limbs->empty()) continue;
      const int first = named_left((*limbs)[0]);
      const int second = named_left((*limbs)[1]);
      if (first == second) continue;
      sides_named = true;
      if (first < second) std::swap((*limbs)[0], (*limbs)[1]);
    }
    if (!sides_named) {
      guess_sides();
    } else {
      match_sides();
    }
    distinguish_shoulders();
    const float sure = sides_guessed_ ? kSideGuessed : 1.0f;
    for (const Side side : kSides) {
      const auto i = static_cast<std::size_t>(side);
      if (!body_.arms.empty()) {
        const Limb& arm = body_.arms[i];
        take(of(side, left_upper_arm), arm.upper, sure * kByShape);
        take(of(side, left_forearm), arm.lower, sure * kByShape);
        take(of(side, left_hand), arm.end, sure * kByShape);
        take(of(side, left_clavicle), arm.collar, sure * kByShape);
      }
      if (!body_.legs.empty()) {
        const Limb& leg = body_.legs[i];
        take(of(side, left_thigh), leg.upper, sure * kByShape);
        take(of(side, left_shin), leg.lower, sure * kByShape);
        take(of(side, left_foot), leg.end, sure * kByShape);
        take(of(side, left_toes), leg.toes, sure * kByShape);
      }
    }
  }

  /// "Shoulder" is the collar bone in some rigs and the arm's first joint in others: the next bone decides.
  void distinguish_shoulders() {
    for (const Side side : kSides) {
      PartPlace& collar = map_[of(side, left_clavicle)];
      PartPlace& upper = map_[of(side, left_upper_arm)];
      const PartPlace& elbow = map_[of(side, left_forearm)];
      if (collar.evidence != Evidence::name || upper.known() || blocked(of(side, left_upper_arm))) continue;
      const bool by_shape = !body_.arms.empty() && body_.arms[static_cast<std::size_t>(side)].upper == collar.joint;
      if (by_shape || (elbow.known() && skeleton_.joint(elbow.joint).parent == collar.joint)) {
        upper = std::exchange(collar, {});
      }
    }
  }

  /// If names identified one pair, the other pair's left is on the same side of the body.
  void match_sides() {
    if (body_.arms.empty() || body_.legs.empty()) return;
    const bool arms_named = named_left(body_.arms[0]) != named_left(body_.arms[1]);
    const bool legs_named = named_left(body_.legs[0]) != named_left(body_.legs[1]);
    if (arms_named && legs_named) return;
    if (across(body_.arms).dot(across(body_.legs)) >= 0) return;
    std::vector<Limb>& other = arms_named ? body_.legs : body_.arms;
    std::swap(other[0], other[1]);
  }
  Vector3f across(const std::vector<Limb>& limbs) const {
    Vector3f sum = Vector3f::Zero();
    for (const ModelPose& pose : shape_.poses) {
      sum += pose.positions[static_cast<std::size_t>(limbs[0].upper)] -
             pose.positions[static_cast<std::size_t>(limbs[1].upper)];
    }
    return sum;
  }

  /// Without names the body decides: first as if the first arm were the left one.
  void guess_sides() {
    if (body_.arms.empty()) return;
    if (!body_.legs.empty() && across(body_.arms).dot(across(body_.legs)) < 0) std::swap(body_.legs[0], body_.legs[1]);
    RigMap trial;
    const auto put = [&](Part part, JointIndex joint) { trial[part].joint = joint; };
    put(pelvis, body_.pelvis);
    put(head, body_.head);
    for (const Side side : kSides) {
      const auto i = static_cast<std::size_t>(side);
      put(of(side, left_upper_arm), body_.arms[i].upper);
      put(of(side, left_forearm), body_.arms[i].lower);
      put(of(side, left_hand), body_.arms[i].end);
      if (!body_.legs.empty()) {
        put(of(side, left_thigh), body_.legs[i].upper);
        put(of(side, left_shin), body_.legs[i].lower);
        put(of(side, left_foot), body_.legs[i].end);
        put(of(side, left_toes), body_.legs[i].toes);
      }
      for (const auto& [finger, points] : fingers_of(skeleton_, shape_, body_.arms[i].end)) {
        for (std::size_t point = 0; point < kFingerPoints; ++point) {
          put(finger_part(side, finger, static_cast<FingerPoint>(point)), points[point]);
        }
      }
    }
    float score = sides_score(side_cues(shape_, trial));
    if (std::abs(score) < 0.2f) {  // assume that it faces along z, as most bodies do
      sides_guessed_ = true;
      score = across(body_.arms).x();
    }
    if (score >= 0) return;
    std::swap(body_.arms[0], body_.arms[1]);
    if (!body_.legs.empty()) std::swap(body_.legs[0], body_.legs[1]);
  }

  /// The lowest common ancestor.
  JointIndex fork(JointIndex a, JointIndex b) const {
    while (a != b) (a > b ? a : b) = skeleton_.joint(a > b ? a : b).parent;
    return a;
  }
  JointIndex arm_root(Side side) const {
    for (const Part part : {left_clavicle, left_upper_arm, left_forearm, left_hand}) {
      if (map_.has(of(side, part))) return map_[of(side, part)].joint;
    }
    return kNoJoint;
  }

  /// Chest and spine are identified by what grows from them, whatever their names.
  void take_trunk() {
    take(pelvis, body_.pelvis, kByShape);
    take(head, body_.head, kByShape);
    take(neck, body_.neck, kByShape);
    std::vector<JointIndex> roots;
    for (const JointIndex joint :
         {arm_root(Side::left), arm_root(Side::right), map_.has(neck) ? map_[neck].joint : kNoJoint}) {
      if (joint != kNoJoint) roots.push_back(joint);
    }
    if (roots.size() >= 2) place_trunk(chest, fork(skeleton_.joint(roots[0]).parent, skeleton_.joint(roots[1]).parent));
    if (!map_.has(pelvis)) return;
    const JointIndex low = map_[pelvis].joint;
    JointIndex top = kNoJoint;
    for (const Part part : {chest, neck, head}) {
      if (map_.has(part) && top == kNoJoint) top = map_[part].joint;
    }
    if (top == kNoJoint || top == low || !grows_from(skeleton_, top, low)) return;
    JointIndex first = top;
    while (skeleton_.joint(first).parent != low) first = skeleton_.joint(first).parent;
    if (map_.has(chest) || (first != top)) place_trunk(spine, first);
  }
  void place_trunk(Part part, JointIndex joint) {
    PartPlace& place = map_[part];
    if (place.evidence == Evidence::file || blocked(part) || joint == kNoJoint) return;
    if (map_.has(pelvis) && part == chest && joint == map_[pelvis].joint && skeleton_.joint_count() > 1) return;
    const bool named = names_.joints[static_cast<std::size_t>(spine)] == joint ||
                       names_.joints[static_cast<std::size_t>(chest)] == joint;
    place = {.joint = joint,
             .offset = Vector3f::Zero(),
             .evidence = named ? Evidence::name : Evidence::structure,
             .confidence = named ? kByBoth : kByShape};
  }

  void take_fingers() {
    for (const Side side : kSides) {
      const Part hand = of(side, left_hand);
      if (!map_.has(hand)) continue;
      const auto chains = fingers_of(skeleton_, shape_, map_[hand].joint);
      for (const auto& [finger, points] : chains) {
        const auto part_at = [&, f = finger](std::size_t i) {
          return finger_part(side, f, static_cast<FingerPoint>(i));
        };
        for (std::size_t i = 0; i < kFingerPoints; ++i) {
          const float sure = chains.size() == 5 ? kFingerByShape : 0.8f * kFingerByShape;
          take(part_at(i), points[i], std::min(sure, map_[hand].confidence));
        }
      }
    }
  }

  /// Ends that are not joints: points that move with the last joint.
  void take_ends() {
    for (const Side side : kSides) {
      for (const Finger finger : kFingers) {
        const Part tip = finger_part(side, finger, FingerPoint::tip);
        Part last = tip;
        for (const FingerPoint point : {FingerPoint::proximal, FingerPoint::intermediate, FingerPoint::distal}) {
          if (map_.has(finger_part(side, finger, point))) last = finger_part(side, finger, point);
        }
        if (last != tip) take_end(tip, last);
      }
    }
    if (map_.has(head)) take_end(head_top, head);
  }
  void take_end(Part end, Part last) {
    if (map_.has(end) || blocked(end)) return;
    const PartPlace& from = map_[last];
    const auto joint = static_cast<std::size_t>(from.joint);
    const Evidence evidence = from.evidence == Evidence::file ? Evidence::structure : from.evidence;
    if (shape_.has_tip(from.joint)) {
      map_[end] = {from.joint, shape_.tips[joint].offset, evidence, from.confidence};
      return;
    }
    JointIndex only = kNoJoint;
    for (const JointIndex child : shape_.children[joint]) {
      const bool leaf = shape_.below(child).empty() && shape_.bones[static_cast<std::size_t>(child)] > 1e-4f;
      const bool other = std::any_of(map_.places.begin(), map_.places.end(),
                                     [&](const PartPlace& place) { return place.joint == child; });
      if (leaf && !other) only = only == kNoJoint ? child : -2;
    }
    if (only >= 0) map_[end] = {only, Vector3f::Zero(), Evidence::structure, std::min(kByShape, from.confidence)};
  }

  /// If names contradict the body's sides, the body decides.
  void follow_the_body() {
    if (sides_guessed_) return;
    for (const auto& [part, joint] : file_) {
      if (is_sided(part) && !joint.empty()) return;
    }
    const bool named = std::any_of(kSides.begin(), kSides.end(), [&](Side side) {
      return map_[of(side, left_upper_arm)].evidence == Evidence::name ||
             map_[of(side, left_thigh)].evidence == Evidence::name;
    });
    if (!named) return;
    if (sides_score(side_cues(shape_, map_)) > -0.35f) return;
    map_.sides_swapped = true;
    for (std::size_t i = static_cast<std::size_t>(left_eye); i < kNamedParts; i += 2) {
      std::swap(map_.places[i], map_.places[i + 1]);
    }
    constexpr std::size_t kHand = kFingers.size() * kFingerPoints;
    for (std::size_t i = kNamedParts; i < kNamedParts + kHand; ++i) std::swap(map_.places[i], map_.places[i + kHand]);
  }

  void add_notices() {
    const auto say = [&](std::string text) { map_.notices.push_back({.where = {}, .text = std::move(text)}); };
    if (map_.convention.empty()) {
      say("the joint names match no known convention: parts are identified by shape; a mapping file can correct them");
    }
    if (map_.sides_swapped) {
      map_.notices.push_back(
          {.where = {},
           .text = "left and right are swapped: joints named left are on the body's right side, and the map follows "
                   "the body; read the motion mirrored if it is, or correct the names with a mapping file",
           .remedies = {{"mirror", "true"}}});
    }
    if (sides_guessed_)
      say("left and right are guessed, because nothing on the body shows them; a mapping file can set them");
    for (const Part part : names_.ambiguous) {
      const JointIndex joint = names_.joints[static_cast<std::size_t>(part)];
      if (map_[part].joint != joint) continue;
      std::string text = fmt::format("several joints are named {}: the first is taken as {}",
                                     printable(skeleton_.joint(joint).name), name_of(part));
      const bool said = std::any_of(map_.notices.begin(), map_.notices.end(),
                                    [&](const Notice& notice) { return notice.text == text; });
      if (!said) say(std::move(text));
    }
    for (std::string& text : missing_parts(map_)) say(std::move(text));
  }

  const Skeleton& skeleton_;
  BodyShape shape_;
  NameMatch names_;
  Structure body_;
  const RigNames& file_;
  RigMap map_;
  bool sides_guessed_ = false;
};

}  // namespace

RigMap map_rig(const Motion& motion, const RigNames& names) {
  assert(motion.frame_count() > 0);
  return Mapper(motion, names).map();
}

}  // namespace signweave
