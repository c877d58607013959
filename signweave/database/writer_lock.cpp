#include "signweave/database/writer_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave {
namespace {

constexpr std::size_t kLongestLine = 500;

/// Returns the line in the lock file, or "another process".
std::string line_of(int file) {
  char text[kLongestLine];
  const ssize_t got = ::pread(file, text, sizeof text, 0);
  const std::string_view line(text, got > 0 ? static_cast<std::size_t>(got) : 0);
  const std::string who = printable(line.substr(0, line.find('\n')));
  return who.empty() ? "another process" : who;
}

}  // namespace

WriterLock::WriterLock(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "writer.lock";
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) {
    throw Error(ErrorCode::io,
                fmt::format("{}: cannot be opened for writing: {}", folder.string(), std::strerror(errno)));
  }
  if (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
    const std::string who = line_of(file_);
    ::close(file_);
    throw Error(ErrorCode::conflict,
                fmt::format("{}: is being changed by {}; try again when that one has ended", folder.string(), who));
  }
  announce({});
}

WriterLock::~WriterLock() {
  static_cast<void>(::ftruncate(file_, 0));
  ::close(file_);
}

void WriterLock::announce(std::string_view who) noexcept {
  try {
    const std::string line =
        who.empty() ? fmt::format("process {}\n", ::getpid())
                    : fmt::format("{} (process {})\n", printable(who.substr(0, kLongestLine / 4)), ::getpid());
    if (::ftruncate(file_, 0) == 0) static_cast<void>(::pwrite(file_, line.data(), line.size(), 0));
  } catch (const std::exception&) {  // a full disk must not prevent opening the database
  }
}

std::string writer_of(const std::filesystem::path& folder) {
  const int file = ::open((folder / "writer.lock").c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return {};
  std::string who;
  if (::flock(file, LOCK_SH | LOCK_NB) != 0) who = line_of(file);
  ::close(file);
  return who;
}

}  // namespace signweave
