// What a stream reports of its channels: the notices of a file of the same text, each once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <set>

#include "signweave/choose/synthesizer.h"
#include "signweave/core/error.h"
#include "tests/player_showing.h"

namespace signweave::player_notices {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;
using Texts = std::multiset<std::string>;

/// A notice; of a hold without its length.
std::string text_of(const std::string& code, const std::string& text) {
  return code + ": " + (code == "long_hold" ? text.substr(0, text.find("' is held") + 9) : text);
}

Texts notices_of_file(const Utterance& utterance) {
  Texts texts;
  for (const Notice& notice : synthesize(corpus(), utterance).result.notices) {
    if (!notice.code.empty()) texts.insert(text_of(notice.code, notice.text));
  }
  return texts;
}

Texts notices_in(const Shown& shown) {
  Texts texts;
  for (const PlayerEvent& event : shown.events) {
    if (event.kind == Kind::notice && !event.code.empty()) texts.insert(text_of(event.code, event.text));
  }
  return texts;
}

std::set<std::string> codes_in(const Shown& shown) {
  std::set<std::string> codes;
  for (const PlayerEvent& event : shown.events) codes.insert(event.code);
  codes.erase(std::string());
  return codes;
}

TEST(PlayerNotices, AreThoseOfAFile) {
  const std::vector<std::string> glosses = corpus().contents()->segments.glosses();
  std::set<std::string> codes;
  const char* const wanted = std::getenv("SIGNWEAVE_SEEDS");  // by hand: 1000
  const unsigned seeds = wanted == nullptr ? 24 : static_cast<unsigned>(std::atoi(wanted));
  for (unsigned seed = 0; seed < seeds; ++seed) {
    std::mt19937 random(seed);
    const auto below = [&](std::size_t count) { return random() % count; };
    const auto gloss = [&] { return to_string(GlossRef{glosses[below(glosses.size())], 1}); };
    const auto part = [&] {
      constexpr std::array kParts = {"weak", "dominant", "weak fingers", "head"};
      return kParts[below(kParts.size())] + (": " + gloss());
    };
    std::string text;
    for (std::size_t i = 1 + below(4); i > 0; --i) {
      switch (below(5)) {
        case 0:
          text += "[" + gloss() + " | " + part() + "] ";
          break;
        case 1:
          text += "[" + gloss() + " " + gloss() + " | " + part() + "] ";
          break;
        case 2:
          text += gloss() + "{weak hold ..+1} " + gloss() + " ";
          break;
        case 3:
          text += gloss() + "{weak hold ..+4} " + gloss() + " " + gloss() + " . " + gloss() + " " + gloss() + " ";
          break;
        default:
          text += gloss() + " ";
      }
    }
    Texts expected;
    try {
      expected = notices_of_file(parse_utterance(text));
    } catch (const Error&) {  // its strokes cannot be signed together
      continue;
    }
    const Shown shown = shown_whole(text, {});
    EXPECT_EQ(notices_in(shown), expected) << "seed " << seed << ": " << text;
    codes.merge(codes_in(shown));
  }
  EXPECT_THAT(codes, testing::IsSupersetOf({"symmetry", "long_hold", "weak_drop"}));
}

/// RENNES, mirrored, with VANNES: two movements with different handshapes; both hands alternate in BROUILLARD.
constexpr const char* kRare = "[VANNES#1 | weak: RENNES#1] DEMAIN#1 [BROUILLARD#1 | weak: hold] MATIN#1";

TEST(PlayerNotices, ComeOnceInALoopAndAfterJumps) {
  const Texts expected = notices_of_file(parse_utterance(kRare));
  ASSERT_THAT(expected, UnorderedElementsAre(HasSubstr("symmetry: "), HasSubstr("weak_drop: ")));
  Player player(shared_cache(), {.loop = true});
  player.sign(parse_utterance(kRare));
  Shown shown;
  show(player, shown, 1'500);
  player.seek(Milliseconds(200));
  show(player, shown, 1'500);
  EXPECT_GT(shown.count(Kind::place), 12u);
  EXPECT_EQ(notices_in(shown), expected);
  player.sign(parse_utterance(kRare));  // another utterance
  shown.events.clear();
  show(player, shown, 1'500);
  EXPECT_EQ(notices_in(shown), expected);
}

TEST(PlayerNotices, ComeLaterIfAJumpPreventsThem) {
  const Texts expected = notices_of_file(parse_utterance(kRare));
  for (const std::size_t shown_before : {1u, 30u, 90u, 150u, 250u}) {
    Player player(shared_cache(), {.idle = Idle::end});
    player.sign(parse_utterance(kRare));
    Shown shown;
    show(player, shown, shown_before, 1);
    player.prepare(64);
    player.seek(Milliseconds(0));
    show(player, shown);
    EXPECT_EQ(notices_in(shown), expected) << shown_before;
  }
}

TEST(PlayerNotices, HaveAPlaceAndAMoment) {
  const Shown shown = shown_whole(kRare, {});
  const auto notice = std::ranges::find(shown.events, "weak_drop", &PlayerEvent::code);
  ASSERT_NE(notice, shown.events.end());
  const PlayerEvent& place = *(notice + 1);
  EXPECT_EQ(place.gloss, "BROUILLARD");
  EXPECT_EQ(place.place, notice->place);
  EXPECT_EQ(place.at, notice->at);
  EXPECT_EQ(place.frame, notice->frame);
}

TEST(PlayerNotices, AreErrorsOfAStrictStream) {
  shown_whole(kRare, {});  // its steps are cached
  for (const bool cached : {true, false}) {
    SharedSigningCache fresh(corpus());
    Player player(cached ? shared_cache() : fresh, {.synthesis = {.strict = true}, .idle = Idle::end});
    player.sign(parse_utterance(kRare));
    std::vector<std::string> refused;
    Shown shown;
    for (int faults = 0; faults < 5; ++faults) {
      try {
        show(player, shown);
        break;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        refused.emplace_back(error.what());
      }
    }
    EXPECT_THAT(refused, testing::ElementsAre(HasSubstr("(symmetry)"), HasSubstr("(weak_drop)")));
    EXPECT_THAT(notices_in(shown), IsEmpty());
    EXPECT_THAT(shown.tokens(), "DEMAIN#1 MATIN#1 ");
    EXPECT_TRUE(player.idle());
  }
}

}  // namespace
}  // namespace signweave::player_notices
