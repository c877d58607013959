#include "signweave/space/roles.h"

#include <gtest/gtest.h>

#include "signweave/core/error.h"
#include "signweave/space/locus_pattern.h"

namespace signweave {
namespace {

std::string role_fault(const std::string& text) {
  try {
    read_space_roles_text("roles.csv", text);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

std::string pattern_fault(const std::string& pattern) {
  try {
    locus_pattern(pattern);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(SpaceRoles, AreReadFromATable) {
  const SpaceRoles roles = read_space_roles_text(
      "roles.csv",
      "\xEF\xBB\xBFGloss,Role\n# verbs\nINVITER,backward\r\n\n DONNER , Forward\n\"A, B\",aim\n\"SAY \"\"A\"\"\",both\n"
      "E\xCC\x81T\xC3\x89,none\n");
  EXPECT_EQ(roles.size(), 5U);
  EXPECT_EQ(role_of(roles, "INVITER"), SpaceRole::backward);
  EXPECT_EQ(role_of(roles, " DONNER "), SpaceRole::forward);
  EXPECT_EQ(role_of(roles, "A, B"), SpaceRole::aim);
  EXPECT_EQ(role_of(roles, "SAY \"A\""), SpaceRole::both);
  EXPECT_EQ(role_of(roles, "\xC3\x89TE\xCC\x81"), SpaceRole::none) << "in NFC";
  EXPECT_FALSE(role_of(roles, "inviter"));
}

TEST(SpaceRoles, FaultsNameTheLineAndTheMend) {
  EXPECT_EQ(role_fault("A,forward\nB"), "roles.csv:2: expected GLOSS,ROLE, such as INVITER,backward; found 'B'");
  for (const char* line : {"A,B,forward", "\"A,forward", "\"A\"B,forward", "A\"B,forward"}) {
    EXPECT_NE(role_fault(line).find("roles.csv:1: expected GLOSS,ROLE"), std::string::npos) << line;
  }
  EXPECT_EQ(role_fault("A,foward"), "roles.csv:1: no role 'foward'; did you mean forward?");
  EXPECT_EQ(role_fault("A,"), "roles.csv:1: no role ''; give none, forward, backward, aim or both");
  EXPECT_EQ(role_fault("\xC3\x89,aim\n# x\nE\xCC\x81,both"),
            "roles.csv:3: '\xC3\x89' is in line 1 already; keep one of them");
  EXPECT_EQ(role_fault(" ,aim"), "roles.csv:1: the first field has 0 bytes; give one of 1 to 1000");
  EXPECT_EQ(role_fault(std::string(1'001, 'A') + ",aim"),
            "roles.csv:1: the first field has 1001 bytes; give one of 1 to 1000");
  EXPECT_EQ(role_fault("A\xFF,aim"), "roles.csv:1: the line is not UTF-8; save the file as UTF-8");
  EXPECT_EQ(role_fault("A,aim\nGLOSS,ROLE"), "roles.csv:2: no role 'ROLE'; give none, forward, backward, aim or both");
}

TEST(SpaceRoles, AreLimitedInNumber) {
  std::string text;
  for (std::size_t i = 0; i <= kMostSpaceRoles; ++i) text += std::to_string(i) + ",aim\n";
  EXPECT_EQ(role_fault(text), "roles.csv:20001: more than 20000 rows; remove some");
}

TEST(LocusWords, AreTheUsualOnesAndThoseOfATable) {
  const LocusWords words = read_locus_words_text("words.csv", "word,locus\n3A,right\nz,@30/10\np,\"0.3,0.1,0.8\"\n");
  EXPECT_EQ(words.at("3a"), read_locus("right"));
  EXPECT_EQ(words.at("z"), read_locus("30/10"));
  EXPECT_EQ(words.at("p"), read_locus("0.3,0.1,0.8"));
  EXPECT_EQ(words.at("1"), read_locus("self"));
  EXPECT_THROW(read_locus_words_text("words.csv", "z,200"), Error);
  EXPECT_THROW(read_locus_words_text("words.csv", "z,left\nZ,right"), Error);
}

std::optional<GlossLoci> usual_loci(std::string_view gloss) {
  static const std::vector<LocusPattern> patterns = [] {
    std::vector<LocusPattern> usual;
    for (const std::string_view pattern : usual_locus_patterns()) usual.push_back(locus_pattern(pattern));
    return usual;
  }();
  return loci_of(gloss, patterns, usual_locus_words());
}

TEST(LocusPattern, ReadsTheConventionsOfCorpora) {
  const auto loci = [](const char* gloss, const char* from, const char* to, const char* at) {
    const auto locus = [](const char* text) { return *text == 0 ? std::nullopt : std::optional(read_locus(text)); };
    return GlossLoci{gloss, locus(from), locus(to), locus(at)};
  };
  EXPECT_EQ(usual_loci("GIVE-1-i"), loci("GIVE", "self", "i", ""));
  EXPECT_EQ(usual_loci("GIVE-BACK-1-2"), loci("GIVE-BACK", "self", "addressee", ""));
  EXPECT_EQ(usual_loci("1GIVE2"), loci("GIVE", "self", "addressee", ""));
  EXPECT_EQ(usual_loci("3aGIVE3b"), loci("GIVE", "left", "right", ""));
  EXPECT_EQ(usual_loci("INDEX_left"), loci("INDEX", "", "", "left"));
  EXPECT_EQ(usual_loci("IX-3a"), loci("IX", "", "", "left"));
  for (const char* plain : {"GIVE", "FAX-ON", "FAX-ON-NOW", "GIVE-1-NOW", "INDEX_x", "A1", "1A", "", "IX-"}) {
    EXPECT_FALSE(usual_loci(plain)) << plain;
  }
}

TEST(LocusPattern, IsTheUsersOwn) {
  const std::vector<LocusPattern> patterns = {locus_pattern("(?P<gloss>\xC3\x89.*)=(?<to>\\w+)(?:/(?<from>\\w+))?")};
  const auto read = loci_of(
      "E\xCC\x81"
      "A=LEFT",
      patterns, usual_locus_words());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->gloss,
            "\xC3\x89"
            "A");
  EXPECT_EQ(read->to, read_locus("left"));
  EXPECT_FALSE(read->from);
  const std::vector<LocusPattern> bracket = {locus_pattern(R"(\(?<(?<to>.*))")};
  EXPECT_TRUE(loci_of("(<1", bracket, usual_locus_words())) << "a bracket that is escaped begins no group";
  const std::vector<LocusPattern> whole = {locus_pattern("PT:(?<at>.*)")};
  EXPECT_EQ(loci_of("PT:1", whole, usual_locus_words())->gloss, "PT:1") << "without a group for it";
}

TEST(LocusPattern, FaultsSayWhatIsWrong) {
  EXPECT_EQ(pattern_fault("(?<to>a"), "the pattern '(?<to>a' of loci: missing ): (?P<to>a");
  EXPECT_EQ(pattern_fault("(?<form>a)"),
            "the pattern '(?<form>a)' of loci: no group 'form'; the groups are gloss, from, to and at");
  EXPECT_EQ(pattern_fault("a(b)"),
            "the pattern 'a(b)' of loci: it captures no locus; name a group (?<from>…), (?<to>…) or (?<at>…)");
  EXPECT_EQ(pattern_fault("\\(?<to>a"),
            "the pattern '\\(?<to>a' of loci: it captures no locus; name a group "
            "(?<from>…), (?<to>…) or (?<at>…)");
  EXPECT_NE(pattern_fault(std::string(1'001, 'a')).find("it has 1001 bytes"), std::string::npos);
  std::string groups = "(?<to>a)";
  for (int i = 0; i < 32; ++i) groups += "(b)";
  EXPECT_NE(pattern_fault(groups).find("more than 32 groups"), std::string::npos);
  EXPECT_NE(pattern_fault("(?<to>((a{100}){100}){100})").find("of loci: "), std::string::npos);
}

}  // namespace
}  // namespace signweave
