// Tests of concurrent players, changes of the database, and the frame path. What a player shows is tested on whole
// databases in tests/player_test.cpp.
#include "signweave/live/player.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "signweave/core/test_allocations.h"
#include "signweave/database/test_signing.h"

namespace signweave {
namespace {

using testing_database::recording_of;
using testing_database::TestFolder;

/// A database of three recordings, open for writing.
struct Corpus {
  TestFolder folder;
  std::unique_ptr<Database> database;

  explicit Corpus(const std::string& engine = "lmdb") {
    Database::create(folder / "db", {.engine = engine});
    database = std::make_unique<Database>(folder / "db", kv::Access::read_write);
    database->put(recording_of("a", 1, {"UN", "DEUX", "TROIS"}));
    database->put(recording_of("b", 2, {"DEUX", "QUATRE"}));
    database->put(recording_of("c", 3, {"CINQ"}));
  }
};

/// Takes frames into preallocated memory.
struct Taker {
  Motion motion;
  std::vector<float> tracks;

  explicit Taker(const Player& player)
      : motion(player.header()->skeleton, player.header()->rate, 1), tracks(player.header()->tracks.size()) {}
  bool take(Player& player) { return player.next({motion.pose(0), tracks}); }
};

TEST(PlayerFramePath, TakingFramesAllocatesNothing) {
  const Corpus corpus;
  SharedSigningCache cache(*corpus.database);
  Player player(cache, {});
  player.sign(parse_utterance("UN QUATRE CINQ"));
  player.prepare(1);
  Taker taker(player);
  for (const double tempo : {1.0, 0.7}) {
    player.set_tempo(tempo);
    for (int round = 0; round < 40; ++round) {
      const std::size_t ready = player.prepare(30);
      ASSERT_GE(ready, 30u);
      EXPECT_EQ(allocations_in([&] {
                  for (std::size_t i = 0; i < ready; ++i) taker.take(player);
                }),
                0u);
      while (player.take_event()) {
      }
    }
  }
}

TEST(PlayerFramePath, AWaitingPlayerHoldsNoDatabaseResources) {
  // As many players as the default engine allows readers, and twice as many.
  const Corpus corpus;
  SharedSigningCache cache(*corpus.database);
  std::vector<std::unique_ptr<Player>> players;
  for (int i = 0; i < 300; ++i) {
    players.push_back(std::make_unique<Player>(cache, PlayerOptions{}));
    players.back()->sign(parse_utterance("UN DEUX"));
    EXPECT_GT(players.back()->prepare(5), 0u);
  }
}

class ConcurrentPlayers : public testing::TestWithParam<std::string> {};

TEST_P(ConcurrentPlayers, ConcurrentPlayersContinueWhileTheDatabaseChanges) {
  const Corpus corpus(GetParam());
  SharedSigningCache cache(*corpus.database);
  std::atomic<bool> stop = false;
  std::atomic<int> signed_places = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i) {
    threads.emplace_back([&, i] {
      Player player(cache, {.loop = i == 2});
      player.sign(parse_utterance("UN DEUX TROIS"));
      player.prepare(1);
      Taker taker(player);
      // A slow machine takes many rounds until the concurrent changes are done; the queue must not grow with them.
      constexpr int kMostRoundsThatAppend = 50'000;
      for (int round = 0; !stop; ++round) {
        try {
          if (round % 50 == 49 && round < kMostRoundsThatAppend)
            player.append(parse_utterance(i == 0 ? "DEUX UN" : "TROIS DEUX"));
          const std::size_t ready = player.prepare(16);
          for (std::size_t k = 0; k < ready; ++k) ASSERT_TRUE(taker.take(player));
          while (const auto event = player.take_event()) {
            if (event->kind == PlayerEvent::Kind::place) ++signed_places;
          }
        } catch (const Error& error) {
          ADD_FAILURE() << error.what();
        }
      }
    });
  }
  for (int i = 1; i <= 12; ++i) {
    corpus.database->put(recording_of("c", i, {"CINQ"}));
    corpus.database->put(recording_of("d" + std::to_string(i), i, {"DEUX"}));
    corpus.database->relayout("a", {.mode = parse_access_mode(i % 2 == 0 ? "by_frame:16" : "by_joint")});
  }
  while (signed_places < 60) std::this_thread::yield();
  stop = true;
  for (std::thread& thread : threads) thread.join();
}

INSTANTIATE_TEST_SUITE_P(Engines, ConcurrentPlayers, testing::ValuesIn(kv::engines()),
                         [](const auto& tested) { return tested.param; });

TEST(PlayerDuringChanges, ARemovedClipIsSkippedAndTheOthersAreSigned) {
  const Corpus corpus;
  SharedSigningCache cache(*corpus.database);
  Player player(cache, {.idle = Idle::end});
  player.sign(parse_utterance("UN CINQ QUATRE"));
  player.prepare(1);
  corpus.database->remove("c");
  Taker taker(player);
  std::vector<std::string> glosses;
  int faults = 0;
  for (int round = 0; round < 2000; ++round) {
    try {
      if (player.prepare(1) == 0) break;
    } catch (const Error& error) {
      ++faults;
      continue;
    }
    taker.take(player);
    while (const auto event = player.take_event()) {
      if (event->kind == PlayerEvent::Kind::place) glosses.push_back(event->gloss);
    }
  }
  EXPECT_EQ(faults, 1);
  EXPECT_EQ(glosses, (std::vector<std::string>{"UN", "QUATRE"}));
  EXPECT_TRUE(player.idle());
}

TEST(PlayerDuringChanges, ContinuesFromTheShownPoseIfTheRestOfASignIsGone) {
  for (const std::size_t shown : {5u, 40u, 120u}) {
    const Corpus corpus;
    SharedSigningCache cache(*corpus.database);
    Player player(cache, {});
    player.sign(parse_utterance("\"c\"@0..2500 UN"));
    player.prepare(1);
    Taker taker(player);
    for (std::size_t i = 0; i < shown; ++i) {
      ASSERT_GE(player.prepare(1), 1u);
      taker.take(player);
    }
    corpus.database->remove("c");
    int faults = 0;
    std::vector<std::string> glosses;
    for (int round = 0; round < 1500; ++round) {
      try {
        player.prepare(1);
      } catch (const Error&) {
        ++faults;
      }
      taker.take(player);
      while (const auto event = player.take_event()) {
        if (event->kind == PlayerEvent::Kind::place && !event->gloss.empty()) glosses.push_back(event->gloss);
      }
    }
    EXPECT_EQ(faults, 1) << shown;
    EXPECT_EQ(glosses.back(), "UN") << shown;
    EXPECT_TRUE(player.idle()) << shown;
  }
}

TEST(PlayerDuringChanges, AHeldHandStaysUpIfItsRecordingIsGone) {
  for (const bool removed : {false, true}) {
    const Corpus corpus;
    SharedSigningCache cache(*corpus.database);
    Player player(cache, {.idle = Idle::end});
    player.sign(parse_utterance("CINQ{weak hold ..} UN"));
    player.prepare(1);
    Taker taker(player);
    std::vector<std::string> notices;
    while (player.prepare(1) > 0) {
      taker.take(player);
      while (const auto event = player.take_event()) {
        if (removed && event->gloss == "UN") corpus.database->remove("c");
        if (event->kind == PlayerEvent::Kind::notice && event->text.find("'c'") != std::string::npos) {
          notices.push_back(event->text);
        }
      }
    }
    EXPECT_EQ(notices.size(), removed ? 1u : 0u);
    EXPECT_TRUE(player.idle());
  }
}

TEST(PlayerNotices, SayOnceHowTheStreamIsSigned) {
  const Corpus corpus;
  corpus.database->remove("a");
  corpus.database->remove("b");
  corpus.database->put(recording_of("d", 4, {"SIX"}));  // now there are no transitions to be measured
  SharedSigningCache cache(*corpus.database);
  Player player(cache, {.idle = Idle::end});
  player.sign(parse_utterance("CINQ"));
  player.prepare(64);
  Taker taker(player);
  std::size_t reported = 0;
  std::size_t unseen = 0;
  const auto take = [&](std::size_t most) {
    for (std::size_t i = 0; i < most && player.prepare(1) > 0 && taker.take(player); ++i) {
      while (const auto event = player.take_event()) {
        if (event->text.find("no measurable transitions") != std::string::npos) ++reported;
        if (event->text.find("is not seen") != std::string::npos) ++unseen;
      }
    }
  };
  for (int i = 0; i < 1'000 && reported == 0; ++i) take(1);
  player.append(parse_utterance("SIX{brows up}"));  // the stream has no tracks for it, which is a notice
  player.prepare(64);
  player.seek(Milliseconds(0));  // before that notice is taken
  EXPECT_EQ(unseen, 0u);
  take(10'000);
  EXPECT_TRUE(player.idle());
  EXPECT_EQ(unseen, 1u);
  EXPECT_EQ(reported, 1u);
}

}  // namespace
}  // namespace signweave
