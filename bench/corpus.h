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
    double made_minutes = 0;
    for (int i = 0; made_minutes < minutes - 0.5; ++i) {
      demo::Script script = i % 2 == 0 ? demo::meteo() : demo::villes();
      if (i > 1) script.name += fmt::format("-{}", i);
      demo::SyntheticRecording made = demo::make_recording(script, {100, 1}, static_cast<std::uint64_t>(i + 1));
      made_minutes += made.motion.duration().count() / 60;
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
