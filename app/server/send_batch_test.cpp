#include "app/server/send_batch.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace signweave::server {
namespace {

/// The sending end of a connection; the test reads at the other end.
class Line final : public SendBatch::Sender {
 public:
  Line() {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) throw std::runtime_error("no sockets");
    descriptor = ends[0];
    other = ends[1];
  }
  Line(const Line&) = delete;
  ~Line() {
    ::close(descriptor);
    hang_up();
  }
  void hang_up() {
    if (other >= 0) ::close(std::exchange(other, -1));
  }
  void add_to(SendBatch& batch, std::string_view text, std::string_view more = {}) {
    parts = {std::as_bytes(std::span(text)), std::as_bytes(std::span(more))};
    batch.add(*this, descriptor);
  }
  std::string received() const {
    std::string all;
    char buffer[4096];
    for (ssize_t n; (n = ::recv(other, buffer, sizeof buffer, MSG_DONTWAIT)) > 0;) {
      all.append(buffer, static_cast<std::size_t>(n));
    }
    return all;
  }

  int descriptor = -1;
  int other = -1;
  SendBatch::Parts parts;
  std::vector<long> results;

 private:
  SendBatch::Parts to_send() const noexcept override { return parts; }
  void sent(long result) noexcept override { results.push_back(result); }
};

class SendBatchTest : public ::testing::TestWithParam<SendBatch::Mode> {
 protected:
  SendBatchTest() { batch.use(GetParam()); }

  Counter by_one_call;
  SendBatch batch{by_one_call};
};

INSTANTIATE_TEST_SUITE_P(BothDirections, SendBatchTest,
                         ::testing::Values(SendBatch::Mode::one_call, SendBatch::Mode::call_each),
                         [](const auto& info) {
                           return info.param == SendBatch::Mode::one_call ? "OneCall" : "CallEach";
                         });

using Results = std::vector<long>;

TEST_P(SendBatchTest, SendsToEachItsOwnAndReportsTheBytes) {
  Line a, b;
  batch.collect();
  a.add_to(batch, "first");
  b.add_to(batch, "second one");
  EXPECT_EQ(a.received(), "") << "it must only be collected";
  batch.finish();
  EXPECT_FALSE(batch.collecting());
  EXPECT_EQ(a.received(), "first");
  EXPECT_EQ(b.received(), "second one");
  EXPECT_EQ(a.results, Results{5});
  EXPECT_EQ(b.results, Results{10});
  EXPECT_EQ(by_one_call.value(), batch.mode() == SendBatch::Mode::one_call ? 2u : 0u);
  batch.finish();
  EXPECT_EQ(a.results.size(), 1u) << "what was sent is forgotten";
}

TEST_P(SendBatchTest, SendsTwoPartsInTheirOrder) {
  Line a, b;
  batch.collect();
  a.add_to(batch, "text", "frame");
  b.add_to(batch, "", "frame");
  batch.finish();
  EXPECT_EQ(a.received(), "textframe");
  EXPECT_EQ(b.received(), "frame");
  EXPECT_EQ(a.results, Results{9});
  EXPECT_EQ(b.results, Results{5});
}

TEST_P(SendBatchTest, AReceiverThatReadsNothingDelaysNoOthers) {
  Line full, gone, good;
  const std::string much(4 << 20, 'x');
  gone.hang_up();
  batch.collect();
  full.add_to(batch, much);
  gone.add_to(batch, "lost");
  good.add_to(batch, "good");
  batch.flush();
  ASSERT_EQ(full.results.size(), 1u);
  EXPECT_GT(full.results[0], 0);
  EXPECT_LT(full.results[0], static_cast<long>(much.size())) << "as much as the kernel has room for";
  EXPECT_EQ(gone.results, Results{-EPIPE}) << "and no signal";
  EXPECT_EQ(good.received(), "good");
  full.add_to(batch, much);
  good.add_to(batch, "again");
  batch.finish();
  EXPECT_EQ(full.results[1], -EAGAIN);
  EXPECT_EQ(good.received(), "again");
}

TEST_P(SendBatchTest, MoreThanABatchIsSentInSeveral) {
  std::vector<Line> lines(2 * SendBatch::kMost + 3);
  batch.collect();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    lines[i].add_to(batch, "message");
    EXPECT_EQ(lines[0].results.size(), i < SendBatch::kMost ? 0u : 1u) << i;
  }
  EXPECT_TRUE(batch.collecting());
  batch.finish();
  for (const Line& line : lines) {
    EXPECT_EQ(line.results, Results{7});
    EXPECT_EQ(line.received(), "message");
  }
}

TEST_P(SendBatchTest, ContinuesWithoutTheRingIfItBreaks) {
  Line a, b;
  for (const auto& one : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code ignored;
    const std::string is = std::filesystem::read_symlink(one.path(), ignored).string();
    if (is.find("io_uring") != std::string::npos) ::close(std::stoi(one.path().filename().string()));
  }
  batch.collect();
  a.add_to(batch, "one");
  b.add_to(batch, "two");
  batch.finish();
  EXPECT_EQ(batch.mode(), SendBatch::Mode::call_each);
  EXPECT_EQ(a.received(), "one");
  EXPECT_EQ(b.received(), "two") << "once each";
  EXPECT_EQ(by_one_call.value(), 0u);
}

TEST(SendBatchAlone, SendsOneByOneIfTheKernelRefusesTheRing) {
  Line a;
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const rlimit none{.rlim_cur = 0, .rlim_max = before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  Counter by_one_call;
  SendBatch batch(by_one_call);
  batch.use(SendBatch::Mode::one_call);
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_EQ(batch.mode(), SendBatch::Mode::call_each);
  batch.collect();
  a.add_to(batch, "text");
  batch.finish();
  EXPECT_EQ(a.received(), "text");
}

}  // namespace
}  // namespace signweave::server
