#pragma once

#include <fmt/format.h>

#include <memory>
#include <set>

#include "bench/measure.h"
#include "demo/corpus.h"
#include "signweave/annotation/tier_name.h"
#include "signweave/database/database.h"

namespace signweave::bench {

/// A database of so many minutes of the demo's signing, at 100 frames a second, made anew in a folder.
inline std::unique_ptr<const Database> demo_database(const std::filesystem::path& folder, double minutes) {
  Database::create(folder, {});
  {
    Database writer(folder, kv::Access::read_write);
    for (const demo::Script& script : demo::corpus_scripts(minutes)) {
      demo::SyntheticRecording made = demo::make_recording(script, {100, 1}, 1);
      Recording recording{.name = made.name};
      recording.motion = MotionPart{.motion = std::move(made.motion)};
      TierNames tiers = guess_tier_names(made.document);
      recording.annotation = AnnotationPart{.document = std::move(made.document), .tiers = std::move(tiers)};
      recording.clock = {.frame_time = Seconds(0.01)};
      writer.put(recording);
    }
  }
  return std::make_unique<const Database>(folder, kv::Access::read_only);
}

}  // namespace signweave::bench
