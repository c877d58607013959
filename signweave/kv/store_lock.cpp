#include "signweave/kv/store_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "signweave/kv/fault.h"

namespace signweave::kv {

namespace {

// Equal lengths, so that a full disk cannot prevent the change.
constexpr std::string_view kOpen = "open  \n";
constexpr std::string_view kClosed = "closed\n";

bool refused(int error) {
  return error == EACCES || error == EPERM || error == EROFS;
}

}  // namespace

StoreLock::StoreLock(const std::filesystem::path& folder, Access access) : folder_(folder) {
  const std::filesystem::path path = folder / "engine.lock";
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0664);
  if (file_ < 0 && access == Access::read_only && refused(errno)) {
    file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file_ < 0 && errno == ENOENT) {
      fail(folder_, "opening the store",
           {ErrorCode::io,
            "engine.lock is missing, and the folder is not writable; open it once with write permission"});
    }
  }
  if (file_ < 0) fail_system(folder_, "opening the store", errno);
  try {
    take(access == Access::read_write ? F_WRLCK : F_RDLCK);
  } catch (...) {
    ::close(file_);
    throw;
  }
}

StoreLock::~StoreLock() {
  ::close(file_);
}

void StoreLock::take(short kind) const {
  struct flock request {};
  request.l_type = kind;
  request.l_whence = SEEK_SET;
  if (::fcntl(file_, F_OFD_SETLK, &request) == 0) return;
  if (errno == EBADF)
    fail_system(folder_, "opening the store for writing", EACCES);  // opened read-only: no write permission
  if (errno != EAGAIN && errno != EACCES) fail_system(folder_, "opening the store", errno);
  fail(folder_, "opening the store",
       {ErrorCode::conflict,
        "another process has it open, and this engine serves one process that writes or several that only read; try "
        "again when it has finished"});
}

void StoreLock::make_exclusive() {
  take(F_WRLCK);
}

void StoreLock::make_shared() noexcept {
  struct flock request {};
  request.l_type = F_RDLCK;
  request.l_whence = SEEK_SET;
  ::fcntl(file_, F_OFD_SETLK, &request);
}

void StoreLock::release() noexcept {
  struct flock request {};
  request.l_type = F_UNLCK;
  request.l_whence = SEEK_SET;
  ::fcntl(file_, F_OFD_SETLK, &request);
}

bool StoreLock::closed_in_order() const noexcept {
  char line[kClosed.size()] = {};
  const ssize_t got = ::pread(file_, line, sizeof line, 0);
  return got == static_cast<ssize_t>(sizeof line) && std::string_view(line, sizeof line) == kClosed;
}

void StoreLock::mark(bool closed) {
  const std::string_view line = closed ? kClosed : kOpen;
  if (::pwrite(file_, line.data(), line.size(), 0) != static_cast<ssize_t>(line.size()) || ::fdatasync(file_) != 0) {
    fail_system(folder_, "marking the store as open or closed", errno);
  }
}

}  // namespace signweave::kv
