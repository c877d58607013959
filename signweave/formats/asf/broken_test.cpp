#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <set>
#include <string>

#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/formats/asf/asf.h"

namespace signweave::asf {
namespace {

namespace fs = std::filesystem;

const fs::path kTestdata = fs::path(SIGNWEAVE_SOURCE_DIR) / "testdata";
const fs::path kBroken = kTestdata / "asf_broken";

/// A pair of files with one name. If one of the two does not exist, the good one of testdata/asf is used instead.
struct Pair {
  fs::path asf, amc;
};
Pair pair_of(const std::string& name) {
  const auto or_good = [&](const char* extension) {
    const fs::path path = kBroken / (name + extension);
    return fs::exists(path) ? path : kTestdata / "asf" / (std::string("two") + extension);
  };
  return {or_good(".asf"), or_good(".amc")};
}

std::set<std::string> broken_names(bool expectations) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(kBroken)) {
    if ((entry.path().extension() == ".expected") == expectations) names.insert(entry.path().stem().string());
  }
  return names;
}

template <typename Read>
std::string fault_of_read(const Read& read_it) {
  try {
    read_it();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    return error.what();
  }
  return "no fault";
}

// x.expected next to x.asf and x.amc holds the message without the folder; a file without one fails here.
TEST(AsfBroken, EveryBrokenFileIsRefusedWithItsLineAndARepair) {
  const std::set<std::string> names = broken_names(false);
  ASSERT_GE(names.size(), 80u);
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const Pair pair = pair_of(name);
    const std::string fault = fault_of_read([&] { read(pair.amc, {.skeleton = pair.asf, .unit = 1.0}); });
    const std::string by_text = fault_of_read([&] {
      read_text(pair.asf.string(), read_file(pair.asf), pair.amc.string(), read_file(pair.amc), {.unit = 1.0});
    });
    EXPECT_EQ(fault, by_text);
    EXPECT_EQ(fault.find('\n'), std::string::npos);
    const std::string expected = read_file(kBroken / (name + ".expected"));
    EXPECT_EQ(fault, (kBroken / "").string() + std::string(trimmed(expected)));
  }
}

TEST(AsfBroken, EveryExpectationHasItsFile) {
  const std::set<std::string> files = broken_names(false);
  for (const std::string& name : broken_names(true)) EXPECT_TRUE(files.contains(name)) << name;
}

// A truncated skeleton must be refused, and must never crash or be accepted as complete, unless only blanks are lost.
TEST(AsfBroken, ATruncatedSkeletonIsRefused) {
  for (const char* name : {"two", "07"}) {
    const std::string asf = read_file(kTestdata / "asf" / (std::string(name) + ".asf"));
    const std::string amc = read_file(kTestdata / "asf" / (name == std::string("two") ? "two.amc" : "07_01.amc"));
    ASSERT_NO_THROW(read_text("whole", asf, "motion", amc));
    const std::size_t last_word = asf.find_last_not_of("\n ") + 1;
    for (std::size_t size = 0; size < last_word; ++size) {
      EXPECT_THROW(read_text("cut", std::string_view(asf).substr(0, size), "motion", amc), Error) << size;
    }
  }
}

// The format does not contain the number of frames, so only whole frames may be missing.
TEST(AsfBroken, AMotionCutWithinAFrameIsRefused) {
  const std::string asf = read_file(kTestdata / "asf" / "two.asf");
  const std::string amc = read_file(kTestdata / "asf" / "two.amc");
  const std::size_t second = amc.find("\n2\n") + 1;
  const std::size_t first_whole = amc.find("lower 90") + 7;  // 'lower 9' is a number too
  for (std::size_t size = 0; size < amc.find_last_of('0'); ++size) {
    const bool whole = size >= first_whole && size <= second;
    const std::string fault =
        fault_of_read([&] { read_text("a", asf, "cut", std::string_view(amc).substr(0, size), {.unit = 1.0}); });
    EXPECT_EQ(fault == "no fault", whole) << size << ": " << fault;
  }
}

// Tens of thousands of bones at rest and a frame of a few bytes: the file must not expand to gigabytes.
TEST(AsfBroken, FewNumbersForManyBonesAreRefusedBeforeAllocation) {
  std::string asf = ":root\norder TX\n:bonedata\n";
  std::string hierarchy = ":hierarchy\nbegin\n";
  for (int i = 0; i < 20'000; ++i) {
    const std::string name = "b" + std::to_string(i);
    asf += "begin\nname " + name + "\ndirection 0 1 0\nlength 1\nend\n";
    hierarchy += (i == 0 ? "root" : "b" + std::to_string(i - 1)) + " " + name + "\n";
  }
  asf += hierarchy + "end\n";
  std::string amc;
  for (int frame = 1; frame <= 1000; ++frame) amc += std::to_string(frame) + "\nroot 0\n";
  const std::string fault = fault_of_read([&] { read_text("a", asf, "b", amc, {.unit = 1.0}); });
  EXPECT_EQ(fault, "b:421: 20001 bones have only 1 dofs; leave out the bones that do not move");
}

TEST(AsfBroken, MoreBonesThanAMotionHoldsAreRefused) {
  std::string asf = ":root\norder TX\n:bonedata\n";
  for (int i = 0; i < 65'535; ++i) asf += "begin\nname b" + std::to_string(i) + "\ndirection 0 1 0\nlength 1\nend\n";
  const std::string fault = fault_of_read([&] { read_text("a", asf, "b", "1\nroot 0\n"); });
  EXPECT_EQ(fault, "a:327674: more than 65534 bones; split the skeleton");
}

// The guess examines each path from a head to a foot, and every bone here is named like both.
TEST(AsfBroken, ASkeletonOfThousandsOfBonesNeedsAUnit) {
  std::string asf = ":root\norder TX\n:bonedata\n";
  std::string hierarchy = ":hierarchy\nbegin\n";
  for (int i = 0; i < 5000; ++i) {
    const std::string name = "headfoot" + std::to_string(i);
    asf += "begin\nname " + name + "\ndirection 0 1 0\nlength 1\nend\n";
    hierarchy += (i == 0 ? "root" : "headfoot" + std::to_string(i - 1)) + " " + name + "\n";
  }
  asf += hierarchy + "end\n";
  EXPECT_EQ(fault_of_read([&] { read_text("a", asf, "b", "1\nroot 0\n"); }),
            "a: 5001 bones are no body whose unit can be guessed");
  EXPECT_EQ(read_text("a", asf, "b", "1\nroot 0\n", {.unit = 1.0}).motion.frame_count(), 1);
}

TEST(AsfBroken, AnInvalidUnitIsRefused) {
  for (const double unit : {0.0, -1.0, 1e7, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(read(kTestdata / "asf" / "two.amc", {.unit = unit}), Error) << unit;
  }
}

}  // namespace
}  // namespace signweave::asf
