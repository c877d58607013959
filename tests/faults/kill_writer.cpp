// Kills a process that changes a database at random moments, and checks the database.
//
//     kill_writer [--engine NAME] [--rounds N] [--seed S]
//
// A child process makes one change after another: it adds recordings, replaces them, stores them in another access
// mode, removes them. Change number i follows from the seed, so the parent knows what the database must contain after
// each. It kills the child with SIGKILL, opens the database, and expects either all acknowledged changes, or these and
// the one in progress: every recording bit for bit, none partially, nothing left over, no fault found.

#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <random>
#include <stdexcept>
#include <thread>

#include "signweave/database/check.h"
#include "signweave/database/test_recording.h"
#include "signweave/motion_db/quantise.h"

namespace {

using namespace signweave;
using testing_database::TestFolder;
namespace fs = std::filesystem;

constexpr int kNames = 5;

/// The expected state of one recording in a database.
struct Held {
  int content = 0;  ///< the seed of its motion and words
  bool rounded = false;
  std::string mode;  ///< of its packets; empty: the database's own
};
using State = std::map<std::string, Held>;

struct Change {
  enum class Kind { put, relayout, remove } kind = Kind::put;
  std::string name;
  int content = 0;
  std::string mode;
  bool rounded = false;  ///< within kTolerance
};

constexpr float kTolerance = 0.0005f;

/// Long enough for a motion to take several transactions in most modes.
Recording recording_of(const std::string& name, int content) {
  Recording recording = testing_database::small_recording(name, content, {"A", fmt::format("B{}", content)},
                                                          2'000 + 1'000 * (content % 4));
  Motion& motion = recording.motion->motion;
  if (content % 3 == 0) {
    motion.add_track({"jawOpen", std::vector<float>(static_cast<std::size_t>(motion.frame_count()), 0.01f)});
  }
  return recording;
}

/// Change number `i` of a seed, applied to the state before it.
Change change_number(std::uint64_t seed, std::uint64_t i, const State& state) {
  std::mt19937_64 random(seed * 1'000'003 + i);
  constexpr const char* kModes[] = {"full", "by_frame:3", "by_frame", "by_joint", "by_joint_and_frame:5"};
  Change change;
  change.name = fmt::format("r{}", random() % kNames);
  change.content = static_cast<int>(i);
  change.mode = kModes[random() % std::size(kModes)];
  change.rounded = random() % 4 == 0;
  const std::uint64_t dice = random() % 10;
  if (!state.contains(change.name) || dice < 4) {
    change.kind = Change::Kind::put;  // added or replaced
  } else {
    change.kind = dice < 8 ? Change::Kind::relayout : Change::Kind::remove;
  }
  return change;
}

void make_change(const Change& change, State& state) {
  switch (change.kind) {
    case Change::Kind::put:
      state[change.name] = {.content = change.content};
      break;
    case Change::Kind::relayout:
      state[change.name].mode = change.mode;
      break;
    case Change::Kind::remove:
      state.erase(change.name);
      break;
  }
}

void make_change(const Change& change, Database& database) {
  switch (change.kind) {
    case Change::Kind::put:
      database.put(recording_of(change.name, change.content));
      break;
    case Change::Kind::relayout:
      database.relayout(change.name, {*parse_access_mode(change.mode), {}});
      break;
    case Change::Kind::remove:
      database.remove(change.name);
      break;
  }
}

/// Makes changes from number `next` on until it is killed; reports the number of each after it has returned.
[[noreturn]] void change_until_killed(const fs::path& folder, std::uint64_t seed, std::uint64_t next, State state,
                                      int pipe) {
  try {
    Database database(folder, kv::Access::read_write);
    for (;; ++next) {
      const Change change = change_number(seed, next, state);
      make_change(change, database);
      make_change(change, state);
      if (::write(pipe, &next, sizeof next) != sizeof next) break;
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "kill_writer: the writer failed: {}\n", error.what());
  }
  ::_exit(1);
}

/// The first difference between the database and `state`; empty if there is none.
std::string difference(const Database& database, const State& state) {
  const std::shared_ptr<const Contents> contents = database.contents();
  if (!contents->faults.empty()) return contents->faults.front();
  if (contents->recordings.size() != state.size()) {
    return fmt::format("{} recordings, not {}", contents->recordings.size(), state.size());
  }
  std::uint64_t records = 3 + database.segments()->members().size();  // head, sweep list, segment tables and their list
  for (const auto& [name, held] : state) {
    const RecordingInfo* info = contents->find(name);
    if (info == nullptr) return name + " is missing";
    const Recording expected = recording_of(name, held.content);
    if (info->motion->frames != expected.motion->motion.frame_count()) return name + " has a different motion";
    const Motion& motion = expected.motion->motion;
    if (!same_bits(database.read(name), held.rounded ? motion_db::quantise(motion, kTolerance) : motion)) {
      return name + " differs";
    }
    const AccessMode mode = motion_db::fitted(*parse_access_mode(held.mode.empty() ? "by_frame:16" : held.mode),
                                              motion.skeleton(), held.rounded ? kTolerance : 0);
    if (info->motion->mode != mode) return fmt::format("{} is stored {}", name, to_string(info->motion->mode));
    if (database.document(name).tiers != expected.annotation->document.tiers) return name + " has different words";
    records += 1 + 4 + 1 + motion_db::packet_count(*info->motion);  // entry; 4 of the document; skeleton; packets
    constexpr std::int64_t kTrackFrames = 4'084;                    // this many values of one track fill four pages
    if (!motion.tracks().empty()) records += static_cast<std::uint64_t>((motion.frame_count() - 1) / kTrackFrames) + 1;
  }
  const std::uint64_t entries = database.engine().entries;
  // There is no sweep list before the first motion.
  if (entries != records && !(state.empty() && entries == 1)) {
    return fmt::format("{} records instead of {}: something is left over", entries, records);
  }
  return {};
}

struct Options {
  std::string engine = kv::engines().front();
  int rounds = 20;
  std::uint64_t seed = 1;
};

struct Outcome {
  std::uint64_t changes = 0;
  int finished = 0;  ///< rounds in which the change in progress was made
};

Outcome run(const Options& options) {
  TestFolder temporary;
  const fs::path folder = temporary / "db";
  Database::create(folder, {.engine = options.engine, .access_mode = *parse_access_mode("by_frame:16")});
  std::mt19937_64 random(options.seed);
  State state;
  std::uint64_t next = 0;
  Outcome outcome;
  for (int round = 0; round < options.rounds; ++round) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("no child process");
    if (child == 0) {
      ::close(ends[0]);
      change_until_killed(folder, options.seed, next, state, ends[1]);
    }
    ::close(ends[1]);
    // Some changes, and then a moment within the following ones.
    const std::uint64_t wanted = random() % 3;
    std::uint64_t number = 0;
    for (std::uint64_t i = 0; i < wanted; ++i) {
      if (::read(ends[0], &number, sizeof number) != sizeof number)
        throw std::runtime_error("the writer ended by itself");
      make_change(change_number(options.seed, number, state), state);
      next = number + 1;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 60'000));
    ::kill(child, SIGKILL);
    while (::read(ends[0], &number, sizeof number) == sizeof number) {
      make_change(change_number(options.seed, number, state), state);
      next = number + 1;
    }
    ::close(ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (!WIFSIGNALED(status)) throw std::runtime_error("the writer ended by itself");

    const auto where = [&] { return fmt::format("{}, seed {}, round {}: ", options.engine, options.seed, round); };
    const Database database(folder, kv::Access::read_write);
    const std::string without = difference(database, state);
    if (!without.empty()) {
      State with = state;
      const Change change = change_number(options.seed, next, state);
      make_change(change, with);
      const std::string fault = difference(database, with);
      if (!fault.empty()) {
        throw std::runtime_error(where() + "neither the old nor the new state: " + without + "; " + fault);
      }
      state = with;
      ++next;
      ++outcome.finished;
    }
    const CheckResult checked = check(database);
    if (!checked.faults.empty()) throw std::runtime_error(where() + checked.faults.front());
  }
  outcome.changes = next;
  return outcome;
}

}  // namespace

int main(int count, char** words) {
  Options options;
  try {
    for (int i = 1; i < count; i += 2) {
      const std::string word = i + 1 < count ? words[i] : "";
      if (word == "--engine") {
        options.engine = words[i + 1];
      } else if (word == "--rounds") {
        options.rounds = std::stoi(words[i + 1]);
      } else if (word == "--seed") {
        options.seed = std::stoull(words[i + 1]);
      } else {
        throw std::runtime_error("usage: kill_writer [--engine NAME] [--rounds N] [--seed S]");
      }
    }
    const Outcome outcome = run(options);
    fmt::print(
        "{}: killed {} times in {} changes, {} of them while the last had just been made; nothing lost, nothing "
        "by half\n",
        options.engine, options.rounds, outcome.changes, outcome.finished);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "kill_writer: {}\n", error.what());
    return 1;
  }
}
