#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include "signweave/annotation/sign.h"

namespace signweave {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using SignTier = TierNames::SignTier;

struct NewTier {
  std::string id;
  std::string parent = {};
  std::string type = {};
  std::vector<std::string> labels = {"MAISON"};
};

AnnotationDocument document_of(const std::vector<NewTier>& tiers) {
  AnnotationDocument document;
  document.types = {{"phase_lt", Stereotype::time_subdivision, ""}};
  for (const NewTier& from : tiers) {
    Tier& tier = document.tiers.emplace_back();
    tier.id = from.id;
    tier.parent = from.parent;
    tier.type = from.type;
    for (const std::string& label : from.labels)
      tier.annotations.push_back({.id = "", .label = label, .span = {}, .parent = ""});
  }
  return document;
}

struct Name {
  const char* id;
  Hand hand;
  const char* signer;
  friend void PrintTo(const Name& name, std::ostream* out) { *out << name.id; }
};

class SignTierNames : public testing::TestWithParam<Name> {};

TEST_P(SignTierNames, AreRecognisedInManyConventions) {
  const TierNames names = guess_tier_names(document_of({{"Translation"}, {GetParam().id}, {"Mouthing"}}));
  EXPECT_THAT(names.sign_tiers, ElementsAre(SignTier{GetParam().id, GetParam().hand, GetParam().signer}));
}

INSTANTIATE_TEST_SUITE_P(
    Guess, SignTierNames,
    testing::Values(Name{"Gloss", Hand::both, ""}, Name{"GLOSSES", Hand::both, ""}, Name{"Glose", Hand::both, ""},
                    Name{"Gloses", Hand::both, ""}, Name{"Signs", Hand::both, ""}, Name{"sign", Hand::both, ""},
                    Name{"ID-Gloss", Hand::both, ""}, Name{"Gloss RH", Hand::right, ""},
                    Name{"Gloss LH", Hand::left, ""}, Name{"RH-IDgloss", Hand::right, ""},
                    Name{"LHIDgloss", Hand::left, ""}, Name{"GlossR S1", Hand::right, "S1"},
                    Name{"GlossL S2", Hand::left, "S2"}, Name{"Lexem_Gloss_r", Hand::right, ""},
                    Name{"gloss@A", Hand::both, "A"}, Name{"gloss_l@Marie", Hand::left, "Marie"},
                    Name{"Lexeme_Sign_r_A", Hand::right, "A"}, Name{"Lexem_Gebärde_r_A", Hand::right, "A"},
                    Name{"Lexem_Geba\xCC\x88rde_l_B", Hand::left, "B"}, Name{"Glose main droite", Hand::right, ""},
                    Name{"Glose gauche", Hand::left, ""}, Name{"Gebärde rechts", Hand::right, ""},
                    Name{"Gebaar links", Hand::left, ""}, Name{"main gloss", Hand::both, ""}));

TEST(GuessTierNames, BothHandsAreFoundAndTheFullerComesFirst) {
  const TierNames names =
      guess_tier_names(document_of({{"Gloss LH", "", "", {"A"}}, {"Gloss RH", "", "", {"A", "B"}}}));
  EXPECT_THAT(names.sign_tiers,
              ElementsAre(SignTier{"Gloss RH", Hand::right, ""}, SignTier{"Gloss LH", Hand::left, ""}));
}

TEST(GuessTierNames, ATierAboutGlossesIsNotASignTier) {
  const TierNames names =
      guess_tier_names(document_of({{"Gloss"}, {"Gloss meaning"}, {"Gloss_comment"}, {"Sign language"}, {"Design"}}));
  EXPECT_THAT(names.sign_tiers, ElementsAre(SignTier{"Gloss", Hand::both, ""}));
}

TEST(GuessTierNames, AChildOfASignTierIsNotASignTier) {
  const TierNames names = guess_tier_names(document_of({{"Gloss FR", "Gloss"}, {"Gloss"}}));
  EXPECT_THAT(names.sign_tiers, ElementsAre(SignTier{"Gloss", Hand::both, ""}));
}

TEST(GuessTierNames, AParticipantNeedsNoSignerFromTheName) {
  AnnotationDocument document = document_of({{"gloss@A"}});
  document.tiers[0].participant = "Anna";
  EXPECT_THAT(guess_tier_names(document).sign_tiers, ElementsAre(SignTier{"gloss@A", Hand::both, ""}));
}

TEST(GuessTierNames, TheTiersTypeIsUsedIfItsNameSaysNothing) {
  const TierNames names = guess_tier_names(document_of({{"main droite", "", "gloss"}, {"Texte", "", "default-lt"}}));
  EXPECT_THAT(names.sign_tiers, ElementsAre(SignTier{"main droite", Hand::right, ""}));
}

TEST(GuessTierNames, PhaseTiersAreRecognisedByTheirLabels) {
  const TierNames names = guess_tier_names(document_of(
      {{"Gloss"}, {"Phase", "Gloss", "", {"prep", "stroke", "retr"}}, {"POS", "Gloss", "", {"N", "V", "S"}}}));
  EXPECT_THAT(names.phase_tiers, ElementsAre("Phase"));
}

TEST(GuessTierNames, AnEmptyTierCalledPhaseIsAPhaseTier) {
  const TierNames names = guess_tier_names(document_of({{"Gloss"}, {"Phases", "Gloss", "", {}}}));
  EXPECT_THAT(names.phase_tiers, ElementsAre("Phases"));
}

TEST(GuessTierNames, ThePairOfThePaperIsRecognisedByStructureAlone) {
  const TierNames names = guess_tier_names(
      document_of({{"gloss list"}, {"ligne 1"}, {"ligne 2", "ligne 1", "phase_lt", {"Préparation", "Stroke"}}}));
  EXPECT_THAT(names.sign_tiers,
              ElementsAre(SignTier{"ligne 1", Hand::both, ""}, SignTier{"gloss list", Hand::both, ""}));
  EXPECT_THAT(names.phase_tiers, ElementsAre("ligne 2"));
}

TEST(GuessTierNames, NothingIsGuessedIfNothingFits) {
  const TierNames names = guess_tier_names(document_of({{"default"},
                                                        {"TRIAL TYPE"},
                                                        {"TASK"},
                                                        {"EVENT", "", "", {"GRIP", "MOVEMENT"}},
                                                        {"gestures", "", "", {"hold", "stroke"}}}));
  EXPECT_THAT(names.sign_tiers, IsEmpty());
  EXPECT_THAT(names.phase_tiers, IsEmpty());
  EXPECT_THAT(guess_tier_names({}).sign_tiers, IsEmpty());
}

TEST(GuessTierNames, TierCyclesDoNotHang) {
  const TierNames names = guess_tier_names(document_of({{"Gloss", "B"}, {"B", "Gloss"}}));
  EXPECT_THAT(names.sign_tiers, IsEmpty());
}

}  // namespace
}  // namespace signweave
