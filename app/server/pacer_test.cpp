#include "app/server/pacer.h"

#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>
#include <functional>
#include <vector>

namespace signweave::server {
namespace {

using namespace std::chrono_literals;

Clock::duration times(std::size_t step, Clock::duration each) {
  return each * static_cast<Clock::rep>(step);
}

struct Woken final : Paced {
  Clock::time_point tick(Clock::time_point now) noexcept override {
    ticks.push_back(now);
    return on_tick ? on_tick(now) : kNever;
  }
  bool work() override { return on_work && on_work(); }

  std::vector<Clock::time_point> ticks;
  std::function<Clock::time_point(Clock::time_point)> on_tick;
  std::function<bool()> on_work;
};

struct PacerTest : ::testing::Test {
  boost::asio::io_context io;
  Counter by_one_call;
  SendBatch sends{by_one_call};
  Pacer pacer{io, sends};
  const Clock::time_point begin = Clock::now();
};

TEST_F(PacerTest, WakesEachAtItsTimeAndOnce) {
  std::vector<Woken> streams(5);
  // Beyond the range of the wheel, at its end, and nearer; one that is already due.
  const std::vector<std::chrono::microseconds> after = {700ms, 255ms, 254ms, 3'300us, -5ms};
  for (std::size_t i = 0; i < streams.size(); ++i) pacer.wake_at(streams[i], begin + after[i]);
  io.run();
  for (std::size_t i = 0; i < streams.size(); ++i) {
    ASSERT_EQ(streams[i].ticks.size(), 1u) << i;
    EXPECT_GE(streams[i].ticks[0], begin + after[i]) << i;
  }
  EXPECT_LT(streams[4].ticks[0], streams[3].ticks[0]);
  EXPECT_LT(streams[3].ticks[0], streams[2].ticks[0]);
  EXPECT_LT(streams[1].ticks[0], streams[0].ticks[0]);
}

TEST_F(PacerTest, KeepsARateAlsoAfterALongPause) {
  Woken stream;
  const auto sixty = [&](Clock::time_point) {
    return stream.ticks.size() % 6 == 0 ? Paced::kNever : begin + times(stream.ticks.size(), 16'667us);
  };
  stream.on_tick = sixty;
  pacer.wake_at(stream, begin);
  io.run();
  ASSERT_EQ(stream.ticks.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_GE(stream.ticks[i], begin + times(i, 16'667us));
  // Nothing is woken for longer than a turn of the wheel; then it continues, and not too early.
  const Clock::time_point later = Clock::now() + 600ms;
  stream.on_tick = nullptr;
  pacer.wake_at(stream, later);
  io.restart();
  io.run();
  ASSERT_EQ(stream.ticks.size(), 7u);
  EXPECT_GE(stream.ticks[6], later);
  while (Clock::now() < later + 300ms) {
  }
  pacer.wake_at(stream, Clock::now() + 2ms);
  io.restart();
  io.run();
  EXPECT_EQ(stream.ticks.size(), 8u);
}

TEST_F(PacerTest, StreamsDueAtOneTickSendTogether) {
  std::vector<Woken> streams(3);
  const Clock::time_point due = std::chrono::ceil<std::chrono::milliseconds>(begin) + 5ms;
  int collecting = 0;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    streams[i].on_tick = [&](Clock::time_point) {
      collecting += sends.collecting() ? 1 : 0;
      return Paced::kNever;
    };
    pacer.wake_at(streams[i], due - times(i, 100us));
  }
  io.run();
  EXPECT_EQ(collecting, 3);
  EXPECT_FALSE(sends.collecting()) << "between ticks messages are sent at once";
  EXPECT_EQ(streams[0].ticks, streams[1].ticks);
  EXPECT_EQ(streams[0].ticks, streams[2].ticks);
}

TEST_F(PacerTest, ATimeIsChangedOrForgotten) {
  Woken sooner, never, forgotten;
  for (Woken* one : {&sooner, &never, &forgotten}) pacer.wake_at(*one, begin + 10s);
  pacer.wake_at(sooner, begin + 1ms);
  pacer.wake_at(never, Paced::kNever);
  pacer.want_work(forgotten);
  forgotten.on_work = [] {
    ADD_FAILURE() << "it should have been forgotten";
    return false;
  };
  pacer.forget(forgotten);
  io.run_for(50ms);
  EXPECT_EQ(sooner.ticks.size(), 1u);
  EXPECT_TRUE(never.ticks.empty());
  EXPECT_TRUE(forgotten.ticks.empty());
}

TEST_F(PacerTest, DueStreamsGoBeforeMoreWork) {
  Woken paced, working;
  paced.on_tick = [&](Clock::time_point) {
    return paced.ticks.size() < 5 ? begin + times(paced.ticks.size(), 2ms) : Paced::kNever;
  };
  int pieces = 0;
  Clock::time_point work_end;
  working.on_work = [&] {
    const Clock::time_point end = Clock::now() + 3ms;
    while (Clock::now() < end) {
    }
    work_end = Clock::now();
    return ++pieces < 8;
  };
  pacer.wake_at(paced, begin);
  pacer.want_work(working);
  io.run();
  EXPECT_EQ(pieces, 8);
  EXPECT_EQ(paced.ticks.size(), 5u);
  EXPECT_LT(paced.ticks[1], work_end) << "it must not wait for all of the work";
}

TEST_F(PacerTest, AStreamMayBeDestroyedBeforeItsTick) {
  auto gone = std::make_unique<Woken>();
  Woken stream;
  pacer.wake_at(stream, begin + 2ms);
  pacer.wake_at(*gone, begin + 2ms);
  gone.reset();
  io.run();
  EXPECT_EQ(stream.ticks.size(), 1u);
}

}  // namespace
}  // namespace signweave::server
