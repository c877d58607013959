#include <gtest/gtest.h>

#include <algorithm>

#include "signweave/core/text.h"
#include "signweave/formats/eaf/test_support.h"

namespace signweave::eaf {
namespace {

using namespace testing_support;

/// Names without ".eaf".
std::vector<std::string> broken_eaf_files() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(testdata("eaf_broken"))) {
    if (entry.path().extension() == ".eaf") files.push_back(entry.path().stem().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

class BrokenEaf : public testing::TestWithParam<std::string> {};

/// The error without the file's folder; empty if there is none.
std::string eaf_error(const std::filesystem::path& path) {
  try {
    read(path, Unsound::refused);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), path.stem() == "time_units" ? ErrorCode::unsupported : ErrorCode::bad_input);
    const std::string text = error.what();
    const std::string folder = (path.parent_path() / "").string();
    return text.starts_with(folder) ? text.substr(folder.size()) : "no path: " + text;
  }
  return "was read";
}

TEST_P(BrokenEaf, IsRefusedWithOneClearLine) {
  const std::filesystem::path expected = testdata("eaf_broken") / (GetParam() + ".expected");
  ASSERT_TRUE(std::filesystem::exists(expected)) << "every broken file needs its .expected";
  EXPECT_EQ(eaf_error(testdata("eaf_broken") / (GetParam() + ".eaf")), trimmed(read_file(expected)));
}

INSTANTIATE_TEST_SUITE_P(Testdata, BrokenEaf, testing::ValuesIn(broken_eaf_files()),
                         [](const auto& one) { return one.param; });

TEST(BrokenEaf, NoExpectationIsWithoutItsFile) {
  std::size_t expectations = 0;
  for (const auto& entry : std::filesystem::directory_iterator(testdata("eaf_broken"))) {
    if (entry.path().extension() == ".expected") ++expectations;
  }
  EXPECT_EQ(expectations, broken_eaf_files().size());
  EXPECT_GE(expectations, 40U);
}

TEST(BrokenEaf, EveryPrefixOfAFileIsReadOrRefused) {
  const std::string whole = testfile("constraints.eaf");
  for (std::size_t size = 0; size + 2 < whole.size(); ++size) {
    EXPECT_THROW(read_text("cut.eaf", std::string_view(whole).substr(0, size)), Error) << size;
  }
}

TEST(BrokenEaf, VeryDeepNestingIsHarmless) {
  std::string text = "<ANNOTATION_DOCUMENT FORMAT=\"3.0\">";
  for (int i = 0; i < 100'000; ++i) text += "<TIER>";
  EXPECT_THROW(read_text("deep.eaf", text), Error);
  for (int i = 0; i < 100'000; ++i) text += "</TIER>";
  EXPECT_THROW(read_text("deep.eaf", text + "</ANNOTATION_DOCUMENT>"), Error);  // a tier without a name
  std::string harmless = "<ANNOTATION_DOCUMENT FORMAT=\"3.0\">";
  for (int i = 0; i < 100'000; ++i) harmless += "<X>";
  for (int i = 0; i < 100'000; ++i) harmless += "</X>";
  File file = read_text("deep.eaf", harmless + "</ANNOTATION_DOCUMENT>");
  file.document.author = "somebody";
  EXPECT_EQ(reread(file.document).author, "somebody");
}

TEST(BrokenEaf, AVeryLongChainOfTiersIsReadAndWritten) {
  constexpr int kCount = 20'000;
  std::string tiers;  // child first, so that every step goes up
  for (int i = kCount; i > 0; --i) {
    tiers += tier(fmt::format("t{}", i), i == 1 ? "root" : "fill", i == 1 ? "" : fmt::format("t{}", i - 1),
                  alignable(fmt::format("a{}", i), 1, 2));
  }
  File file = read_text("chain.eaf", document({0, 100}, tiers));
  EXPECT_EQ(file.document.tiers.front().annotations.at(0).parent, fmt::format("a{}", kCount - 1));
  file.document.source.clear();
  std::reverse(file.document.tiers.begin(), file.document.tiers.end());  // written parents first
  EXPECT_EQ(without_source(reread(file.document)).tiers, file.document.tiers);
}

TEST(BrokenEaf, AMissingFileIsNotFound) {
  try {
    read("/no/such/folder/x.eaf");
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_found);
  }
}

}  // namespace
}  // namespace signweave::eaf
