#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "signweave/formats/face/face_csv.h"

using namespace signweave;

/// Any bytes are either rejected with an Error or read; the result fits a motion, and is written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  face_csv::Face face;
  try {
    face = face_csv::read_text("fuzz", text);
  } catch (const Error&) {
    return 0;
  }
  Motion motion(std::make_shared<const Skeleton>(std::vector<Joint>{{.name = "root"}}, std::vector<Tip>()), {100, 1},
                static_cast<std::int64_t>(size % 50) + 1);
  for (ScalarTrack& track : face_csv::resampled(face, motion.rate(), motion.frame_count())) {
    for (const float value : track.values) {
      if (!std::isfinite(value)) std::abort();
    }
    motion.add_track(std::move(track));
  }
  for (std::size_t i = 1; i < face.times.size(); ++i) {
    if (face.times[i] < face.times[i - 1]) std::abort();
  }
  const face_csv::Face again = face_csv::read_text("written", face_csv::write_text(motion));
  if (again.times.size() != static_cast<std::size_t>(motion.frame_count())) std::abort();
  return 0;
}
