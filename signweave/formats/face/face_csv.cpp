#include "signweave/formats/face/face_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>

#include "signweave/core/text.h"
#include "signweave/core/text_reader.h"

namespace signweave::face_csv {
namespace {

constexpr std::string_view kNames[] = {"eyeBlinkLeft",
                                       "eyeLookDownLeft",
                                       "eyeLookInLeft",
                                       "eyeLookOutLeft",
                                       "eyeLookUpLeft",
                                       "eyeSquintLeft",
                                       "eyeWideLeft",
                                       "eyeBlinkRight",
                                       "eyeLookDownRight",
                                       "eyeLookInRight",
                                       "eyeLookOutRight",
                                       "eyeLookUpRight",
                                       "eyeSquintRight",
                                       "eyeWideRight",
                                       "jawForward",
                                       "jawRight",
                                       "jawLeft",
                                       "jawOpen",
                                       "mouthClose",
                                       "mouthFunnel",
                                       "mouthPucker",
                                       "mouthRight",
                                       "mouthLeft",
                                       "mouthSmileLeft",
                                       "mouthSmileRight",
                                       "mouthFrownLeft",
                                       "mouthFrownRight",
                                       "mouthDimpleLeft",
                                       "mouthDimpleRight",
                                       "mouthStretchLeft",
                                       "mouthStretchRight",
                                       "mouthRollLower",
                                       "mouthRollUpper",
                                       "mouthShrugLower",
                                       "mouthShrugUpper",
                                       "mouthPressLeft",
                                       "mouthPressRight",
                                       "mouthLowerDownLeft",
                                       "mouthLowerDownRight",
                                       "mouthUpperUpLeft",
                                       "mouthUpperUpRight",
                                       "browDownLeft",
                                       "browDownRight",
                                       "browInnerUp",
                                       "browOuterUpLeft",
                                       "browOuterUpRight",
                                       "cheekPuff",
                                       "cheekSquintLeft",
                                       "cheekSquintRight",
                                       "noseSneerLeft",
                                       "noseSneerRight",
                                       "tongueOut",
                                       "headYaw",
                                       "headPitch",
                                       "headRoll",
                                       "leftEyeYaw",
                                       "leftEyePitch",
                                       "leftEyeRoll",
                                       "rightEyeYaw",
                                       "rightEyePitch",
                                       "rightEyeRoll"};

/// The rate of timecodes that are written, and the one assumed if a file does not determine it: Live Link Face's own.
constexpr int kUsualRate = 60;

bool is_known(std::string_view name) {
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

/// Converts between the file's name of a track, "EyeBlinkLeft", and ours, "eyeBlinkLeft".
std::string with_first(std::string_view name, bool upper) {
  std::string result(name);
  char& first = result[0];
  if (upper && first >= 'a' && first <= 'z') first = static_cast<char>(first - 'a' + 'A');
  if (!upper && first >= 'A' && first <= 'Z') first = static_cast<char>(first - 'A' + 'a');
  return result;
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == line.npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

template <typename Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [at, fault] = std::from_chars(text.data(), end, value);
  if (fault != std::errc() || at != end || text.empty()) return std::nullopt;
  return value;
}

/// A timecode as printed; the duration of a frame follows from the whole file.
struct Timecode {
  std::int64_t second = 0;
  double frame = 0;
};

std::optional<Timecode> parse_timecode(std::string_view text) {
  std::int64_t parts[3] = {};
  for (std::int64_t& part : parts) {
    const std::size_t colon = text.find(':');
    const auto value = number<unsigned>(text.substr(0, colon));
    if (colon == text.npos || !value || *value > 59) return std::nullopt;
    part = *value;
    text.remove_prefix(colon + 1);
  }
  const auto frame = number<double>(text);
  if (parts[0] > 23 || !frame || !(*frame >= 0 && *frame < 1000)) return std::nullopt;
  return Timecode{(parts[0] * 60 + parts[1]) * 60 + parts[2], *frame};
}

/// The frames per second that the timecodes count. If the rows are one frame apart and a whole second is present, its
/// highest frame number gives the rate.
int rate_of(const std::vector<Timecode>& codes) {
  double highest = 0;
  std::vector<double> steps;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    highest = std::max(highest, std::floor(codes[i].frame));
    if (i > 0 && codes[i].second == codes[i - 1].second) steps.push_back(codes[i].frame - codes[i - 1].frame);
  }
  double step = 0;
  if (!steps.empty()) {
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    step = *middle;
  }
  const bool whole = !codes.empty() && codes.back().second - codes.front().second >= 2;
  const bool is_certain = whole && std::abs(step - 1) < 0.1;
  if (highest < kUsualRate && !is_certain) return kUsualRate;
  for (const int rate : {24, 25, 30, 48, 50, 60, 90, 100, 120, 200, 240}) {
    if (highest < rate) return rate;
  }
  return 1000;
}

/// Reads the headings as names of tracks.
std::vector<std::string> read_heading(TextReader& reader) {
  const std::string line(reader.rest_of_line());
  const std::vector<std::string_view> columns = fields_of(line);
  if (columns.size() < 3 || fold_case(columns[0]) != "timecode" || fold_case(columns[1]) != "blendshapecount") {
    reader.fail(
        "expected the heading Timecode,BlendShapeCount,EyeBlinkLeft,…; this is not a face capture of Live Link Face");
  }
  // Each column becomes a number for each frame of the motion: a heading alone must not request gigabytes.
  constexpr std::size_t kMostColumns = 500;
  if (columns.size() > kMostColumns) {
    reader.fail(fmt::format("{} columns, and {} is the most; Live Link Face writes 63", columns.size(), kMostColumns));
  }
  std::vector<std::string> names;
  std::set<std::string> seen;
  bool known = false;
  for (std::size_t i = 2; i < columns.size(); ++i) {
    if (columns[i].empty()) reader.fail(fmt::format("column {} has no name; give it one", i + 1));
    names.push_back(with_first(columns[i], false));
    known = known || is_known(names.back());
    if (!seen.insert(names.back()).second) {
      reader.fail(fmt::format("column '{}' occurs twice; remove one", printable(columns[i])));
    }
  }
  if (!known) {
    reader.fail(fmt::format("column '{}' and the others are not ARKit names, such as EyeBlinkLeft; rename them",
                            printable(columns[2])));
  }
  return names;
}

Face read(TextReader& reader) {
  if (reader.peek().empty()) reader.fail("the file is empty; expected the heading Timecode,BlendShapeCount,…");
  Face face;
  for (std::string& name : read_heading(reader)) face.tracks.push_back({.name = std::move(name), .values = {}});
  std::string others;
  for (const ScalarTrack& track : face.tracks) {
    if (!is_known(track.name)) others += (others.empty() ? "" : ", ") + track.name;
  }
  if (!others.empty()) face.notices.push_back(reader.notice("tracks in addition to ARKit's: " + printable(others)));

  std::vector<Timecode> codes;      // of every row
  std::vector<std::size_t> filled;  // indices of the rows with values
  std::int64_t midnights = 0;
  while (!reader.peek().empty()) {
    const std::string line(reader.rest_of_line());
    const std::vector<std::string_view> fields = fields_of(line);
    const auto code = parse_timecode(fields[0]);
    if (!code) reader.fail(fmt::format("'{}' is not a timecode HOURS:MINUTES:SECONDS:FRAMES", printable(fields[0])));
    codes.push_back(*code);
    codes.back().second += midnights;
    if (codes.size() > 1) {
      const Timecode& before = codes[codes.size() - 2];
      if (before.second - codes.back().second > 12 * 3600) {
        midnights += 24 * 3600;
        codes.back().second += 24 * 3600;
      }
      const bool back = codes.back().second < before.second ||
                        (codes.back().second == before.second && codes.back().frame < before.frame);
      if (back) reader.fail(fmt::format("the timecode {} goes back; sort the rows", printable(fields[0])));
    }
    const auto count = fields.size() > 1 ? number<double>(fields[1]) : std::nullopt;
    if (!count) reader.fail("expected a number in the column BlendShapeCount");
    const bool blank =
        std::all_of(fields.begin() + 2, fields.end(), [](std::string_view text) { return text.empty(); });
    if (*count == 0 && blank) continue;
    if (fields.size() != face.tracks.size() + 2) {
      reader.fail(fmt::format("{} columns where the heading has {}; the row may be cut off", fields.size(),
                              face.tracks.size() + 2));
    }
    for (std::size_t i = 0; i < face.tracks.size(); ++i) {
      const auto read = number<double>(fields[i + 2]);  // values too small for a float are 0
      const std::optional<float> value = read ? std::optional(static_cast<float>(*read)) : std::nullopt;
      if (!value || !std::isfinite(*value)) {
        reader.fail(fmt::format("'{}' in column {} is not a finite number", printable(fields[i + 2]),
                                printable(with_first(face.tracks[i].name, true))));
      }
      face.tracks[i].values.push_back(*value);
    }
    filled.push_back(codes.size() - 1);
  }
  if (filled.empty()) reader.fail("no row with values follows the heading; there is no face in this file");
  if (filled.size() < codes.size()) {
    face.notices.push_back({reader.name(), fmt::format("{} of {} rows saw no face and are bridged",
                                                       codes.size() - filled.size(), codes.size())});
  }
  const int rate = rate_of(codes);
  face.rate = {rate, 1};
  const auto seconds = [&](const Timecode& code) { return static_cast<double>(code.second) + code.frame / rate; };
  face.first = Seconds(seconds(codes[0]));
  for (const std::size_t row : filled) face.times.emplace_back(seconds(codes[row]) - seconds(codes[0]));
  return face;
}

}  // namespace

std::span<const std::string_view> track_names() {
  return kNames;
}

Face read(const std::filesystem::path& path) {
  TextReader reader(path);
  return read(reader);
}

Face read_text(const std::string& name, std::string_view text) {
  TextReader reader(name, text);
  return read(reader);
}

std::optional<Seconds> seconds_of(std::string_view timecode, FrameRate rate) {
  const std::optional<Timecode> code = parse_timecode(timecode);
  if (!code) return std::nullopt;
  return Seconds(static_cast<double>(code->second) + code->frame * rate.frame_time().count());
}

Seconds start_of(const Face& face, Seconds motion_timecode) {
  constexpr Seconds kDay(24 * 3600);
  const Seconds start = face.first - motion_timecode;
  return start > kDay / 2 ? start - kDay : start < -kDay / 2 ? start + kDay : start;
}

std::vector<ScalarTrack> resampled(const Face& face, FrameRate rate, std::int64_t frames, Seconds start) {
  const auto says_something = [](const ScalarTrack& track) {
    return std::ranges::find(kNames, track.name) == std::end(kNames) ||
           std::ranges::any_of(track.values, [](float value) { return value != 0; });
  };
  std::vector<const ScalarTrack*> wanted;
  for (const ScalarTrack& track : face.tracks) {
    if (says_something(track)) wanted.push_back(&track);
  }
  if (wanted.empty() && !face.tracks.empty()) wanted.push_back(&face.tracks.front());  // a face was captured, at rest
  std::vector<ScalarTrack> tracks;
  for (const ScalarTrack* track : wanted) {
    tracks.push_back({.name = track->name, .values = {}});
    tracks.back().values.reserve(static_cast<std::size_t>(frames));
  }
  std::size_t next = 0;  // the first row after the frame's time
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const Seconds time(static_cast<double>(frame) * static_cast<double>(rate.denominator) /
                           static_cast<double>(rate.numerator) -
                       start.count());
    while (next < face.times.size() && face.times[next] <= time) ++next;
    const std::size_t before = next == 0 ? 0 : next - 1;
    const std::size_t after = std::min(next, face.times.size() - 1);
    const double span = (face.times[after] - face.times[before]).count();
    const double part = span > 0 && next > 0 ? (time - face.times[before]).count() / span : 0;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      const std::vector<float>& values = wanted[i]->values;
      tracks[i].values.push_back(
          static_cast<float>(values[before] + part * (static_cast<double>(values[after]) - values[before])));
    }
  }
  return tracks;
}

std::string write_text(const Motion& motion) {
  std::vector<std::string> columns;
  std::vector<const ScalarTrack*> tracks;
  std::set<std::string> seen;
  for (const std::string_view name : kNames) {
    const auto& all = motion.tracks();
    const auto known =
        std::find_if(all.begin(), all.end(), [&](const ScalarTrack& track) { return track.name == name; });
    columns.push_back(with_first(name, true));
    seen.insert(columns.back());
    tracks.push_back(known == all.end() ? nullptr : &*known);
  }
  for (const ScalarTrack& track : motion.tracks()) {
    if (track.name.empty()) continue;
    std::string column = with_first(track.name, true);
    std::replace_if(
        column.begin(), column.end(), [](char c) { return c == ',' || static_cast<unsigned char>(c) < 32; }, '_');
    if (!seen.insert(column).second) continue;
    columns.push_back(std::move(column));
    tracks.push_back(&track);
  }

  std::string text = "Timecode,BlendShapeCount";
  for (const std::string& column : columns) text += ',' + column;
  const FrameRate rate = motion.rate();
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    // In thousandths of a timecode's frame, so that rounding never gives frame 60.
    const double ticks = static_cast<double>(frame) * static_cast<double>(rate.denominator) /
                         static_cast<double>(rate.numerator) * kUsualRate * 1000;
    const std::int64_t whole = std::llround(ticks);
    const std::int64_t second = whole / (kUsualRate * 1000);
    fmt::format_to(std::back_inserter(text), "\n{:02}:{:02}:{:02}:{:06.3f},{}", second / 3600 % 24, second / 60 % 60,
                   second % 60, static_cast<double>(whole % (kUsualRate * 1000)) / 1000, columns.size());
    for (const ScalarTrack* track : tracks) {
      const float value = track == nullptr ? 0 : track->values[static_cast<std::size_t>(frame)];
      fmt::format_to(std::back_inserter(text), ",{}", value);
    }
  }
  return text + '\n';
}

}  // namespace signweave::face_csv
