#include "app/server/static_files.h"

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

#include "app/server/http_target.h"
#include "signweave/kv/test_folder.h"

namespace signweave::server {
namespace {

/// The folder "served" with its files, next to files that must not be accessible.
struct Tree {
  Tree() {
    namespace fs = std::filesystem;
    fs::create_directories(root / "sub");
    fs::create_directories(root / ".hidden");
    write(folder / "secret.txt", "secret");
    write(root / "index.html", "<p>hello");
    write(root / "sub" / "index.html", "<p>sub");
    write(root / "a b.js", "1");
    write(root / ".env", "secret");
    write(root / ".hidden" / "x.txt", "secret");
    fs::create_symlink("../secret.txt", root / "out.txt");
    fs::create_symlink(folder / "secret.txt", root / "absolute.txt");
    fs::create_directory_symlink("..", root / "up");
    fs::create_directory_symlink("/", root / "slash");
    fs::create_symlink("index.html", root / "inside.html");
    fs::create_symlink("/proc/self/environ", root / "environ.txt");
  }
  static void write(const std::filesystem::path& path, std::string_view text) { std::ofstream(path) << text; }

  kv::TestFolder folder;
  std::filesystem::path root = folder / "served";
};

std::string read(const std::filesystem::path& root, std::string_view target,
                 FollowedLinks links = FollowedLinks::inside) {
  const auto parsed = parse_target(target);
  if (!parsed) return "(no target)";
  const auto file = open_static(root, parsed->path, links);
  if (!file) return "(none)";
  std::string text(file->size, '\0');
  EXPECT_EQ(::read(file->descriptor, text.data(), text.size()), static_cast<ssize_t>(file->size));
  ::close(file->descriptor);
  return text;
}

TEST(StaticFiles, AreThoseOfTheFolder) {
  const Tree tree;
  for (const FollowedLinks links : {FollowedLinks::inside, FollowedLinks::none}) {
    EXPECT_EQ(read(tree.root, "/", links), "<p>hello");
    EXPECT_EQ(read(tree.root, "/index.html", links), "<p>hello");
    EXPECT_EQ(read(tree.root, "/sub/", links), "<p>sub");
    EXPECT_EQ(read(tree.root, "/sub", links), "<p>sub");
    EXPECT_EQ(read(tree.root, "/a%20b.js", links), "1");
  }
}

TEST(StaticFiles, ALinkInsideIsFollowedIfTheKernelCanVerifyIt) {
  const Tree tree;
  const bool can = ::syscall(SYS_openat2, -1, "", nullptr, 0) == 0 || errno != ENOSYS;
  EXPECT_EQ(read(tree.root, "/inside.html"), can ? "<p>hello" : "(none)");
  EXPECT_EQ(read(tree.root, "/inside.html", FollowedLinks::none), "(none)");
}

TEST(StaticFiles, NoPathLeadsOutside) {
  const Tree tree;
  for (const char* path : {"/../secret.txt",
                           "/%2e%2e/secret.txt",
                           "/%2E%2e/secret.txt",
                           "/..%2fsecret.txt",
                           "/sub/../../secret.txt",
                           "/sub/..%5c..%5csecret.txt",
                           "/out.txt",
                           "/absolute.txt",
                           "/up/secret.txt",
                           "/slash/etc/passwd",
                           "/environ.txt",
                           "//etc/passwd",
                           "/.env",
                           "/.hidden/x.txt",
                           "/sub/.",
                           "/./index.html",
                           "/index.html/",
                           "/index.html/x",
                           "/index.html%00.txt",
                           "/no such file",
                           "/sub/no",
                           "/%c0%ae%c0%ae/secret.txt"}) {
    for (const FollowedLinks links : {FollowedLinks::inside, FollowedLinks::none}) {
      const std::string text = read(tree.root, path, links);
      EXPECT_TRUE(text == "(none)" || text == "(no target)") << path << ": " << text;
    }
  }
}

TEST(StaticFiles, AChangeHasAnotherTag) {
  const Tree tree;
  const auto tag = [&] {
    const auto file = open_static(tree.root, {"index.html"});
    ::close(file->descriptor);
    return file->etag;
  };
  const std::string before = tag();
  EXPECT_EQ(tag(), before);
  Tree::write(tree.root / "index.html", "<p>longer than it was");
  EXPECT_NE(tag(), before);
  EXPECT_EQ(open_static(tree.root, {"a b.js"})->content_type, "text/javascript; charset=utf-8");
  EXPECT_EQ(http_date(784'111'777), "Sun, 06 Nov 1994 08:49:37 GMT");
}

TEST(StaticFiles, RangesFollowTheStandard) {
  const auto range = [](std::string_view header) { return range_of(header, 100); };
  const auto is = [&](std::string_view header, std::uint64_t begin, std::uint64_t end) {
    const auto found = range(header);
    return found && found->begin == begin && found->end == end;
  };
  EXPECT_TRUE(is("bytes=0-9", 0, 10));
  EXPECT_TRUE(is("bytes=90-", 90, 100));
  EXPECT_TRUE(is("bytes=90-1000", 90, 100));
  EXPECT_TRUE(is("bytes=-10", 90, 100));
  EXPECT_TRUE(is("bytes=-1000", 0, 100));
  EXPECT_TRUE(is("bytes=100-", 0, 0)) << "beyond the end";
  EXPECT_TRUE(is("bytes=-0", 0, 0));
  for (const char* unheard : {"", "bytes", "bytes=", "bytes=-", "bytes=9-1", "bytes=a-b", "lines=0-9", "bytes=0-1,5-6",
                              "bytes=99999999999999999999-", "bytes=1 -2"}) {
    EXPECT_FALSE(range(unheard)) << unheard;
  }
  EXPECT_TRUE(range_of("bytes=-5", 0)->end == 0) << "of nothing";
}

}  // namespace
}  // namespace signweave::server
