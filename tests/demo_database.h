#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "demo/corpus.h"
#include "signweave/annotation/tier_name.h"
#include "signweave/database/database.h"

namespace signweave {

/// A database of generated recordings at 100 frames per second, new in a folder: for tests and benchmarks.
inline std::unique_ptr<const Database> demo_database(const std::filesystem::path& folder,
                                                     std::span<const demo::Script> scripts) {
  Database::create(folder, {});
  {
    Database writer(folder, kv::Access::read_write);
    for (const demo::Script& script : scripts) {
      demo::SyntheticRecording made = demo::make_recording(script, {100, 1}, 1);
      Recording recording{.name = made.name};
      recording.motion = MotionPart{.motion = std::move(made.motion)};
      TierNames tiers = guess_tier_names(made.document);
      recording.annotation = AnnotationPart{.document = std::move(made.document), .tiers = std::move(tiers)};
      recording.clock = {.frame_time = made.timeline.rate.frame_time()};
      writer.put(recording);
    }
    writer.merge();  // as at the end of an import
    writer.learn();
  }
  return std::make_unique<const Database>(folder, kv::Access::read_only);
}

/// A copy, in a folder, of the demo corpus of so many minutes. Each test is a separate process, and generating the
/// corpus takes longer than most tests: the first process of a program stores it next to the program, under the
/// program's modification time, and the others copy it from there. It must not be opened.
inline void copy_demo_database(const std::filesystem::path& folder, double minutes) {
  namespace fs = std::filesystem;
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path kept = program.parent_path().parent_path() / "test_databases" / program.filename() /
                        fmt::format("{}-{}", fs::last_write_time(program).time_since_epoch().count(), minutes);
  if (!fs::exists(kept)) {
    const fs::path mine = kept.string() + fmt::format(".{}", getpid());
    fs::create_directories(mine.parent_path());
    demo_database(mine, demo::corpus_scripts(minutes)).reset();
    std::error_code exists_already;
    fs::rename(mine, kept, exists_already);
    if (exists_already) fs::remove_all(mine);
  }
  fs::copy(kept, folder, fs::copy_options::recursive);
}

/// The same, opened.
inline std::unique_ptr<const Database> demo_database(const std::filesystem::path& folder, double minutes) {
  copy_demo_database(folder, minutes);
  return std::make_unique<const Database>(folder, kv::Access::read_only);
}

}  // namespace signweave
