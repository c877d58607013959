#include "signweave/database/sign_loci.h"

#include <gtest/gtest.h>

namespace signweave {
namespace {

Annotation over(Milliseconds begin, Milliseconds end, std::string label) {
  return {.id = {}, .label = std::move(label), .span = {begin, end}};
}

constexpr auto kFrom = static_cast<std::size_t>(LocusTier::from);
constexpr auto kTo = static_cast<std::size_t>(LocusTier::to);
constexpr auto kAt = static_cast<std::size_t>(LocusTier::at);

TEST(SignLoci, AreReadFromTiersOfTheirNames) {
  AnnotationDocument document;
  document.tiers = {{.id = "To", .annotations = {over(100ms, 500ms, "@left"), over(600ms, 900ms, "see notes!")}},
                    {.id = "FROM", .annotations = {over(100ms, 500ms, " self ")}},
                    {.id = "Towards", .annotations = {over(100ms, 500ms, "right")}},
                    {.id = "at", .annotations = {over(0ms, 90ms, "30/10/1.5")}}};
  const std::vector<AnnotatedLocus> loci = loci_in(document);
  ASSERT_EQ(loci.size(), 3u) << "what is no locus is left out";
  EXPECT_EQ(loci[0], (AnnotatedLocus{LocusTier::at, {0ms, 90ms}, read_locus("30/10/1.5")}));
  const auto sign = loci_over(loci, {120ms, 480ms});
  EXPECT_EQ(sign[kFrom], read_locus("self"));
  EXPECT_EQ(sign[kTo], read_locus("left"));
  EXPECT_FALSE(sign[kAt]);
}

TEST(SignLoci, AreThoseThatCoverMostOfASign) {
  const std::vector<AnnotatedLocus> loci = {{LocusTier::to, {0ms, 200ms}, read_locus("left")},
                                            {LocusTier::to, {200ms, 900ms}, read_locus("right")}};
  EXPECT_EQ(loci_over(loci, {150ms, 400ms})[kTo], read_locus("right"));
  EXPECT_EQ(loci_over(loci, {50ms, 250ms})[kTo], read_locus("left"));
  EXPECT_FALSE(loci_over(loci, {800ms, 1100ms})[kTo]) << "less than half of the sign";
  EXPECT_FALSE(loci_over({}, {0ms, 100ms})[kTo]);
}

}  // namespace
}  // namespace signweave
