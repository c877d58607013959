#include <gtest/gtest.h>

#include "signweave/formats/eaf/test_support.h"

namespace signweave::eaf {
namespace {

using namespace testing_support;

TEST(EafWrite, WhatEafCannotHoldIsRefused) {
  const auto refusal = [](auto change) {
    AnnotationDocument document = constraints();
    change(document);
    try {
      write_text(document);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::bad_input);
      return std::string(error.what());
    }
    return std::string("was written");
  };
  using Document = AnnotationDocument;
  EXPECT_EQ(refusal([](Document& d) { annotation_of(d, "a1").label = std::string("bell \a"); }),
            "the label 'bell \\x07' has a control character, which XML cannot hold; remove it");
  EXPECT_EQ(refusal([](Document& d) { annotation_of(d, "a1").label = std::string("\xFF"); }),
            "the label '\xFF' has bytes that are not UTF-8; remove it");
  EXPECT_EQ(
      refusal([](Document& d) { std::erase_if(tier_of(d, "text").annotations, [](auto& a) { return a.id == "a1"; }); }),
      "tier 'words': annotation 'a10' has the parent 'a1', which is not on the parent tier; name one that is, or "
      "remove it too");
  EXPECT_EQ(refusal([](Document& d) { std::erase_if(d.tiers, [](auto& t) { return t.id == "text"; }); }),
            "tier 'words': has the parent 'text', which is not a tier; name one that is");
  EXPECT_EQ(refusal([](Document& d) { tier_of(d, "text").parent = std::string("words"); }),
            "tier 'words': is its own ancestor; give one of its parents another parent");
  EXPECT_EQ(refusal([](Document& d) { tier_of(d, "text").id = std::string("words"); }),
            "tier 'words': occurs twice; give one of them another name");
  EXPECT_EQ(refusal([](Document& d) { annotation_of(d, "a1").id = std::string("a2"); }),
            "tier 'text': annotation 'a2' occurs twice; give one of them another id");
  EXPECT_EQ(refusal([](Document& d) {
              annotation_of(d, "a1").span = {9ms, 8ms};
            }),
            "tier 'text': annotation 'a1' ends before it begins; swap its times");
  EXPECT_EQ(refusal([](Document& d) {
              annotation_of(d, "a1").span = {-1ms, 8ms};
            }),
            "tier 'text': annotation 'a1' lies outside 0 to 1000000000000 ms; move it");
  EXPECT_EQ(refusal([](Document& d) { annotation_of(d, "a20").parent.clear(); }),
            "tier 'letters': annotation 'a20' has no parent, from which it would take its time; give it one");
  EXPECT_EQ(refusal([](Document& d) { d.types.push_back(d.types[0]); }),
            "tier type 'text': occurs twice; give it an id of its own");
}

TEST(EafWrite, AFileIsWrittenAtomically) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "signweave_eaf_write_test.eaf";
  AnnotationDocument document = constraints();
  write(path, document);
  EXPECT_EQ(read_file(path), document.source);
  annotation_of(document, "a1").label = std::string("\a");
  EXPECT_THROW(write(path, document), Error);
  EXPECT_EQ(read_file(path), document.source);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace signweave::eaf
