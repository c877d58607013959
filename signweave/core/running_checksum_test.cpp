#include "signweave/core/running_checksum.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace signweave {
namespace {

TEST(RunningChecksum, PiecesGiveTheChecksumOfTheWhole) {
  Bytes bytes(10'000);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i * i >> 3);
  for (const std::size_t step : {1U, 8U, 255U, 256U, 1'000U, 20'000U}) {
    RunningChecksum sum;
    EXPECT_EQ(sum.value(), checksum({}));
    for (std::size_t at = 0; at < bytes.size(); at += step) {
      sum.add(ByteSpan(bytes).subspan(at, std::min(step, bytes.size() - at)));
    }
    EXPECT_EQ(sum.value(), checksum(bytes)) << step;
  }
}

}  // namespace
}  // namespace signweave
