#include "signweave/annotation/sign.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

namespace signweave {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Annotation annotation(std::string id, std::string label, int begin, int end, std::string parent = {}) {
  return {std::move(id), std::move(label), {Milliseconds(begin), Milliseconds(end)}, std::move(parent), true};
}

TimeSpan span(int begin, int end) {
  return {Milliseconds(begin), Milliseconds(end)};
}

Tier tier(std::string id, std::string parent, std::vector<Annotation> annotations) {
  Tier result;
  result.id = std::move(id);
  result.type = result.id;
  result.parent = std::move(parent);
  result.annotations = std::move(annotations);
  return result;
}

/// The paper's pair of tiers: one sign VANNES from 100 to 600 ms with these phases.
AnnotationDocument one_sign(std::vector<Annotation> phases) {
  for (Annotation& one : phases) one.parent = "a1";
  AnnotationDocument document;
  document.tiers = {tier("Gloss", "", {annotation("a1", "VANNES", 100, 600)}),
                    tier("Phase", "Gloss", std::move(phases))};
  return document;
}

TierNames gloss_and_phase() {
  return {.sign_tiers = {{"Gloss", Hand::right, ""}}, .phase_tiers = {"Phase"}, .phase_labels = {}};
}

std::vector<PhaseKind> kinds(const Sign& sign) {
  std::vector<PhaseKind> result;
  for (const Phase& phase : sign.phases) result.push_back(phase.kind);
  return result;
}

std::string only_notice(const SignsFound& found) {
  EXPECT_THAT(found.notices, SizeIs(1));
  return found.notices.size() == 1 ? found.notices[0].text : std::string();
}

TEST(SignsIn, PhasesBelongToTheirParentSign) {
  const AnnotationDocument document =
      one_sign({annotation("p1", "Préparation", 100, 200), annotation("p2", "Stroke", 200, 450),
                annotation("p3", "Rétraction", 450, 600)});
  const SignsFound found = signs_in(document, gloss_and_phase());
  EXPECT_THAT(found.notices, IsEmpty());
  ASSERT_THAT(found.signs, SizeIs(1));
  const Sign& sign = found.signs[0];
  EXPECT_EQ(sign.gloss, "VANNES");
  EXPECT_EQ(sign.hand, Hand::right);
  EXPECT_EQ(sign.tier, "Gloss");
  EXPECT_EQ(sign.annotation, "a1");
  EXPECT_FALSE(sign.inferred);
  EXPECT_THAT(kinds(sign), ElementsAre(PhaseKind::preparation, PhaseKind::stroke, PhaseKind::retraction));
  EXPECT_EQ(sign.phases[1], (Phase{PhaseKind::stroke, span(200, 450), "Stroke", "p2"}));
  EXPECT_EQ(sign.preparation_span(), span(100, 200));
  EXPECT_EQ(sign.stroke_span(), span(200, 450));
  EXPECT_EQ(sign.retraction_span(), span(450, 600));
}

TEST(SignsIn, PhasesMayBeGrandchildren) {
  AnnotationDocument document;
  document.tiers = {tier("Gloss", "", {annotation("a1", "A", 0, 100), annotation("a2", "B", 100, 200)}),
                    tier("Part", "Gloss", {annotation("m1", "x", 0, 100, "a1"), annotation("m2", "y", 100, 200, "a2")}),
                    tier("Phase", "Part",
                         {annotation("p1", "stroke", 0, 100, "m1"),
                          // a grandchild of the second sign
                          annotation("p2", "stroke", 100, 200, "m2")})};
  const SignsFound found = signs_in(document, gloss_and_phase());
  EXPECT_THAT(found.notices, IsEmpty());
  ASSERT_THAT(found.signs, SizeIs(2));
  EXPECT_EQ(found.signs[1].phases.at(0).annotation, "p2");
}

TEST(SignsIn, TheParentTakesPrecedenceOverTime) {
  AnnotationDocument document;
  document.tiers = {tier("Gloss", "", {annotation("a1", "A", 0, 100), annotation("a2", "B", 100, 200)}),
                    tier("Phase", "Gloss", {annotation("p1", "stroke", 0, 90, "a2")})};
  const SignsFound found = signs_in(document, gloss_and_phase());
  EXPECT_TRUE(found.signs.at(0).inferred);
  EXPECT_EQ(found.signs.at(1).phases.at(0).annotation, "p1");
  EXPECT_THAT(only_notice(found), HasSubstr("phase 'stroke' extends outside it"));
}

TEST(SignsIn, PhasesOfAnIndependentTierBelongToTheSignAroundThem) {
  AnnotationDocument document;
  document.tiers = {tier("Gloss", "", {annotation("a1", "A", 0, 100), annotation("a2", "B", 100, 200)}),
                    tier("Phase", "",
                         {annotation("p1", "stroke", 0, 100), annotation("p2", "prep", 100, 150),
                          annotation("p3", "stroke", 150, 200), annotation("p4", "stroke", 300, 400)})};
  const SignsFound found = signs_in(document, gloss_and_phase());
  EXPECT_THAT(kinds(found.signs.at(0)), ElementsAre(PhaseKind::stroke));
  EXPECT_THAT(kinds(found.signs.at(1)), ElementsAre(PhaseKind::preparation, PhaseKind::stroke));
  EXPECT_EQ(only_notice(found), "1 phases are in no sign, the first at 300 ms");
}

TEST(SignsIn, APhaseAcrossTwoSignsBelongsToTheOneWithTheLargerOverlap) {
  AnnotationDocument document;
  document.tiers = {tier("Gloss", "", {annotation("a1", "A", 0, 100), annotation("a2", "B", 100, 200)}),
                    tier("Phase", "", {annotation("p1", "stroke", 0, 80), annotation("p2", "stroke", 80, 200)})};
  const SignsFound found = signs_in(document, gloss_and_phase());
  EXPECT_EQ(found.signs.at(0).phases.size(), 1U);
  EXPECT_EQ(found.signs.at(1).phases.at(0).annotation, "p2");
  EXPECT_THAT(found.notices, SizeIs(2));
}

TEST(SignsIn, AHandInThePhaseTiersNameSelectsTheSignTier) {
  AnnotationDocument document;
  document.tiers = {tier("Gloss RH", "", {annotation("a1", "A", 0, 100)}),
                    tier("Gloss LH", "", {annotation("a2", "B", 0, 100)}),
                    tier("Phase LH", "", {annotation("p1", "stroke", 0, 100)}),
                    tier("Phase", "", {annotation("p2", "hold", 20, 30)})};
  TierNames names;
  names.sign_tiers = {{"Gloss RH", Hand::right, ""}, {"Gloss LH", Hand::left, ""}};
  names.phase_tiers = {"Phase LH"};
  const SignsFound found = signs_in(document, names);
  EXPECT_TRUE(found.signs.at(0).inferred);
  EXPECT_FALSE(found.signs.at(1).inferred);
  names.phase_tiers = {"Phase"};  // describes both hands
  const SignsFound both = signs_in(document, names);
  EXPECT_THAT(kinds(both.signs.at(0)), ElementsAre(PhaseKind::hold));
  EXPECT_THAT(kinds(both.signs.at(1)), ElementsAre(PhaseKind::hold));
}

TEST(SignsIn, ASignerInThePhaseTiersNameSelectsTheSignTier) {
  AnnotationDocument document;
  document.tiers = {tier("gloss@A", "", {annotation("a1", "A", 0, 100)}),
                    tier("gloss@B", "", {annotation("a2", "B", 0, 100)}),
                    tier("phase@B", "", {annotation("p1", "stroke", 0, 100)})};
  const SignsFound found =
      signs_in(document, {.sign_tiers = {{"gloss@A", Hand::both, "A"}, {"gloss@B", Hand::both, "B"}},
                          .phase_tiers = {"phase@B"},
                          .phase_labels = {}});
  EXPECT_TRUE(found.signs.at(0).inferred);
  EXPECT_FALSE(found.signs.at(1).inferred);
}

TEST(SignsIn, TheSignerIsTheGivenOneElseTheParticipant) {
  AnnotationDocument document;
  document.tiers = {tier("A", "", {annotation("a1", "X", 0, 9)}), tier("B", "", {annotation("a2", "Y", 0, 9)})};
  document.tiers[0].participant = document.tiers[1].participant = "Marie";
  TierNames names;
  names.sign_tiers = {{"A", Hand::both, ""}, {"B", Hand::both, "Paul"}};
  const SignsFound found = signs_in(document, names);
  EXPECT_EQ(found.signs.at(0).signer, "Marie");
  EXPECT_EQ(found.signs.at(1).signer, "Paul");
}

TEST(SignsIn, ASignWithoutPhasesIsOneInferredStroke) {
  const SignsFound found = signs_in(one_sign({}), gloss_and_phase());
  EXPECT_THAT(found.notices, IsEmpty());
  const Sign& sign = found.signs.at(0);
  EXPECT_TRUE(sign.inferred);
  EXPECT_THAT(sign.phases, ElementsAre(Phase{PhaseKind::stroke, span(100, 600), "", ""}));
  EXPECT_EQ(sign.stroke_span(), sign.span);
  EXPECT_EQ(sign.preparation_span(), span(100, 100));
  EXPECT_EQ(sign.retraction_span(), span(600, 600));
}

TEST(SignsIn, ASignWithPhasesButNoStrokeGetsNone) {
  const SignsFound found = signs_in(one_sign({annotation("p1", "prep", 100, 600)}), gloss_and_phase());
  const Sign& sign = found.signs.at(0);
  EXPECT_FALSE(sign.inferred);
  EXPECT_EQ(sign.stroke_span(), std::nullopt);
  EXPECT_EQ(sign.preparation_span(), span(100, 100));
  EXPECT_EQ(sign.retraction_span(), span(600, 600));
  EXPECT_THAT(only_notice(found), HasSubstr("no stroke"));
}

TEST(SignsIn, EmptyGlossesAreNotSignsAndTheirPhasesAreReported) {
  AnnotationDocument document = one_sign({annotation("p1", "stroke", 100, 600)});
  document.tiers[0].annotations[0].label = "  \n";
  const SignsFound found = signs_in(document, gloss_and_phase());
  EXPECT_THAT(found.signs, IsEmpty());
  EXPECT_EQ(only_notice(found), "1 phases belong to annotations without a gloss");
}

TEST(SignsIn, HoldsBetweenStrokesAreInsideTheStrokeSpanAndOthersAreNot) {
  const AnnotationDocument document =
      one_sign({annotation("p1", "hold", 100, 150), annotation("p2", "S", 150, 250), annotation("p3", "hold", 250, 300),
                annotation("p4", "S", 300, 400), annotation("p5", "hold", 400, 500), annotation("p6", "R", 500, 600)});
  const SignsFound found = signs_in(document, gloss_and_phase());
  EXPECT_THAT(found.notices, IsEmpty());
  const Sign& sign = found.signs.at(0);
  EXPECT_THAT(sign.phases, SizeIs(6));  // none dropped
  EXPECT_EQ(sign.stroke_span(), span(150, 400));
  EXPECT_EQ(sign.retraction_span(), span(400, 600));

  TierNames names = gloss_and_phase();
  names.phase_labels["hold"] = PhaseKind::stroke;
  EXPECT_EQ(signs_in(document, names).signs.at(0).stroke_span(), span(100, 500));
}

TEST(SignsIn, UnknownLabelsAreStoredAndReportedOnceEach) {
  const AnnotationDocument document =
      one_sign({annotation("p1", "stroke", 100, 300), annotation("p2", "wobble", 300, 400),
                annotation("p3", "wobble", 400, 500), annotation("p4", "", 500, 600)});
  const SignsFound found = signs_in(document, gloss_and_phase());
  EXPECT_THAT(kinds(found.signs.at(0)),
              ElementsAre(PhaseKind::stroke, PhaseKind::other, PhaseKind::other, PhaseKind::other));
  EXPECT_EQ(found.signs.at(0).phases[1].label, "wobble");
  ASSERT_THAT(found.notices, SizeIs(2));
  EXPECT_THAT(found.notices[0].text, HasSubstr("1 phases have the unknown label ''"));
  EXPECT_THAT(found.notices[1].text, HasSubstr("2 phases have the unknown label 'wobble'"));
}

struct Fault {
  const char* name;
  std::vector<Annotation> phases;
  const char* said;
  friend void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }
};

class SignsInFaults : public testing::TestWithParam<Fault> {};

TEST_P(SignsInFaults, AreReportedAndThePhasesStored) {
  const SignsFound found = signs_in(one_sign(GetParam().phases), gloss_and_phase());
  EXPECT_THAT(found.signs.at(0).phases, SizeIs(GetParam().phases.size()));
  EXPECT_EQ(only_notice(found),
            std::string("sign 'VANNES' at 100 ms is not filled by its phases in order: ") + GetParam().said);
  EXPECT_EQ(found.notices.at(0).where, "Gloss");
}

INSTANTIATE_TEST_SUITE_P(
    Sign, SignsInFaults,
    testing::Values(Fault{"GapBefore", {annotation("p", "S", 130, 600)}, "a gap of 30 ms at 100 ms"},
                    Fault{"GapBetween",
                          {annotation("p", "P", 100, 200), annotation("q", "S", 220, 600)},
                          "a gap of 20 ms at 200 ms"},
                    Fault{"GapAfter", {annotation("p", "S", 100, 590)}, "a gap of 10 ms at 590 ms"},
                    Fault{"Overlap",
                          {annotation("p", "P", 100, 200), annotation("q", "S", 150, 600)},
                          "phase 'S' overlaps the previous one by 50 ms"},
                    Fault{"Outside", {annotation("p", "S", 100, 640)}, "phase 'S' extends outside it"},
                    Fault{"RetractionBeforeStroke",
                          {annotation("p", "R", 100, 200), annotation("q", "S", 200, 600)},
                          "stroke 'S' comes after a retraction"},
                    Fault{"PreparationAfterStroke",
                          {annotation("p", "S", 100, 200), annotation("q", "P", 200, 600)},
                          "preparation 'P' comes after a stroke"}),
    [](const auto& one) { return one.param.name; });

TEST(SignsIn, AMissingTierIsReportedWithNearMatches) {
  TierNames names;
  names.sign_tiers = {{"Glos", Hand::both, ""}};
  try {
    signs_in(one_sign({}), names);
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_found);
    EXPECT_STREQ(error.what(), "the annotation has no tier 'Glos'; name one that it has; did you mean Gloss?");
  }
  names = gloss_and_phase();
  names.phase_tiers = {"Phases"};
  EXPECT_THROW(signs_in(one_sign({}), names), Error);
}

TEST(SignsIn, ATierNamedTwiceGivesItsSignsOnce) {
  TierNames names = gloss_and_phase();
  names.sign_tiers.push_back(names.sign_tiers[0]);
  names.phase_tiers.push_back("Phase");
  const SignsFound found = signs_in(one_sign({annotation("p1", "S", 100, 600)}), names);
  EXPECT_THAT(found.signs, SizeIs(1));
  EXPECT_THAT(found.signs.at(0).phases, SizeIs(1));
}

TEST(SignsIn, TierCyclesDoNotHang) {
  AnnotationDocument document = one_sign({});
  document.tiers.push_back(tier("X", "Y", {annotation("x", "S", 100, 600, "y")}));
  document.tiers.push_back(tier("Y", "X", {annotation("y", "S", 100, 600, "x")}));
  TierNames names = gloss_and_phase();
  names.phase_tiers = {"X"};
  EXPECT_EQ(signs_in(document, names).signs.at(0).phases.at(0).annotation, "x");
}

TEST(PhaseKindOf, KnowsTheWordsOfSeveralLanguages) {
  for (const char* label : {"Preparation", "prep", "P", "Préparation", "PRÉPARATION", "Vorbereitung", "voorb",
                            "Preparação", " prep. ", "Pre\xCC\x81paration"}) {
    EXPECT_EQ(phase_kind_of(label, {}), PhaseKind::preparation) << label;
  }
  for (const char* label : {"Stroke", "S", "stroke 2", "Stroke_1", "coup", "slag", "núcleo"}) {
    EXPECT_EQ(phase_kind_of(label, {}), PhaseKind::stroke) << label;
  }
  for (const char* label : {"Retraction", "retr.", "R", "Rétraction", "Rückzug", "retractie", "Retração", "rest"}) {
    EXPECT_EQ(phase_kind_of(label, {}), PhaseKind::retraction) << label;
  }
  for (const char* label : {"Hold", "post-stroke hold", "tenue", "vasthouden"}) {
    EXPECT_EQ(phase_kind_of(label, {}), PhaseKind::hold) << label;
  }
  for (const char* label : {"", "?", "wobble", "strokelike", "7"}) {
    EXPECT_EQ(phase_kind_of(label, {}), PhaseKind::other) << label;
  }
}

TEST(PhaseKindOf, TheUsersMappingTakesPrecedence) {
  TierNames names;
  names.phase_labels = {{"s", PhaseKind::hold}, {"élan", PhaseKind::preparation}};
  EXPECT_EQ(phase_kind_of("S", names), PhaseKind::hold);
  EXPECT_EQ(phase_kind_of(" Élan ", names), PhaseKind::preparation);
  EXPECT_EQ(phase_kind_of("P", names), PhaseKind::preparation);
}

}  // namespace
}  // namespace signweave
