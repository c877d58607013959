#include "signweave/nonmanual/expressions.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave {
namespace {

/// A weight of a built-in expression; "@" stands for both sides.
struct Weight {
  std::string_view track;
  float weight;
};

NamedExpression expression(std::string_view name, std::initializer_list<Weight> weights, HeadMovement head = {}) {
  NamedExpression result;
  result.curve.name = name;
  for (const Weight& one : weights) {
    if (one.track.ends_with('@')) {
      const std::string track(one.track.substr(0, one.track.size() - 1));
      result.curve.weights.push_back({track + "Left", one.weight});
      result.curve.weights.push_back({track + "Right", one.weight});
    } else {
      result.curve.weights.push_back({std::string(one.track), one.weight});
    }
  }
  result.curve.head = head;
  return result;
}

HeadMovement turned(HeadAngles turn) {
  return {.turn = turn, .swing = {}};
}
HeadMovement swinging(HeadAngles swing, float hertz) {
  return {.turn = {}, .swing = swing, .hertz = hertz};
}

/// Not as long as the signs that it accompanies: one blink at their end.
NamedExpression blink(std::string_view name) {
  NamedExpression result = expression(name, {{"eyeBlink@", 1}});
  result.curve.onset = Milliseconds(80);
  result.curve.offset = Milliseconds(150);
  result.begin = -result.curve.onset;
  result.end = result.curve.offset;
  result.at_end = true;
  return result;
}

constexpr std::initializer_list<Weight> kBrowsUp = {{"browInnerUp", 0.8f}, {"browOuterUp@", 0.8f}, {"eyeWide@", 0.3f}};
constexpr std::initializer_list<Weight> kBrowsDown = {{"browDown@", 0.8f}, {"eyeSquint@", 0.2f}, {"noseSneer@", 0.2f}};

void add_named(Expressions& all) {
  all.push_back(expression("brows up", kBrowsUp));
  all.push_back(expression("brows down", kBrowsDown));
  all.push_back(expression("q-polar", kBrowsUp, turned({.pitch = -6})));
  all.push_back(expression("q-wh", kBrowsDown, turned({.roll = 5})));
  all.push_back(expression("neg", {}, swinging({.yaw = 8}, 2.5f)));
  all.push_back(expression("topic", kBrowsUp, turned({.pitch = 4})));
  all.push_back(expression("puff", {{"cheekPuff", 0.8f}, {"mouthPucker", 0.3f}}));
  all.push_back(expression("squint", {{"eyeSquint@", 0.8f}}));
  all.push_back(expression("smile", {{"mouthSmile@", 0.7f}, {"cheekSquint@", 0.3f}}));
  all.push_back(blink("blink"));
  all.push_back(expression("nod", {}, swinging({.pitch = -6}, 2)));
}

// The codes of SiGML whose meaning a weight or an angle can show. Its tiers use the same letters for different things,
// so each name begins with the tier.
void add_sigml(Expressions& all) {
  all.push_back(expression("brows RB", kBrowsUp));
  all.push_back(expression("brows RR", {{"browInnerUp", 0.4f}, {"browOuterUpRight", 0.8f}, {"eyeWideRight", 0.3f}}));
  all.push_back(expression("brows RL", {{"browInnerUp", 0.4f}, {"browOuterUpLeft", 0.8f}, {"eyeWideLeft", 0.3f}}));
  all.push_back(expression("brows FU", kBrowsDown));
  all.push_back(expression("lids WB", {{"eyeWide@", 0.8f}}));
  all.push_back(expression("lids WR", {{"eyeWideRight", 0.8f}}));
  all.push_back(expression("lids WL", {{"eyeWideLeft", 0.8f}}));
  all.push_back(expression("lids SB", {{"eyeBlink@", 0.4f}, {"eyeSquint@", 0.4f}}));
  all.push_back(expression("lids SR", {{"eyeBlinkRight", 0.4f}, {"eyeSquintRight", 0.4f}}));
  all.push_back(expression("lids SL", {{"eyeBlinkLeft", 0.4f}, {"eyeSquintLeft", 0.4f}}));
  all.push_back(expression("lids CB", {{"eyeBlink@", 1}}));
  all.push_back(expression("lids CR", {{"eyeBlinkRight", 1}}));
  all.push_back(expression("lids CL", {{"eyeBlinkLeft", 1}}));
  all.push_back(expression("lids TB", {{"eyeBlink@", 1}, {"eyeSquint@", 0.8f}}));
  all.push_back(expression("lids TR", {{"eyeBlinkRight", 1}, {"eyeSquintRight", 0.8f}}));
  all.push_back(expression("lids TL", {{"eyeBlinkLeft", 1}, {"eyeSquintLeft", 0.8f}}));
  all.push_back(blink("lids BB"));
  all.push_back(expression("head NO", {}, swinging({.pitch = -6}, 2)));
  all.push_back(expression("head SH", {}, swinging({.yaw = 8}, 2.5f)));
  all.push_back(expression("head SR", {}, turned({.yaw = -20})));
  all.push_back(expression("head SL", {}, turned({.yaw = 20})));
  all.push_back(expression("head TR", {}, turned({.roll = -10})));
  all.push_back(expression("head TL", {}, turned({.roll = 10})));
  all.push_back(expression("head NF", {}, turned({.pitch = -10})));
  all.push_back(expression("head NB", {}, turned({.pitch = 10})));
  all.push_back(expression("nose WB", {{"noseSneer@", 0.7f}}));
  all.push_back(expression("mouth J03", {{"jawForward", 0.7f}, {"jawOpen", 0.2f}, {"mouthLowerDown@", 0.5f}}));
  all.push_back(expression("mouth L04", {{"mouthPucker", 0.5f}, {"mouthPress@", 0.4f}}));
  all.push_back(expression("mouth L05", {{"jawOpen", 0.4f}, {"mouthFunnel", 0.5f}, {"mouthPucker", 0.2f}}));
  all.push_back(expression("mouth L06", {{"jawOpen", 0.12f}, {"mouthPucker", 0.6f}, {"mouthFunnel", 0.3f}}));
}

}  // namespace

const Expressions& built_in_expressions() {
  static const Expressions all = [] {
    Expressions list;
    add_named(list);
    add_sigml(list);
    return list;
  }();
  return all;
}

const NamedExpression& find_expression(const Expressions& all, std::string_view name) {
  const std::string wanted = match_form(name);
  std::vector<std::string> known;
  for (const NamedExpression& one : all) {
    if (one.curve.name == wanted) return one;
    known.push_back(one.curve.name);
  }
  const std::string hint = did_you_mean(wanted, known);
  throw Error(ErrorCode::not_found, fmt::format("there is no expression '{}'{}", printable(name),
                                                hint.empty() ? "; docs/non-manuals.md lists them" : hint));
}

TimedCurve over(const NamedExpression& expression, TimeSpan strokes, Milliseconds begin, Milliseconds end) {
  TimeSpan at{(expression.at_end ? strokes.end : strokes.begin) + expression.begin + begin,
              strokes.end + expression.end + end};
  at.end = std::max(at.end, at.begin + std::max(expression.curve.onset + expression.curve.offset, Milliseconds(1)));
  return {.curve = expression.curve, .at = at};
}

}  // namespace signweave
