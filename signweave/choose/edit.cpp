#include "signweave/choose/edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave {
namespace {

std::size_t find_sign(const std::vector<Sign>& signs, const GlossRef& wanted, const std::string& recording) {
  const std::string form = match_form(wanted.gloss);
  std::vector<std::size_t> found;
  std::vector<std::string> glosses;
  for (std::size_t i = 0; i < signs.size(); ++i) {
    if (match_form(signs[i].gloss) == form) found.push_back(i);
    glosses.push_back(signs[i].gloss);
  }
  if (found.empty()) {
    throw Error(ErrorCode::not_found,
                fmt::format("no sign '{}' on tier '{}' of recording '{}'{}", printable(wanted.gloss),
                            signs.front().tier, recording, did_you_mean(wanted.gloss, glosses)));
  }
  if (wanted.token == 0 && found.size() > 1) {
    throw Error(ErrorCode::bad_input,
                fmt::format("'{0}' occurs {1} times in recording '{2}'; say which: {0}#1 to {0}#{1}",
                            printable(wanted.gloss), found.size(), recording));
  }
  if (wanted.token > found.size()) {
    throw Error(ErrorCode::not_found, fmt::format("no token {} of '{}' in recording '{}', which has {}", wanted.token,
                                                  printable(wanted.gloss), recording, found.size()));
  }
  return found[wanted.token == 0 ? 0 : wanted.token - 1];
}

/// A run [first, last] of the recording's own signs, or a replacement.
struct EditItem {
  std::size_t first = 0;
  std::size_t last = 0;
  const GlossRef* replacement = nullptr;
};

std::vector<EditItem> items_for(const std::vector<Sign>& signs, const Edit& edit, const std::string& recording) {
  std::vector<EditItem> items;
  if (edit.swap) {
    const auto run_of = [&](const SignRun& run) {
      const EditItem item{find_sign(signs, run.first, recording), find_sign(signs, run.last, recording)};
      if (item.last < item.first) {
        throw Error(ErrorCode::bad_input, fmt::format("{}..{}: the second comes before the first in recording '{}'",
                                                      to_string(run.first), to_string(run.last), recording));
      }
      return item;
    };
    EditItem a = run_of(edit.swap->first);
    EditItem b = run_of(edit.swap->second);
    if (b.first < a.first) std::swap(a, b);
    if (b.first <= a.last) throw Error(ErrorCode::bad_input, "the two runs to swap share signs");
    if (a.first > 0) items.push_back({0, a.first - 1});
    items.push_back(b);
    if (a.last + 1 < b.first) items.push_back({a.last + 1, b.first - 1});
    items.push_back(a);
    if (b.last + 1 < signs.size()) items.push_back({b.last + 1, signs.size() - 1});
    return items;
  }
  std::map<std::size_t, const GlossRef*> replaced;
  for (const Replacement& replacement : edit.replacements) {
    const std::size_t at = find_sign(signs, replacement.from, recording);
    if (!replaced.emplace(at, &replacement.to).second) {
      throw Error(ErrorCode::bad_input, fmt::format("'{}' is to be replaced twice", to_string(replacement.from)));
    }
  }
  std::size_t next = 0;
  for (const auto& [at, to] : replaced) {
    if (next < at) items.push_back({next, at - 1});
    items.push_back({at, at, to});
    next = at + 1;
  }
  if (next < signs.size()) items.push_back({next, signs.size() - 1});
  return items;
}

}  // namespace

Replacement parse_replacement(std::string_view text) {
  const std::size_t sign = find_unquoted(text, "=");
  if (sign == text.npos) {
    throw Error(ErrorCode::bad_input,
                fmt::format("replace '{}': expected GLOSS=GLOSS, such as BRETAGNE=VANNES#2", printable(text)));
  }
  return {parse_gloss_ref(text.substr(0, sign), "replace"), parse_gloss_ref(text.substr(sign + 1), "replace")};
}

HandReplacement parse_hand_replacement(std::string_view text) {
  for (const auto& [prefix, side] : {std::pair("left:", Side::left), std::pair("right:", Side::right)}) {
    const std::string_view begin(prefix);
    if (text.starts_with(begin)) return {side, parse_replacement(text.substr(begin.size()))};
  }
  throw Error(ErrorCode::bad_input,
              fmt::format("replace-hand '{}': expected left:GLOSS=GLOSS or right:GLOSS=GLOSS, such "
                          "as left:REGION=VILLE#2",
                          printable(text)));
}

std::pair<SignRun, SignRun> parse_swap(std::string_view text) {
  const std::size_t comma = find_unquoted(text, ",");
  if (comma == text.npos) {
    throw Error(ErrorCode::bad_input, fmt::format("swap '{}': expected FROM..TO,FROM..TO, such as "
                                                  "BRETAGNE..PLUIE,VENDREDI..BROUILLARD",
                                                  printable(text)));
  }
  const auto run_of = [](std::string_view run) {
    const std::size_t dots = find_unquoted(run, "..");
    if (dots == run.npos) {
      const GlossRef only = parse_gloss_ref(run, "swap");
      return SignRun{only, only};
    }
    return SignRun{parse_gloss_ref(run.substr(0, dots), "swap"), parse_gloss_ref(run.substr(dots + 2), "swap")};
  };
  return {run_of(text.substr(0, comma)), run_of(text.substr(comma + 1))};
}

std::vector<Choice> choices_for(const Contents& contents, std::string_view recording, const Edit& edit) {
  const RecordingInfo& info = contents.at(recording);
  const auto index = static_cast<std::size_t>(&info - contents.recordings.data());
  if (!info.motion) throw Error(ErrorCode::not_found, fmt::format("recording '{}' has no motion", info.name));
  const std::vector<Sign> signs = main_signs_of(contents.segments, static_cast<std::uint32_t>(index));
  if (signs.empty()) throw Error(ErrorCode::not_found, fmt::format("recording '{}' has no signs to edit", info.name));

  std::vector<Choice> choices;
  const std::vector<EditItem> items = items_for(signs, edit, info.name);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const EditItem& item = items[i];
    Choice choice;
    if (item.replacement != nullptr) {
      choice.candidates = candidates_for(contents, SignRef{.gloss = *item.replacement, .recording = {}, .span = {}});
    } else {
      std::vector<Sign> run(signs.begin() + static_cast<std::ptrdiff_t>(item.first),
                            signs.begin() + static_cast<std::ptrdiff_t>(item.last) + 1);
      const std::string from = run.front().gloss;
      const std::string to = run.back().gloss;
      const bool opens = i == 0 && item.first == 0;
      const bool closes = i + 1 == items.size() && item.last + 1 == signs.size();
      std::optional<Candidate> candidate = candidate_of_run(contents, index, run);
      if (!candidate && (opens || closes)) {
        // Only signs without stroke at an end of the recording: their frames are kept as a separate clip.
        const FrameRange frames = frames_of({run.front().span.begin, run.back().span.end}, info.clock);
        const FrameRange inside =
            clamp({opens ? 0 : frames.begin, closes ? info.motion->frames : frames.end}, info.motion->frames);
        if (!inside.empty()) candidate = Candidate{.recording = index, .signs = run, .whole = inside, .core = inside};
      }
      if (!candidate) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("'{}' to '{}' in recording '{}' cannot be kept: no sign of it has a stroke "
                                "inside the motion",
                                from, to, info.name));
      }
      // The motion before the first sign and after the last stays as captured.
      const auto has_stroke = [](const Sign& sign) { return sign.stroke_span().has_value(); };
      if (opens) candidate->whole.begin = 0;
      if (closes) candidate->whole.end = info.motion->frames;
      // Signs without stroke at the recording's ends are not at a cut.
      const auto first = std::find_if(run.begin(), run.end(), has_stroke);
      const auto last = std::find_if(run.rbegin(), run.rend(), has_stroke).base();
      if (first != run.end()) {
        candidate->left_out.clear();
        std::vector<Sign>& before = opens ? candidate->signs : candidate->left_out;
        before.insert(before.begin(), run.begin(), first);
        std::vector<Sign>& after = closes ? candidate->signs : candidate->left_out;
        after.insert(after.end(), last, run.end());
      }
      choice.candidates.push_back(std::move(*candidate));
    }
    choices.push_back(std::move(choice));
  }
  if (edit.swap) return choices;
  // If the first or last sign is replaced, the motion before or after it is kept as a clip without signs.
  const auto bare = [&](FrameRange frames) {
    const FrameRange inside = clamp(frames, info.motion->frames);
    Choice choice;
    // A few frames do not justify a junction.
    if (static_cast<double>(inside.size()) < 0.1 * info.motion->rate.hertz()) return choice;
    choice.candidates.push_back({.recording = index, .whole = inside, .core = inside});
    return choice;
  };
  if (items.front().replacement != nullptr) {
    Choice before = bare({0, frames_of(signs.front().span, info.clock).begin});
    if (!before.candidates.empty()) choices.insert(choices.begin(), std::move(before));
  }
  if (items.back().replacement != nullptr) {
    Choice after = bare({frames_of(signs.back().span, info.clock).end, info.motion->frames});
    if (!after.candidates.empty()) choices.push_back(std::move(after));
  }
  return choices;
}

}  // namespace signweave
