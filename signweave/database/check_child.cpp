#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <functional>
#include <optional>

#include "signweave/core/bytes.h"
#include "signweave/database/check.h"
#include "signweave/database/check_listener.h"

namespace signweave {
namespace {

// The child reports its findings in messages: u8 kind, u32 number, text (u32 length, bytes).
enum class Message : std::uint8_t {
  begin,    ///< number: recordings
  slot,     ///< number, name: the recording that is checked next
  alive,    ///< the check is still running
  usage,    ///< text: kind (a text), u64 entries, u64 bytes
  fault,    ///< text
  refused,  ///< number: code of the Error that the child threw; text: its message
  done,
};

constexpr int kPatience = 120'000;  // milliseconds without a message: damaged pages may form an endless loop

void write_all(int pipe, ByteSpan bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(pipe, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) ::_exit(1);  // the parent has closed the pipe
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

class PipeListener : public CheckListener {
 public:
  explicit PipeListener(int pipe) : pipe_(pipe) {}

  void begin(std::uint32_t recordings) override { send(Message::begin, recordings, {}); }
  void slot(std::uint32_t number, const std::string& name) override { send(Message::slot, number, name); }
  void alive() override { send(Message::alive, 0, {}); }
  void fault(const std::string& text) override { send(Message::fault, 0, text); }
  void send(Message kind, std::uint32_t number, std::string_view text) const {
    ByteWriter out;
    out.number(kind);
    out.number(number);
    out.text(text);
    write_all(pipe_, out.bytes());
  }

 private:
  int pipe_;
};

/// The work of a child: it reads the database and reports to the listener.
using Task = std::function<void(const Database& database, PipeListener& listener)>;

[[noreturn]] void run_child(const std::filesystem::path& folder, const Task& task, int pipe) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGILL}) ::signal(signal, SIG_DFL);
  PipeListener listener(pipe);
  try {
    const Database database(folder, kv::Access::read_only);
    task(database, listener);
    listener.send(Message::done, 0, {});
  } catch (const Error& error) {
    listener.send(Message::refused, static_cast<std::uint32_t>(error.code()), error.what());
  } catch (const std::exception& error) {
    listener.fault(fmt::format("{}: {}", folder.string(), error.what()));
    listener.send(Message::done, 0, {});
  }
  ::_exit(0);  // skips destructors, which could read memory that damaged pages corrupted
}

/// The report of one child.
struct Reported {
  bool ended_well = false;
  std::uint32_t recordings = 0;
  std::optional<std::uint32_t> slot;  ///< the last recording whose check began
  std::string name;
  std::vector<std::string> faults;
  std::vector<Usage> usage;
  std::string death;  ///< how the child ended, if not well
};

/// Reads messages until the pipe ends; false if the child sent none for kPatience.
bool listen(int pipe, Reported& reported, const Database::Progress& progress) {
  Bytes bytes;
  for (;;) {
    pollfd ready{.fd = pipe, .events = POLLIN, .revents = 0};
    const int count = ::poll(&ready, 1, kPatience);
    if (count < 0 && errno == EINTR) continue;
    if (count == 0) return false;
    std::byte part[4096];
    const ssize_t got = ::read(pipe, part, sizeof part);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return true;
    bytes.insert(bytes.end(), part, part + got);
    for (;;) {
      constexpr std::size_t kHead = 9;
      if (bytes.size() < kHead) break;
      std::uint32_t length = 0;
      std::memcpy(&length, bytes.data() + 5, sizeof length);
      if (bytes.size() < kHead + length) break;
      ByteReader in(ByteSpan(bytes).first(kHead + length), "check");
      const auto kind = in.number<Message>();
      const auto number = in.number<std::uint32_t>();
      const std::string text = in.text();
      bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(kHead + length));
      switch (kind) {
        case Message::begin:
          reported.recordings = number;
          break;
        case Message::slot:
          reported.slot = number;
          reported.name = text;
          if (progress) progress(static_cast<double>(number) / reported.recordings);
          break;
        case Message::alive:
          break;
        case Message::usage: {
          ByteReader one(bytes_of(text), "usage");
          std::string what = one.text();
          const auto entries = one.number<std::uint64_t>();
          reported.usage.push_back({std::move(what), entries, one.number<std::uint64_t>()});
          break;
        }
        case Message::fault:
          reported.faults.push_back(text);
          break;
        case Message::refused:
          throw Error(static_cast<ErrorCode>(number), text);
        case Message::done:
          reported.ended_well = true;
          break;
      }
    }
  }
}

Reported ask_child(const std::filesystem::path& folder, const Task& task, const Database::Progress& progress) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    throw Error(ErrorCode::io,
                fmt::format("{}: cannot make a pipe to a checking process: {}; close some files and try again",
                            folder.string(), std::strerror(errno)));
  }
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    run_child(folder, task, ends[1]);
  }
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    throw Error(ErrorCode::io, fmt::format("{}: cannot start a checking process: {}; end some processes and try again",
                                           folder.string(), std::strerror(errno)));
  }
  struct Reaped {
    pid_t child;
    int pipe;
    int status = 0;
    bool over = false;
    void wait() {
      while (!over && ::waitpid(child, &status, 0) < 0 && errno == EINTR) {
      }
      over = true;
    }
    ~Reaped() {
      ::close(pipe);
      if (!over) ::kill(child, SIGKILL);
      wait();
    }
  } reaped{.child = child, .pipe = ends[0]};
  Reported reported;
  const bool answered = listen(ends[0], reported, progress);
  if (!answered) ::kill(child, SIGKILL);
  reaped.wait();
  if (reported.ended_well) return reported;
  if (!answered) {
    reported.death = "does not end";
  } else if (WIFSIGNALED(reaped.status)) {
    reported.death = fmt::format("crashes the program ({})", ::strsignal(WTERMSIG(reaped.status)));
  } else {
    reported.death = fmt::format("ends the program (status {})", WEXITSTATUS(reaped.status));
  }
  return reported;
}

}  // namespace

CheckResult check_in_child(const std::filesystem::path& folder, const Database::Progress& progress) {
  CheckResult result;
  for (std::uint32_t first = 0;;) {
    const Task check_the_rest = [first](const Database& database, PipeListener& listener) {
      check_slots(database, first, listener);
    };
    Reported reported = ask_child(folder, check_the_rest, progress);
    result.recordings = std::max(result.recordings, reported.recordings);
    result.faults.insert(result.faults.end(), reported.faults.begin(), reported.faults.end());
    if (reported.ended_well) return result;
    const std::string where = reported.slot ? reported.name : folder.string();
    result.faults.push_back(
        fmt::format("{}: reading it {}: the engine's own pages are damaged; restore the database from a copy", where,
                    reported.death));
    if (!reported.slot) return result;
    first = *reported.slot + 1;
  }
}

std::vector<Usage> usage_in_child(const std::filesystem::path& folder) {
  const Task measure = [](const Database& database, PipeListener& listener) {
    for (const Usage& one : database.usage()) {
      ByteWriter out;
      out.text(one.kind);
      out.number(one.entries);
      out.number(one.bytes);
      listener.send(Message::usage, 0, text_of(out.bytes()));
    }
  };
  Reported reported = ask_child(folder, measure, {});
  if (reported.ended_well) return reported.usage;
  throw Error(
      ErrorCode::corrupt,
      fmt::format("{}: reading all of it {}: the engine's own pages are damaged; 'signweave check' reports which "
                  "recordings are affected; restore the database from a copy",
                  folder.string(), reported.death));
}

}  // namespace signweave
