#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "signweave/rig/rig_map.h"
#include "signweave/rig/test_rigs.h"

namespace signweave {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class File {
 public:
  explicit File(const std::string& text) {
    char name[] = "/tmp/signweave_rig_XXXXXX";
    const int handle = mkstemp(name);
    EXPECT_GE(handle, 0);
    close(handle);
    path_ = name;
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~File() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string failure(const std::string& text) {
  const File file(text);
  try {
    read_rig_names(file.path());
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    return error.what();
  }
  return "no error";
}

TEST(RigNames, AreReadFromLinesOfPartAndJoint) {
  const File file(
      "\xEF\xBB\xBF# a rig\r\nleft_hand = hand of the left\r\n\njaw =   # it has none\nchest=C#4 # trunk\n");
  const RigNames names = read_rig_names(file.path());
  EXPECT_EQ(names, (RigNames{{Part::left_hand, "hand of the left"}, {Part::jaw, ""}, {Part::chest, "C#4"}}));
}

TEST(RigNames, ReportsTheLineOfAnError) {
  EXPECT_THAT(failure("# one\nleft_hnad = a\n"),
              AllOf(HasSubstr(":2: unknown part \"left_hnad\""), HasSubstr("did you mean left_hand")));
  EXPECT_THAT(failure("jaw = a\njaw = b\n"), HasSubstr(":2: part \"jaw\" is given twice"));
  EXPECT_THAT(failure("jaw a\n"), HasSubstr(":1: expected `part = joint`"));
  EXPECT_THAT(failure(std::string("jaw\0=a\n", 7)), HasSubstr(":1: not a text file"));
}

TEST(RigNames, ReadsTheExampleOfTheDocument) {
  std::ifstream document(SIGNWEAVE_SOURCE_DIR "/docs/rig.md");
  const std::string text(std::istreambuf_iterator<char>(document), {});
  const std::string fence = "```rig\n";
  const std::size_t begin = text.find(fence);
  ASSERT_NE(begin, std::string::npos);
  const File file(text.substr(begin + fence.size(), text.find("```", begin + 3) - begin - fence.size()));
  const RigNames names = read_rig_names(file.path());
  EXPECT_EQ(names, (RigNames{{Part::left_hand, "wrist_a"},
                             {Part::right_hand, "wrist_b"},
                             {finger_part(Side::left, Finger::index, FingerPoint::proximal), "f1_a"},
                             {Part::jaw, ""}}));
}

TEST(RigNames, ReportsAMissingFile) {
  try {
    read_rig_names("/nowhere/rig.txt");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_found);
  }
}

std::string refusal(const Motion& motion, const RigNames& names) {
  try {
    map_rig(motion, names);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    return error.what();
  }
  return "no error";
}

TEST(RigNames, AreRefusedIfNoBodyFitsThem) {
  const Motion motion = rig_body(RigNaming{}, 2);
  const RigMap map = map_rig(motion);
  const auto joint = [&](Part part) { return motion.skeleton().joint(map[part].joint).name; };
  EXPECT_THAT(refusal(motion, {{Part::left_hand, joint(Part::left_hand)}, {Part::right_hand, joint(Part::left_hand)}}),
              HasSubstr("a joint plays one part"));
  EXPECT_THAT(
      refusal(motion, {{Part::left_hand, joint(Part::left_forearm)}, {Part::left_forearm, joint(Part::left_hand)}}),
      HasSubstr("is not beyond"));
  EXPECT_EQ(
      refusal(motion, {{Part::left_hand, joint(Part::left_hand)}, {Part::left_forearm, joint(Part::left_forearm)}}),
      "no error");
}

}  // namespace
}  // namespace signweave
