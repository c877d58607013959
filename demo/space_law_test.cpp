// The law by which signs are aimed at places, without any recording.

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <numbers>
#include <vector>

#include "demo/space.h"
#include "signweave/core/error.h"

namespace signweave::demo {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

constexpr float kDegree = std::numbers::pi_v<float> / 180;

Aimed aimed(std::string_view gloss, std::string_view from, std::string_view to) {
  return {.gloss = gloss, .from = locus_of(from), .to = locus_of(to), .at = {}};
}
std::string at_azimuth(int degrees, const char* rest = "/0/1.2") {
  return std::to_string(degrees) + rest;
}

TEST(Loci, AreReadFromNamesAndAngles) {
  EXPECT_TRUE(point_of(locus_of("front")).isApprox(Vector3f(0, 0, 0.42f), 1e-5f));
  EXPECT_TRUE(point_of(locus_of("90/0/2")).isApprox(Vector3f(0.70f, 0, 0), 1e-5f)) << "positive to the signer's left";
  EXPECT_GT(point_of(locus_of("0/30/1")).y(), 0.17f);
  EXPECT_EQ(angles_text(locus_of("right")), "-45/0/1.2");
  EXPECT_EQ(angles_text(locus_of("addressee")), "0/5/3");
  EXPECT_TRUE(locus_of("self").self);
  for (const char* wrong : {"", "behind", "25/0", "25/0/far", "25/0/1.2/3", "//"}) {
    EXPECT_THROW(locus_of(wrong), Error) << wrong;
  }
}

TEST(AimedSigns, MoveFromTheSubjectOrFromTheObject) {
  const auto azimuth = [](const Aimed& sign, float done) { return aimed_hand(sign, Side::right, done).palm.x(); };
  for (const AimedSign& sign : aimed_signs()) {
    const Aimed token = aimed(sign.gloss, "right", "left");
    if (sign.aiming == Aiming::forward) {
      EXPECT_GT(azimuth(token, 1) - azimuth(token, 0), 0.3f) << sign.gloss;
    }
    if (sign.aiming == Aiming::backward) {
      EXPECT_LT(azimuth(token, 1) - azimuth(token, 0), -0.3f) << sign.gloss;
    }
  }
}

TEST(AimedSigns, ReachLessAndLessFarForFartherLoci) {
  const auto reach = [](const char* distance) {
    return (aimed_hand(aimed("DONNER", "self", at_azimuth(0, distance)), Side::right, 1).palm -
            aimed_hand(aimed("DONNER", "self", "front"), Side::right, 1).palm)
        .z();
  };
  EXPECT_GT(reach("/0/1.6"), 0.02f);
  EXPECT_GT(reach("/0/3"), reach("/0/2"));
  EXPECT_LT(reach("/0/6") - reach("/0/3"), 0.02f);
}

TEST(AimedSigns, TurnTheTrunkOnlyBeyondThirtyDegreesAndAtMostFifteen) {
  float before = 0;
  for (int degrees = 0; degrees <= 90; degrees += 5) {
    const float yaw = aimed_yaw(aimed("DONNER", "self", at_azimuth(degrees)), 1);
    EXPECT_FLOAT_EQ(yaw, -aimed_yaw(aimed("DONNER", "self", at_azimuth(-degrees)), 1));
    if (degrees <= 30) {
      EXPECT_EQ(yaw, 0) << degrees;
    } else {
      EXPECT_GT(yaw, before) << degrees;
    }
    EXPECT_LE(yaw, 15 * kDegree);
    before = yaw;
  }
  EXPECT_GT(before, 14 * kDegree);
  EXPECT_EQ(aimed_yaw(aimed("INVITER", "self", "75/0/1.2"), 1), 0) << "ends at the signer";
}

TEST(AimedSigns, KeepTwoHandsThatTouchRigidToEachOther) {
  const auto between = [](const Aimed& token, float done) {
    const AimedHand right = aimed_hand(token, Side::right, done);
    const AimedHand left = aimed_hand(token, Side::left, done);
    return std::pair(Vector3f(right.hand.conjugate() * (left.palm - right.palm)),
                     Quaternionf(right.hand.conjugate() * left.hand));
  };
  const auto first = between(aimed("AIDER", "self", "front"), 0);
  for (const int degrees : {-75, -25, 50, 75}) {
    for (const float done : {0.0f, 0.3f, 1.0f}) {
      const auto other = between(aimed("AIDER", "self", at_azimuth(degrees)), done);
      EXPECT_LT((other.first - first.first).norm(), 1e-4f) << degrees << ' ' << done;
      EXPECT_LT(other.second.angularDistance(first.second), 1e-3f) << degrees << ' ' << done;
    }
  }
}

/// Root mean square distance between the palm at the end of a sign and the best cubic of the object's azimuth, metres.
double off_cubic(std::string_view gloss) {
  constexpr int kFrom = -75, kStep = 5, kCount = 31;
  Eigen::MatrixXd powers(kCount, 4);
  Eigen::MatrixXd palms(kCount, 3);
  for (int i = 0; i < kCount; ++i) {
    const int degrees = kFrom + i * kStep;
    const double x = degrees / 75.0;
    powers.row(i) << 1, x, x * x, x * x * x;
    const Aimed token = aimed(gloss, "self", at_azimuth(degrees));
    palms.row(i) = aimed_hand(token, Side::right, 1).palm.cast<double>().transpose();
  }
  const Eigen::MatrixXd left = palms - powers * powers.colPivHouseholderQr().solve(palms);
  return std::sqrt(left.squaredNorm() / kCount);
}

TEST(AimedSigns, FollowNoCubicOfTheAzimuth) {
  for (const char* gloss : {"DONNER", "MONTRER", "DIRE", "GRONDER"}) {
    EXPECT_GT(off_cubic(gloss), 0.004) << gloss;
    EXPECT_LT(off_cubic(gloss), 0.03) << gloss << ": it is smooth";
  }
}

}  // namespace
}  // namespace signweave::demo
