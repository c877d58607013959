#include "signweave/formats/bvh/decimal.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "signweave/formats/bvh/space.h"

namespace signweave::bvh {
namespace {

std::string fixed(double value, int decimals) {
  DecimalText text;
  text.fixed(value, decimals);
  return std::string(text.view());
}

std::string length(float metres, double unit) {
  DecimalText text;
  text.length(metres, unit);
  return std::string(text.view());
}

/// The same with {fmt}, whose digits are those of the exact value.
std::string plainly(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (decimals > 0) text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

TEST(BvhDecimal, FixedNumbersHaveTheDigitsOfTheExactValue) {
  std::mt19937_64 random(1);
  for (const double most : {1e-7, 1e-3, 1.0, 400.0, 1e5, 1e6, 1e7, 1e15, 1e22}) {
    std::uniform_real_distribution<double> any(-most, most);
    for (int i = 0; i < 20'000; ++i) {
      const double value = any(random);
      for (const int decimals : {0, 1, 4, 5, 8, 17}) ASSERT_EQ(fixed(value, decimals), plainly(value, decimals));
    }
  }
}

TEST(BvhDecimal, TiesAndTheirNeighboursAreRoundedAsTheyAre) {
  for (int i = -2'000; i <= 2'000; ++i) {
    // Odd multiples of 2^-6 have a 5 as their sixth and last decimal: exact ties.
    const double tie = i / 64.0;
    const double decimal = i * 1e-5 + 5e-6;
    for (const double value : {tie, std::nextafter(tie, 1e9), std::nextafter(tie, -1e9), decimal,
                               std::nextafter(decimal, 1e9), std::nextafter(decimal, -1e9)}) {
      ASSERT_EQ(fixed(value, 5), plainly(value, 5));
    }
  }
}

TEST(BvhDecimal, ZeroIsPrintedAsZero) {
  for (const double value : {0.0, -0.0, 1e-9, -1e-9, -4.9e-6}) EXPECT_EQ(fixed(value, 5), "0");
  EXPECT_EQ(length(-0.0f, 0.01), "0");
}

TEST(BvhDecimal, LengthsReadBackToTheSameBits) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> power(-12, 6);
  for (const double unit : {1.0, 0.01, 0.001, 0.0254, 0.0564}) {
    for (int i = 0; i < 20'000; ++i) {
      // The length as a file has it, because not every float of metres is the conversion of a float in another unit.
      const float metres = to_metres(static_cast<float>((i % 2 == 0 ? 1 : -1) * std::pow(10.0, power(random))), unit);
      const std::string text = length(metres, unit);
      double read = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), read);
      ASSERT_EQ(error, std::errc());
      ASSERT_EQ(end, text.data() + text.size());
      ASSERT_EQ(to_metres(static_cast<float>(read), unit), metres) << text;
    }
  }
}

TEST(BvhDecimal, LengthsHaveAsFewDecimalsAsPossible) {
  for (const char* const text : {"0.0001", "-6.2023", "87.7332", "-161.6986", "12.9947", "0.890477", "-0.000138",
                                 "5000", "0.0000051072", "999.9999", "0.9999999", "0.001", "1000000"}) {
    double value = 0;
    std::from_chars(text, text + std::string_view(text).size(), value);
    for (const double unit : {1.0, 0.01, 0.0254}) {
      EXPECT_EQ(length(to_metres(static_cast<float>(value), unit), unit), text) << unit;
    }
  }
}

TEST(BvhDecimal, NoNumberIsTooLongForTheBuffer) {
  DecimalText text;
  const double most = std::numeric_limits<double>::max();
  for (int i = 0; i < 10; ++i) text.fixed(i % 2 == 0 ? most : -most, 5);
  text.length(std::numeric_limits<float>::denorm_min(), 1e6);
  text.length(std::numeric_limits<float>::max(), 1e-6);
  EXPECT_GT(text.view().size(), 3'000u);
  text.clear();
  text.fixed(1.5, 5);
  text.letter(' ');
  EXPECT_EQ(text.view(), "1.5 ");
}

}  // namespace
}  // namespace signweave::bvh
