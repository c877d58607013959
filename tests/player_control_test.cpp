// The player on whole databases: its behaviour when a user interferes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/player_showing.h"

namespace signweave {
namespace {

TEST(Player, NothingJumpsWhateverTheUserDoes) {
  const std::vector<std::string> glosses = corpus().contents()->segments.glosses();
  // One and a half times the speed of the fastest joint of an ordinary utterance.
  const auto [turn, displacement] =
      greatest_step(shown_whole("DEMAIN MATIN VANNES PLUIE RENNES NUAGES SOLEIL-BRILLER", {}).motion);
  std::mt19937 random(11);
  for (int round = 0; round < 40; ++round) {
    Player player(shared_cache(), {.synthesis = {}, .idle = random() % 3 == 0 ? Idle::end : Idle::living_rest});
    Shown shown;
    std::string story;
    for (int step = 0; step < 30; ++step) {
      const std::string gloss = to_string(GlossRef{glosses[random() % glosses.size()], 0});
      switch (random() % 5) {
        case 0:
          story += " sign " + gloss;
          player.sign(parse_utterance(gloss));
          break;
        case 1:
        case 2:
          story += " append " + gloss;
          player.append(parse_utterance(gloss));
          break;
        case 3:
          if (random() % 3 == 0) {
            story += " stop";
            player.stop();
          }
          break;
        default:
          break;
      }
      const std::size_t frames = random() % 150;
      story += " " + std::to_string(frames);
      show(player, shown, frames, 1 + random() % 60);
    }
    show(player, shown, 2000);
    const auto [most, farthest] = greatest_step(shown.motion);
    EXPECT_LT(most, 1.5f * turn) << "round " << round << story;
    EXPECT_LT(farthest, 1.5f * displacement + 0.005f) << "round " << round << story;
    EXPECT_TRUE(player.idle());
  }
}

TEST(Player, RestsAndBreathes) {
  Player player(shared_cache(), {.recording = "meteo"});
  ASSERT_NE(player.header(), nullptr);
  Shown shown;
  show(player, shown, 1000);
  EXPECT_EQ(shown.motion.frame_count(), 1000);
  EXPECT_TRUE(player.idle());
  EXPECT_GT(greatest_step(shown.motion).first, 0.0f);
  EXPECT_LT(greatest_step(shown.motion).first, 0.01f);
  player.sign(parse_utterance("PLUIE"));
  EXPECT_FALSE(player.idle());
  show(player, shown, 1000);
  EXPECT_EQ(shown.count(Kind::place), 1u);
  EXPECT_EQ(shown.count(Kind::rest), 1u);
  EXPECT_EQ(shown.motion.frame_count(), 2000);
}

TEST(Player, PausesAndResumes) {
  Player player(shared_cache(), {});
  player.sign(parse_utterance("DEMAIN MATIN"));
  Shown shown;
  show(player, shown, 20);
  player.pause();
  EXPECT_TRUE(player.paused());
  player.prepare(5);
  std::vector<float> tracks(player.header()->tracks.size());
  Motion one(player.header()->skeleton, player.header()->rate, 1);
  EXPECT_FALSE(player.next({one.pose(0), tracks}));
  player.resume();
  EXPECT_TRUE(player.next({one.pose(0), tracks}));
  EXPECT_EQ(player.frame(), 21u);
}

TEST(Player, SeeksToWhatItShowedThere) {
  const std::string tokens = "DEMAIN#1 MATIN#1 VANNES#1 PLUIE#2 RENNES#1";
  Player player(shared_cache(), {.idle = Idle::end});
  player.sign(parse_utterance(tokens));
  Shown whole;
  show(player, whole);
  for (const std::int64_t at : {0, 1, 40, 111, 170, 200, 260}) {
    const double hertz = player.header()->rate.hertz();
    player.seek(Milliseconds(std::llround(static_cast<double>(at) * 1000.0 / hertz)));
    Shown again;
    show(player, again);
    ASSERT_EQ(again.motion.frame_count(), whole.motion.frame_count() - at);
    EXPECT_EQ(again.count(Kind::seek), 1u);
    EXPECT_EQ(again.events.front().at, Milliseconds(std::llround(static_cast<double>(at) * 1000.0 / hertz)));
    for (std::int64_t frame = 0; frame < again.motion.frame_count(); ++frame) {
      for (std::size_t joint = 0; joint < again.motion.skeleton().joint_count(); ++joint) {
        const Eigen::Vector4f a = again.motion.pose(frame).rotations[joint].coeffs();
        const Eigen::Vector4f b = whole.motion.pose(at + frame).rotations[joint].coeffs();
        ASSERT_TRUE(a == b || a == -b) << "from " << at << ", frame " << frame << ", joint " << joint;
      }
    }
  }
}

TEST(Player, SeeksWhileItSigns) {
  Player player(shared_cache(), {});
  player.sign(parse_utterance("DEMAIN MATIN VANNES PLUIE RENNES NUAGES"));
  Shown shown;
  show(player, shown, 300);
  player.seek(Milliseconds(100));
  show(player, shown, 5000);
  // Every place is reported, those that had already ended once more.
  for (std::size_t place = 0; place < 6; ++place) {
    EXPECT_GE(std::ranges::count(shown.events, place, &PlayerEvent::place), 1) << place;
  }
  EXPECT_TRUE(player.idle());
}

TEST(Player, TempoIsChangedAtOnce) {
  const std::string tokens = "DEMAIN#1 MATIN#1 VANNES#1";
  const Shown plain = shown_whole(tokens, {});
  for (const double tempo : {0.25, 0.5, 0.8, 1.3, 2.0}) {
    Player player(shared_cache(), {.idle = Idle::end});
    player.sign(parse_utterance(tokens));
    player.set_tempo(tempo);
    Shown shown;
    show(player, shown);
    EXPECT_NEAR(static_cast<double>(shown.motion.frame_count()),
                static_cast<double>(plain.motion.frame_count()) / tempo, 1.0 / tempo + 1)
        << tempo;
    if (tempo < 1) continue;
    const auto at = static_cast<std::int64_t>(20);
    const auto [turn, displacement] = greatest_step(shown.motion);
    EXPECT_LT(turn, 2.2f * greatest_step(plain.motion).first) << at;
    EXPECT_LT(displacement, 2.2f * greatest_step(plain.motion).second + 0.001f);
  }
  Player player(shared_cache(), {});
  EXPECT_THROW(player.set_tempo(0.2), Error);
  EXPECT_THROW(player.set_tempo(2.5), Error);
  EXPECT_THROW(player.set_tempo(std::nan("")), Error);
}

TEST(Player, ATempoThatIsOneAgainShowsFramesAsTheyAre) {
  const std::string tokens = "DEMAIN#1 MATIN#1 VANNES#1";
  const Shown plain = shown_whole(tokens, {});
  Player player(shared_cache(), {.idle = Idle::end});
  player.sign(parse_utterance(tokens));
  Shown shown;
  show(player, shown, 20);
  player.set_tempo(0.7);
  show(player, shown, 13);
  player.set_tempo(1);
  show(player, shown);
  // The end is bit-identical.
  for (std::int64_t back = 1; back < 50; ++back) {
    const PoseView a = shown.motion.pose(shown.motion.frame_count() - back);
    const PoseView b = plain.motion.pose(plain.motion.frame_count() - back);
    for (std::size_t joint = 0; joint < a.rotations.size(); ++joint) {
      const Eigen::Vector4f q = a.rotations[joint].coeffs();
      const Eigen::Vector4f r = b.rotations[joint].coeffs();
      ASSERT_TRUE(q == r || q == -r) << back;
    }
  }
}

TEST(Player, LoopsWithoutASeam) {
  Player player(shared_cache(), {.idle = Idle::end, .loop = true});
  player.sign(parse_utterance("DEMAIN MATIN"));
  Shown shown;
  show(player, shown, 3000);
  EXPECT_EQ(shown.motion.frame_count(), 3000);
  EXPECT_GT(shown.count(Kind::place), 8u);
  EXPECT_LT(greatest_step(shown.motion).first, 0.5f);
  player.set_loop(false);
  show(player, shown, 3000);
  EXPECT_TRUE(player.idle());
  EXPECT_EQ(shown.count(Kind::end), 1u);
}

TEST(Player, AnUnknownGlossChangesNothing) {
  Player player(shared_cache(), {.idle = Idle::end});
  player.sign(parse_utterance("DEMAIN#1 MATIN#1"));
  Shown shown;
  show(player, shown, 30);
  EXPECT_THROW(player.append(parse_utterance("PLUIE NO-SUCH-SIGN")), Error);
  EXPECT_THROW(player.sign(parse_utterance("NO-SUCH-SIGN")), Error);
  show(player, shown);
  expect_same(shown, synthesize(corpus(), parse_utterance("DEMAIN#1 MATIN#1")), "what it had begun");
}

TEST(Player, ContinuesForLongWithoutStoringEverything) {
  Player player(shared_cache(), {.synthesis = {.rate = FrameRate{10, 1}}, .idle = Idle::end});
  const std::vector<std::string> glosses = corpus().contents()->segments.glosses();
  std::size_t place = 0;
  std::vector<float> tracks;
  Motion one;
  for (int i = 0; i < 2'500; ++i) {
    player.append(parse_utterance(to_string(GlossRef{glosses[static_cast<std::size_t>(i) % glosses.size()], 0})));
    while (player.prepare(16) > 0) {
      if (one.frame_count() == 0) one = Motion(player.header()->skeleton, player.header()->rate, 1);
      tracks.resize(player.header()->tracks.size());
      while (player.next({one.pose(0), tracks})) {
      }
      while (const auto event = player.take_event()) {
        if (event->kind != Kind::place) continue;
        EXPECT_EQ(event->place, place++);
      }
    }
  }
  EXPECT_EQ(place, 2'500u);
  player.seek(Milliseconds(0));  // as far back as frames are stored
  ASSERT_GT(player.prepare(16), 0u);
  const auto event = player.take_event();
  ASSERT_TRUE(event);
  EXPECT_GT(event->at, Milliseconds(100'000));
  Utterance many;
  many.places.assign(10'001, parse_utterance("DEMAIN").places.front());
  EXPECT_THROW(player.append(many), Error);
}

TEST(Player, ContinuesAfterAnEndPassedAtAnyTempo) {
  for (const double tempo : {0.25, 0.4, 0.5, 0.7, 1.0, 1.3, 1.7, 2.0}) {
    Player player(shared_cache(), {.idle = Idle::end});
    player.sign(parse_utterance("DEMAIN"));
    player.prepare(1);
    player.set_tempo(tempo);
    Shown shown;
    show(player, shown);
    EXPECT_EQ(shown.count(Kind::end), 1u) << tempo;
    EXPECT_GT(shown.events.back().at, Milliseconds(0));
    EXPECT_TRUE(player.idle()) << tempo;
    player.append(parse_utterance("MATIN"));
    EXPECT_FALSE(player.idle());
    show(player, shown);
    EXPECT_EQ(shown.count(Kind::place), 2u) << tempo;
    EXPECT_EQ(shown.count(Kind::end), 2u) << tempo;
  }
}

TEST(Player, ASeekWithoutAnUtteranceChangesNothing) {
  for (const Idle idle : {Idle::end, Idle::living_rest}) {
    Player player(shared_cache(), {.idle = idle});
    player.sign(parse_utterance("DEMAIN MATIN"));
    Shown shown;
    show(player, shown, 90);
    player.stop();
    show(player, shown, 25);
    player.seek(Milliseconds(0));
    show(player, shown, 1000);
    EXPECT_EQ(shown.count(Kind::seek), 0u);
    EXPECT_TRUE(player.idle());
    EXPECT_LT(greatest_step(shown.motion).first, 0.5f);
  }
}

TEST(Player, StoppingTwiceIsStoppingOnce) {
  const std::string text = "BRETAGNE MATIN NUAGES VANNES DEMAIN PLUIE";
  for (std::size_t at = 5; at < 500; at += 23) {
    std::vector<std::int64_t> frames;
    for (const std::size_t second : {0u, 1u, 5u}) {
      Player player(shared_cache(), {.idle = Idle::end});
      player.sign(parse_utterance(text));
      Shown shown;
      show(player, shown, at);
      player.stop();
      show(player, shown, second);
      if (second > 0) player.stop();
      show(player, shown);
      EXPECT_TRUE(player.idle());
      EXPECT_LT(greatest_step(shown.motion).first, 0.65f) << at << " " << second;
      frames.push_back(shown.motion.frame_count());
    }
    EXPECT_EQ(frames[0], frames[1]) << at;
  }
}

TEST(Player, ASignThatEndsSoonIsFinished) {
  Player player(shared_cache(), {.idle = Idle::end});
  player.sign(parse_utterance("DEMAIN#1 MATIN#1"));
  Shown shown;
  show(player, shown, 2, 2);
  while (shown.count(Kind::place) < 1) show(player, shown, 1, 1);
  const auto begun = static_cast<std::int64_t>(player.frame());
  player.prepare(Player::kMostReady);
  player.stop();
  show(player, shown);
  const Synthesized made = synthesize(corpus(), parse_utterance("DEMAIN#1"));
  EXPECT_EQ(shown.motion.frame_count(), made.result.motion.frame_count()) << begun;
}

TEST(Player, ALoopMayBeginAfterTheEnd) {
  Player player(shared_cache(), {.idle = Idle::end});
  player.sign(parse_utterance("DEMAIN MATIN"));
  Shown shown;
  show(player, shown);
  player.set_loop(true);
  show(player, shown, 2000);
  EXPECT_GE(shown.count(Kind::place), 6u);
  EXPECT_LT(greatest_step(shown.motion).first, 0.65f);
}

TEST(Player, SeeksWithinARoundOfALoop) {
  Player player(shared_cache(), {.loop = true});
  player.sign(parse_utterance("DEMAIN MATIN NUAGES"));
  Shown shown;
  show(player, shown, 2);
  Milliseconds last{0};
  while (shown.count(Kind::place) < 3) show(player, shown, 1, 1);
  last = shown.events.back().at;
  player.prepare(Player::kMostReady);  // the next round
  player.seek(last);
  Shown again;
  show(player, again, 400);
  ASSERT_GE(again.events.size(), 2u);
  EXPECT_EQ(again.events[0].kind, Kind::seek);
  EXPECT_EQ(again.events[0].at, last);
  EXPECT_EQ(again.events[1].place, 2u);
}

TEST(Player, SurvivesAnything) {
  const std::vector<std::string> glosses = corpus().contents()->segments.glosses();
  std::mt19937 random(23);
  for (int round = 0; round < 60; ++round) {
    Player player(shared_cache(), {.synthesis = {.rate = FrameRate{random() % 2 == 0 ? 60 : 100, 1}},
                                   .idle = random() % 2 == 0 ? Idle::end : Idle::living_rest,
                                   .loop = random() % 4 == 0});
    Shown shown;
    for (int step = 0; step < 40; ++step) {
      const std::string gloss = to_string(GlossRef{glosses[random() % glosses.size()], 0});
      switch (random() % 9) {
        case 0:
          player.sign(parse_utterance(gloss + " DEMAIN MATIN"));
          break;
        case 1:
        case 2:
          player.append(parse_utterance(gloss));
          break;
        case 3:
          player.stop();
          break;
        case 4:
        case 5:
          player.seek(Milliseconds(random() % 4000));
          break;
        case 6:
          player.set_tempo(random() % 2 == 0 ? 1.0 : 0.25 + 0.01 * static_cast<double>(random() % 175));
          break;
        case 7:
          player.set_loop(random() % 2 == 0);
          break;
        default:
          break;
      }
      show(player, shown, random() % 80, 1 + random() % 60);
    }
    for (const Eigen::Quaternionf& q : shown.motion.rotations()) ASSERT_NEAR(q.norm(), 1.0f, 1e-3f) << round;
    player.set_loop(false);
    player.set_tempo(1);
    player.append(parse_utterance("DEMAIN"));
    Shown end;
    show(player, end, 3000);
    EXPECT_TRUE(player.idle()) << round;
    EXPECT_GE(end.count(Kind::place), 1u) << round;
  }
}

TEST(Player, StopsSoon) {
  Player player(shared_cache(), {});
  player.sign(parse_utterance("DEMAIN MATIN VANNES PLUIE RENNES NUAGES"));
  Shown shown;
  show(player, shown, 130);
  const std::size_t before = shown.count(Kind::place);
  player.stop();
  show(player, shown, 400);
  EXPECT_TRUE(player.idle());
  EXPECT_LE(shown.count(Kind::place), before + 1);
  EXPECT_EQ(shown.count(Kind::rest), 1u);
}

TEST(Player, RefusesInvalidRequests) {
  EXPECT_THROW(Player(shared_cache(), {.look_ahead = 0}), Error);
  EXPECT_THROW(Player(shared_cache(), {.look_ahead = 17}), Error);
  EXPECT_THROW(Player(shared_cache(), {.recording = "no such"}), Error);
  EXPECT_THROW(Player(shared_cache(), {.synthesis = {.tempo = 9}}), Error);
  Player player(shared_cache(), {});
  player.append(parse_utterance("DEMAIN"));
  Place late = parse_utterance("MATIN").places.front();
  late.pause_before = Milliseconds(60'001);
  EXPECT_THROW(player.append({{late}}), Error);
}

}  // namespace
}  // namespace signweave
