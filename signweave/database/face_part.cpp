#include "signweave/database/face_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signweave/core/text.h"
#include "signweave/formats/face/face_csv.h"

namespace signweave {

namespace fs = std::filesystem;

std::optional<Seconds> given_face_offset(const fs::path& path, std::optional<Seconds> offset,
                                         const std::optional<std::string>& motion_timecode) {
  if (!offset && motion_timecode) {
    const face_csv::Face face = face_csv::read(path);
    const std::optional<Seconds> timecode = face_csv::seconds_of(*motion_timecode, face.rate);
    if (!timecode) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("face_timecode: '{}' is not a timecode HOURS:MINUTES:SECONDS:FRAMES",
                              printable(*motion_timecode)));
    }
    offset = face_csv::start_of(face, *timecode);
  }
  if (offset && !(std::abs(offset->count()) <= 1e6)) {
    throw Error(ErrorCode::bad_input, "face_offset_ms: a number of milliseconds, at most 1,000,000,000");
  }
  return offset;
}

std::size_t add_face(const fs::path& path, Seconds offset, Motion& motion, std::vector<Notice>& notices) {
  face_csv::Face face = face_csv::read(path);
  const double last = (offset + face.times.back()).count();
  if (last < 0 || offset > motion.duration()) {
    throw Error(ErrorCode::bad_input,
                fmt::format("{}: the face, from {:.3f} to {:.3f} s of the motion, lies outside of its {:.3f} s",
                            path.string(), offset.count(), last, motion.duration().count()),
                {{"face_offset_ms", ""}, {"face_timecode", ""}});
  }
  if (offset.count() > 0.5) {
    face.notices.push_back(
        {path.string(),
         fmt::format("the face begins {:.1f} s after the motion; its first values are held before", offset.count())});
  }
  // A row covers the time until the next, as a frame does; a difference of more than half a second is reported.
  const double missing = motion.duration().count() - last;
  if (missing > 0.5) {
    face.notices.push_back(
        {path.string(), fmt::format("the face ends {:.1f} s before the motion; its last values are held", missing)});
  } else if (missing < -0.5) {
    face.notices.push_back(
        {path.string(), fmt::format("the face continues {:.1f} s after the motion; that is left out", -missing)});
  }
  std::vector<ScalarTrack> own = motion.take_tracks();
  std::vector<ScalarTrack> of_face = face_csv::resampled(face, motion.rate(), motion.frame_count(), offset);
  const std::size_t both = std::erase_if(own, [&](const ScalarTrack& track) {
    return std::ranges::any_of(of_face, [&](const ScalarTrack& other) { return other.name == track.name; });
  });
  if (both > 0) {
    face.notices.push_back(
        {path.string(), fmt::format("{} of the motion file take their values from the face",
                                    both == 1 ? std::string("1 track") : fmt::format("{} tracks", both))});
  }
  const std::size_t own_count = own.size();
  for (std::vector<ScalarTrack>* tracks : {&own, &of_face}) {
    for (ScalarTrack& track : *tracks) motion.add_track(std::move(track));
  }
  notices.insert(notices.end(), face.notices.begin(), face.notices.end());
  return own_count;
}

}  // namespace signweave
