#include "signweave/features/unmarked_handshape.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace signweave {
namespace {

/// Degrees: of each finger besides the thumb the flexion of the knuckle, and the sum of the two joints beyond it.
struct Letter {
  char name;
  std::array<float, 8> angles;
};
// Letters of the manual alphabet of ASL, as estimated from videos; good to 20 degrees.
constexpr Letter kLetters[] = {
    {'A', {58, 113, 55, 136, 51, 161, 41, 167}}, {'B', {22, 15, 9, 12, 4, 10, 13, 10}},
    {'C', {23, 42, 11, 55, 6, 56, 9, 61}},       {'F', {38, 80, 11, 18, 4, 15, 8, 15}},
    {'G', {72, 11, 73, 165, 65, 181, 64, 178}},  {'H', {52, 6, 39, 6, 30, 167, 38, 139}},
    {'I', {59, 122, 65, 124, 70, 131, 23, 29}},  {'K', {28, 21, 37, 32, 83, 120, 92, 110}},
    {'O', {38, 95, 32, 100, 33, 99, 48, 71}},    {'P', {31, 15, 61, 18, 64, 159, 61, 147}},
    {'R', {32, 16, 12, 7, 20, 158, 29, 143}},    {'S', {39, 132, 32, 163, 41, 184, 54, 175}},
    {'U', {19, 13, 10, 9, 21, 158, 32, 143}},    {'V', {19, 11, 17, 12, 29, 155, 36, 148}},
    {'W', {9, 17, 2, 18, 9, 18, 36, 124}},       {'X', {29, 73, 76, 137, 81, 157, 82, 143}},
    {'Y', {109, 61, 110, 67, 92, 99, 18, 50}},
};

Handshape shape_of(const Letter& letter) {
  Handshape shape;
  for (std::size_t finger = 0; finger < 4; ++finger) {
    shape.values[3 * (finger + 1)] = letter.angles[2 * finger] / 90;
    shape.values[3 * (finger + 1) + 1] = letter.angles[2 * finger + 1] / 180;
  }
  return shape;
}

TEST(UnmarkedHandshape, IsOneOfFiveLetters) {
  for (const Letter& letter : kLetters) {
    EXPECT_EQ(is_unmarked(shape_of(letter)), std::string("ABCOS").find(letter.name) != std::string::npos)
        << letter.name;
  }
}

TEST(UnmarkedHandshape, IsOneButNotL) {
  Handshape shape = shape_of({'1', {16, 7, 68, 126, 74, 141, 76, 156}});
  EXPECT_TRUE(is_unmarked(shape));
  shape.values[5] = 0.9f;  // the thumb at a right angle
  EXPECT_FALSE(is_unmarked(shape));
}

TEST(UnmarkedHandshape, DiffersFromAnotherBeyondTheSpreadOfOne) {
  const Handshape flat = shape_of({'B', {22, 15, 9, 12, 4, 10, 13, 10}});
  Handshape near = flat;
  for (float& value : near.values) value += 0.08f;
  EXPECT_FALSE(handshapes_differ(flat, near));
  EXPECT_TRUE(handshapes_differ(flat, shape_of(kLetters[0])));
}

}  // namespace
}  // namespace signweave
