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

/// Face capture as written by Live Link Face: a line of headings (Timecode, BlendShapeCount, then 52 ARKit names and 9
/// head and eye rotations), and one line per frame. Inside signweave the names are ARKit's own: EyeBlinkLeft is
/// "eyeBlinkLeft".
namespace signweave::face_csv {

/// The contents of such a file.
struct Face {
  FrameRate rate;                   ///< of its timecode: whole frames a second
  Seconds first{0};                 ///< the first row's timecode, since midnight
  std::vector<Seconds> times;       ///< [row] since the first row, never decreasing
  std::vector<ScalarTrack> tracks;  ///< in the file's order, each with one value per row
  std::vector<Notice> notices;
};

/// Reads a file. A timecode is HOURS:MINUTES:SECONDS:FRAMES.PART; its rate is the standard one above the highest frame
/// number if a whole second is present, else 60. Rows whose count is 0 and that have no values (no face was seen) are
/// skipped. Throws Error{bad_input, "FILE:LINE: …"} if it is not such a file, Error{not_found}, Error{io}.
Face read(const std::filesystem::path& path);
/// Reads from text; `name` is the file name in errors.
Face read_text(const std::string& name, std::string_view text);

/// A timecode "HH:MM:SS:FF.fff" since midnight, with `rate` frames per second; nullopt if it is not a timecode.
std::optional<Seconds> seconds_of(std::string_view timecode, FrameRate rate);

/// The time of the face's first row, in seconds of a motion whose frame 0 is at a timecode since midnight. Both are
/// from the same day or from the two days of one night: the result lies within twelve hours.
Seconds start_of(const Face& face, Seconds motion_timecode);

/// The tracks at the frames of a motion, with the first row at `start` of the motion: linear between rows, constant
/// before the first row and after the last. An ARKit track that is 0 throughout carries no information and is omitted
/// (if all are, one is kept): the file always has its column, and `write_text` writes it as 0.
std::vector<ScalarTrack> resampled(const Face& face, FrameRate rate, std::int64_t frames, Seconds start = Seconds(0));

/// A file with the scalar tracks of a motion: every ARKit name, 0 if the motion has no such track, then its other
/// tracks. The timecode begins at 0.
std::string write_text(const Motion& motion);

/// The names of the columns: 52 of ARKit in Live Link Face's order, then head and eyes.
std::span<const std::string_view> track_names();

}  // namespace signweave::face_csv
