#include "signweave/features/from_source.h"

#include <gtest/gtest.h>

#include <array>

#include "signweave/features/hand_trace.h"
#include "signweave/features/phase_features.h"
#include "signweave/rig/test_rig.h"

namespace signweave {
namespace {

TEST(FromSource, PiecesOfAMotionGiveTheSameResultsAsTheWhole) {
  for (const auto& [frames, hertz] :
       {std::pair<std::int64_t, std::int64_t>{1'300, 100}, {kPiece, 60}, {kPiece + 1, 60}, {7, 100}, {1, 60}}) {
    SCOPED_TRACE(frames);
    Motion motion = moving(whole_person(), frames, 8, {hertz, 1});
    keep_hemisphere(motion);
    const SignerModel whole = model_of(motion);
    const MemorySource source(motion);
    const SignerModel model = model_of(source);
    for (std::size_t part = 0; part < kPartCount; ++part) {
      EXPECT_EQ(model.rig[static_cast<Part>(part)].joint, whole.rig[static_cast<Part>(part)].joint) << part;
    }
    ASSERT_TRUE(model.body && whole.body);
    EXPECT_EQ(model.body->shoulder_width, whole.body->shoulder_width);
    EXPECT_EQ(model.body->heights, whole.body->heights);
    EXPECT_EQ(model.body->trunk_from_signer.coeffs(), whole.body->trunk_from_signer.coeffs());
    int pauses = 0;
    const HandTrace trace = trace_hands(source, model, [&] { ++pauses; });
    EXPECT_EQ(trace.points, trace_hands(motion, whole).points);
    EXPECT_GE(pauses, frames / kPiece);
    constexpr std::array kParts = {Part::right_forearm, Part::head};
    const FrameRange range{frames / 3, frames};
    const std::vector<PointTrack> tracks = track_points(source, model, kParts, range);
    const std::vector<PointTrack> expected = track_points(motion, whole, kParts, range);
    for (std::size_t part = 0; part < kParts.size(); ++part) {
      ASSERT_EQ(tracks[part].size(), expected[part].size());
      for (std::size_t i = 0; i < tracks[part].size(); ++i) {
        ASSERT_EQ(tracks[part][i].position, expected[part][i].position) << i;
        ASSERT_EQ(tracks[part][i].velocity, expected[part][i].velocity) << i;
        ASSERT_EQ(tracks[part][i].acceleration, expected[part][i].acceleration) << i;
      }
    }
  }
}

TEST(FromSource, APauseMayCancelTheOperation) {
  const MemorySource source(moving(whole_person(), 3 * kPiece, 8));
  const SignerModel model = model_of(source);
  int pauses = 0;
  const Pause pause = [&] {
    if (++pauses == 2) throw Error(ErrorCode::cancelled, "stopped");
  };
  EXPECT_THROW(trace_hands(source, model, pause), Error);
  EXPECT_EQ(pauses, 2);
}

TEST(FromSource, DecodingPausesToo) {
  RecordingFeatures features;
  features.phases.resize(1'000);
  ByteWriter out;
  encode(features, out);
  int pauses = 0;
  const Pause count = [&] { ++pauses; };
  ByteReader in(out.bytes(), "features");
  EXPECT_EQ(decode_features(in, count)->phases.size(), 1'000U);
  EXPECT_GE(pauses, 4);

  const MemorySource source(moving(whole_person(), 20, 8));
  ByteWriter trace;
  encode(trace_hands(source, model_of(source)), trace);
  pauses = 0;
  ByteReader bytes(trace.bytes(), "trace");
  EXPECT_TRUE(decode_trace(bytes, count));
  EXPECT_EQ(pauses, 4);
}

}  // namespace
}  // namespace signweave
