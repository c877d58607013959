#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "signweave/core/text.h"
#include "signweave/core/text_reader.h"
#include "signweave/evaluation/recording_rows.h"
#include "signweave/evaluation/spans.h"

namespace signweave {
namespace {

/// Each group is reported separately.
constexpr std::size_t kMostGroups = 100;

std::int64_t number_of(const std::string& text, std::string_view what, const TextReader& reader) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) {
    reader.fail(fmt::format("the {} '{}' is not a whole number", what, printable(text)));
  }
  return number;
}

}  // namespace

SpanChoice read_spans(const std::filesystem::path& path, std::span<const EvaluatedMotion> recordings) {
  TextReader reader(path);
  SpanChoice choice;
  bool heading = true;
  while (!reader.peek().empty()) {
    const std::vector<std::string> fields = csv_fields(reader);
    if (fields.size() == 1 && fields[0].empty()) continue;
    if (std::exchange(heading, false) && fold_case(fields[0]) == "file") continue;
    if (fields.size() < 3 || fields.size() > 4) {
      reader.fail(fmt::format("{} columns; a row has file, first frame, frames, and may have a group", fields.size()));
    }
    const std::size_t index = recording_named(fields[0], recordings, reader);
    const EvaluatedMotion& recording = recordings[index];
    const std::int64_t first = number_of(fields[1], "first frame", reader);
    const std::int64_t frames = number_of(fields[2], "number of frames", reader);
    const std::int64_t count = recording.motion.frame_count();
    if (frames < 1 || first < 1 || first >= count || frames > count - 1 - first) {
      reader.fail(fmt::format(
          "{} from frame {} leave no frame on both sides of {} (frames 0 to {}); both its "
          "neighbours must be there",
          frames == 1 ? "1 frame" : fmt::format("{} frames", frames), first, printable(fields[0]), count - 1));
    }
    const std::string group = fields.size() == 4 && !fields[3].empty() ? fields[3] : "table";
    const auto known = std::find(choice.groups.begin(), choice.groups.end(), group);
    const auto place = static_cast<std::size_t>(known - choice.groups.begin());
    if (known == choice.groups.end()) {
      if (choice.groups.size() == kMostGroups) {
        reader.fail(fmt::format("more than {} groups; give spans that belong together one name", kMostGroups));
      }
      choice.groups.push_back(group);
    }
    const FrameRange range{first, first + frames};
    const auto spoiled = recording.unusable.begin();
    if (std::find(spoiled + (first - 1), spoiled + range.end + 1, true) != spoiled + range.end + 1) {
      ++choice.left_out;
      continue;
    }
    choice.spans.push_back(span_at(recording, index, range, place));
  }
  if (choice.spans.empty()) {
    throw Error(ErrorCode::bad_input,
                choice.left_out > 0
                    ? fmt::format("{}: every span holds a defect of its capture; give others", path.string())
                    : fmt::format("{}: no span in it; a row has file, first frame, frames", path.string()));
  }
  sort_spans(choice);
  return choice;
}

}  // namespace signweave
