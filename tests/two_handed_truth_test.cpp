// How both hands of the synthetic signer take part in its signs, measured from its motion, against its table of signs.

#include <gtest/gtest.h>

#include <map>

#include "demo/corpus.h"
#include "demo/signs.h"
#include "signweave/features/hand_trace.h"
#include "signweave/features/phase_features.h"
#include "signweave/features/two_handed.h"

namespace signweave {
namespace {

Hands planned(const demo::SignShape& sign) {
  switch (sign.hands) {
    case demo::Hands::one:
    case demo::Hands::left:
      return Hands::one;
    case demo::Hands::mirrored:
      return Hands::symmetric;
    case demo::Hands::alternating:
      return Hands::alternating;
    case demo::Hands::on_base:
      break;
  }
  return Hands::asymmetric;
}

TEST(HandsOfTheSyntheticSigner, TakePartAsPlanned) {
  std::map<Hands, int> signs;
  for (const demo::Script& script : demo::corpus_scripts(2)) {
    const demo::SyntheticRecording made = demo::make_recording(script, {100, 1}, 1);
    const HandTrace trace = trace_hands(made.motion, model_of(made.motion));
    PointTrack left, right;
    for (const demo::PlacedSign& placed : made.timeline.signs) {
      const FrameRange stroke{placed.stroke_begin, placed.stroke_end};
      trace.track(TracePoint::left_palm, stroke, left);
      trace.track(TracePoint::right_palm, stroke, right);
      TwoHandedSum sum;
      sum.add(left, right);
      const Hands expected = planned(*placed.shape);
      EXPECT_EQ(class_of(sum.movement(), trace.body), expected) << placed.shape->gloss;
      ++signs[expected];
    }
  }
  EXPECT_EQ(signs, (std::map<Hands, int>{
                       {Hands::one, 29}, {Hands::symmetric, 24}, {Hands::alternating, 4}, {Hands::asymmetric, 7}}));
}

}  // namespace
}  // namespace signweave
