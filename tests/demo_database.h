#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "demo/corpus.h"
#include "signweave/annotation/tier_name.h"
#include "signweave/database/database.h"

namespace signweave {

/// A database of made recordings at 100 frames a second, new in a folder: for tests and benchmarks.
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
  }
  return std::make_unique<const Database>(folder, kv::Access::read_only);
}

}  // namespace signweave
