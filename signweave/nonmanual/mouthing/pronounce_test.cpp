#include "signweave/nonmanual/mouthing/pronounce.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "signweave/nonmanual/mouthing/run_program.h"

namespace signweave {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
namespace fs = std::filesystem;

/// A folder with small programs, removed at the end.
class Programs : public testing::Test {
 protected:
  Programs() {
    std::string name = fs::temp_directory_path() / "signweave_pronounce_XXXXXX";
    folder_ = ::mkdtemp(name.data());
  }
  ~Programs() override { fs::remove_all(folder_); }

  fs::path program(const std::string& script) {
    const fs::path path = folder_ / "fake";
    std::ofstream(path) << "#!/bin/sh\n" << script << '\n';
    ::chmod(path.c_str(), 0755);
    return path;
  }
  std::string file(const char* name) const {
    std::ifstream in(folder_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  Pronouncer with(const fs::path& program, Milliseconds patience = 5000ms) const {
    return Pronouncer({.source = MouthingSource::espeak, .program = program, .patience = patience});
  }

  fs::path folder_;
};

bool waits(const std::string& id) {
  return ::kill(std::atoi(id.c_str()), 0) == 0;
}

TEST_F(Programs, ReceiveTheTextAsOneArgumentAndNoShellReadsIt) {
  Pronouncer pronouncer =
      with(program("for a in \"$@\"; do echo \"<$a>\"; done > " + (folder_ / "arguments").string() + "; echo pˈapa"));
  const std::string text = "-h $(touch " + (folder_ / "trap").string() + "); `id` 'x' [[p]]";
  const Pronunciation result = pronouncer.pronounce(text, "line 1");
  EXPECT_EQ(result.ipa, "pˈapa");
  EXPECT_THAT(result.phones, SizeIs(4));
  EXPECT_THAT(result.notices, IsEmpty());
  EXPECT_FALSE(fs::exists(folder_ / "trap"));
  const std::string dashes(2, '-');
  EXPECT_THAT(file("arguments"), HasSubstr("<-q>\n<" + dashes + "ipa=3>\n<-v>\n<fr>\n<" + dashes + ">\n<-h $(touch"));
  EXPECT_THAT(file("arguments"), testing::Not(HasSubstr("[[")));
}

TEST_F(Programs, ReceiveASmallEnvironmentAndNoOpenFile) {
  ::setenv("SIGNWEAVE_TEST_SECRET", "s3cret", 1);
  const int open = ::open("/dev/null", O_RDONLY);  // would be inherited
  const fs::path path = program("env; ls /proc/self/fd | tr '\\n' ' '");
  const ProgramResult result = run_program(path, {});
  ::close(open);
  ::unsetenv("SIGNWEAVE_TEST_SECRET");
  EXPECT_THAT(result.output, testing::Not(HasSubstr("s3cret")));
  EXPECT_THAT(result.output, HasSubstr("LC_ALL=C.UTF-8"));
  EXPECT_THAT(result.output, HasSubstr("0 1 2 3 "));  // 3 is the folder that ls reads
  EXPECT_THAT(result.output, testing::Not(HasSubstr(" 4 ")));
}

TEST_F(Programs, ThatHangAreKilledWithTheirChildren) {
  const fs::path path = program("sleep 60 & echo $! > " + (folder_ / "child").string() + "; wait");
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(run_program(path, {}, {.patience = 150ms}).end, ProgramResult::End::too_long);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 10s);
  const std::string child = file("child");
  for (int i = 0; i < 500 && waits(child); ++i) ::usleep(10'000);
  EXPECT_FALSE(child.empty() || waits(child)) << child;
}

TEST_F(Programs, ThatCloseTheirOutputAndHangAreKilled) {
  EXPECT_EQ(run_program(program("exec >&-; sleep 60"), {}, {.patience = 150ms}).end, ProgramResult::End::too_long);
}

TEST_F(Programs, ThatFloodAreKilled) {
  const ProgramResult result = run_program(program("while :; do echo aaaaaaaaaaaaaaaaaaaaaaaaaaaaa; done"), {},
                                           {.patience = 30'000ms, .most_bytes = 10'000});
  EXPECT_EQ(result.end, ProgramResult::End::too_much);
  EXPECT_LT(result.output.size(), 20'000U);
}

TEST_F(Programs, ThatFailGiveTheirStatus) {
  const ProgramResult result = run_program(program("exit 7"), {});
  EXPECT_EQ(result.end, ProgramResult::End::failed);
  EXPECT_EQ(result.status, 7);
  EXPECT_EQ(run_program(program("kill -9 $$"), {}).status, 9);
  EXPECT_EQ(run_program(program("exit 0"), {}).end, ProgramResult::End::finished);
}

TEST_F(Programs, AreRunOnceMoreOnlyIfTheyWorked) {
  const fs::path path = program("echo x >> " + (folder_ / "runs").string() + "; exit 1");
  Pronouncer pronouncer = with(path);
  const Pronunciation first = pronouncer.pronounce("papa", "line 1");
  const Pronunciation second = pronouncer.pronounce("papa", "line 2");
  ASSERT_THAT(first.notices, SizeIs(1));
  EXPECT_EQ(first.notices[0].where, "line 1");
  EXPECT_EQ(first.notices[0].text, path.string() + " failed with status 1; mouthings are read by letter rules");
  EXPECT_THAT(second.notices, IsEmpty());
  EXPECT_THAT(first.phones, SizeIs(4));
  EXPECT_EQ(first.phones, second.phones);
  EXPECT_EQ(file("runs"), "x\n");
}

TEST_F(Programs, ThatAreAbsentGiveOneNoticeAndLetters) {
  for (const char* missing : {"signweave-no-such-program", "/no/such/program", "/tmp"}) {
    Pronouncer pronouncer = with(missing);
    const Pronunciation result = pronouncer.pronounce("papa", "line 1");
    ASSERT_THAT(result.notices, SizeIs(1));
    EXPECT_EQ(result.notices[0].text,
              std::string("no program ") + missing + " found; mouthings are read by letter rules");
    EXPECT_THAT(result.phones, SizeIs(4));
    EXPECT_THAT(pronouncer.pronounce("papa", "line 2").notices, IsEmpty());
  }
}

TEST(FindProgram, LooksInThePathOnly) {
  EXPECT_TRUE(find_program("sh"));
  EXPECT_FALSE(find_program(""));
  EXPECT_FALSE(find_program("signweave-no-such-program"));
  EXPECT_EQ(find_program("/bin/sh"), fs::path("/bin/sh"));
}

TEST(Pronounce, RefusesALongTextInOneLine) {
  Pronouncer pronouncer;
  const auto fault = [&](const std::string& text) {
    try {
      pronouncer.pronounce(text, "utterance:1:7");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(fault(std::string(1 << 20, 'a')),
            "utterance:1:7: a mouthing of 1.0 MiB; at most 1000 characters can be mouthed");
  EXPECT_THAT(fault(std::string(1001, 'a')), HasSubstr("at most 1000"));
  EXPECT_EQ(fault(std::string(1000, 'a')), "no error");
  std::string accents;
  for (int i = 0; i < 1000; ++i) accents += "é";
  EXPECT_EQ(fault(accents), "no error");
  EXPECT_THAT(fault("a\xff"), HasSubstr("not UTF-8"));
}

TEST(Pronounce, GivesNothingForNothing) {
  Pronouncer letters;
  for (const char* text : {"", "  \n", "?!…"}) {
    EXPECT_THAT(letters.pronounce(text, "x").phones, IsEmpty()) << text;
    EXPECT_THAT(letters.pronounce(text, "x").notices, IsEmpty()) << text;
  }
  Pronouncer none({.source = MouthingSource::none});
  EXPECT_THAT(none.pronounce("papa", "x").phones, IsEmpty());
}

TEST(Pronounce, SaysWhichCharactersItSkips) {
  Pronouncer pronouncer;
  const Pronunciation result = pronouncer.pronounce("le 12 мая, le 2", "line 3");
  ASSERT_THAT(result.notices, SizeIs(1));
  EXPECT_EQ(result.notices[0].where, "line 3");
  EXPECT_THAT(result.notices[0].text, HasSubstr("do not read it: 12мая"));
  EXPECT_THAT(result.phones, SizeIs(4));
}

TEST(Syllables, BeginWithTheConsonantBeforeTheirVowel) {
  const auto begins = [](const char* ipa) { return syllables_of(phones_of_ipa(ipa)); };
  EXPECT_THAT(begins("papa"), ElementsAre(0, 2));
  EXPECT_THAT(begins("tɑ̃peʁatyʁ"), ElementsAre(0, 2, 4, 6));
  EXPECT_THAT(begins("matʁas"), ElementsAre(0, 2));  // ma-tras
  EXPECT_THAT(begins("paʁti"), ElementsAre(0, 3));   // par-ti
  EXPECT_THAT(begins("ne͡ɪʃən"), ElementsAre(0, 3));  // na-tion: the diphthong is one vowel
  EXPECT_THAT(begins("ʃ"), ElementsAre(0));
  EXPECT_THAT(begins(""), IsEmpty());
}

TEST(Names, AreReadBack) {
  for (const MouthingLanguage language : kMouthingLanguages) EXPECT_EQ(mouthing_language(name_of(language)), language);
  for (const char* name : {"letters", "espeak", "none"}) EXPECT_EQ(name_of(*mouthing_source(name)), name);
  for (std::size_t i = 0; i < kVisemeCount; ++i) {
    EXPECT_EQ(viseme_named(name_of(static_cast<Viseme>(i))), static_cast<Viseme>(i));
  }
  EXPECT_FALSE(mouthing_source("festival"));
  EXPECT_FALSE(mouthing_language("FR"));
  EXPECT_FALSE(viseme_named("u"));
}

}  // namespace
}  // namespace signweave
