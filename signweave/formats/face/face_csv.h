#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/motion/motion.h"

/// Face capture as Live Link Face writes it: a line of headings (Timecode, BlendShapeCount, then 52 ARKit names and 9
/// head and eye rotations), and a line a frame. Inside signweave the names are ARKit's own: EyeBlinkLeft is
/// "eyeBlinkLeft".
namespace signweave::face_csv {

/// What such a file holds.
struct Face {
  FrameRate rate;                   ///< of its timecode: whole frames a second
  Seconds first{0};                 ///< the first row's timecode, since midnight
  std::vector<Seconds> times;       ///< [row] since the first row, never going back
  std::vector<ScalarTrack> tracks;  ///< in the file's order, each with one value a row
  std::vector<Notice> notices;
};

/// Reads a file. A timecode is HOURS:MINUTES:SECONDS:FRAMES.PART; its rate is the standard one above the highest frame
/// number where a second is seen whole, else 60. Rows whose count is 0 and that have no values (no face was seen) are
/// passed over. Throws Error{bad_input, "FILE:LINE: …"} for what is no such file, Error{not_found}, Error{io}.
Face read(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in errors.
Face read_text(const std::string& name, std::string_view text);

/// A timecode "HH:MM:SS:FF.fff" since midnight, a second being `rate` of its frames; none where it is no timecode.
std::optional<Seconds> seconds_of(std::string_view timecode, FrameRate rate);

/// When the face's first row is, in seconds of a motion whose frame 0 is at a timecode since midnight. Both are of one
/// day or of the night between two: the answer lies within twelve hours.
Seconds start_of(const Face& face, Seconds motion_timecode);

/// The tracks at the frames of a motion, the first row at `start` of the motion: linear between rows, the first value
/// held before the first row and the last after the last. An ARKit track that is 0 throughout says nothing and is left
/// out (of a face all at rest one is kept): the file always has its column, and `write_text` writes it as 0.
std::vector<ScalarTrack> resampled(const Face& face, FrameRate rate, std::int64_t frames, Seconds start = Seconds(0));

/// The scalar tracks of a motion: every ARKit name, 0 where the motion has no such track, then its other tracks. The
/// timecode begins at 0.
std::string write_text(const Motion& motion);

/// The names of the columns: 52 of ARKit in Live Link Face's order, then head and eyes.
std::span<const std::string_view> track_names();

}  // namespace signweave::face_csv
