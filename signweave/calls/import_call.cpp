#include "signweave/calls/import_call.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "signweave/core/text.h"

namespace signweave::calls {

namespace {

/// Parses "TIER", "TIER:right", "TIER:left:SIGNER". A tier whose name contains a colon needs all three parts.
TierNames::SignTier parse_sign_tier(const std::string& text) {
  TierNames::SignTier tier;
  const auto hand_of = [](const std::string& word) -> std::optional<Hand> {
    for (const Hand hand : {Hand::both, Hand::right, Hand::left}) {
      if (name_of(hand) == word) return hand;
    }
    return std::nullopt;
  };
  const std::size_t last = text.rfind(':');
  if (last == std::string::npos) return {text, Hand::both, {}};
  if (const auto hand = hand_of(text.substr(last + 1))) return {text.substr(0, last), *hand, {}};
  const std::size_t middle = text.rfind(':', last == 0 ? 0 : last - 1);
  if (middle != std::string::npos && middle < last) {
    if (const auto hand = hand_of(text.substr(middle + 1, last - middle - 1))) {
      return {text.substr(0, middle), *hand, text.substr(last + 1)};
    }
  }
  return {text, Hand::both, {}};  // the colon belongs to the name
}

[[noreturn]] void refuse_both(std::string_view none, std::string_view field, const std::string& tier) {
  throw Error(ErrorCode::bad_input,
              fmt::format("{}: {} names '{}'; give one of the two", none, field, printable(tier)));
}

/// "120@4010.5": frame 120 is at 4010.5 ms.
std::optional<SyncPoint> parse_sync(const std::string& text) {
  const std::size_t at = text.find('@');
  double frame = 0;
  double ms = 0;
  const char* end = text.data() + text.size();
  if (at == std::string::npos || std::from_chars(text.data(), text.data() + at, frame).ptr != text.data() + at ||
      std::from_chars(text.data() + at + 1, end, ms).ptr != end || at == 0 || at + 1 == text.size() ||
      !std::isfinite(frame) || !std::isfinite(ms)) {
    return std::nullopt;
  }
  return SyncPoint{frame, Seconds(ms / 1000.0)};
}

}  // namespace

std::string check_sync(const std::string& text) {
  return parse_sync(text) ? std::string() : "expected FRAME@MS, such as 120@4010";
}

std::string check_fingerprint(const std::string& text) {
  const bool is_one = text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
  return is_one || text == "none"
             ? std::string()
             : "expected annotation_fingerprint as the recording's information gives it: 16 hexadecimal digits, "
               "or none";
}

std::string_view name_of(ImportOutcome outcome) {
  switch (outcome) {
    case ImportOutcome::added:
      return "added";
    case ImportOutcome::unchanged:
      return "unchanged";
    case ImportOutcome::clock_changed:
      return "clock, signer or rig changed";
    case ImportOutcome::measured:
      return "measured anew";
    case ImportOutcome::annotation_added:
      return "annotation added";
    case ImportOutcome::motion_added:
      return "motion added";
    case ImportOutcome::face_added:
      return "face added";
    case ImportOutcome::annotation_replaced:
      return "annotation replaced";
    case ImportOutcome::motion_replaced:
      return "motion replaced";
  }
  return "";
}

ImportOptions options_of(const ImportCall& call) {
  ImportOptions options;
  options.motion = read_options(call.reading);
  for (const std::string& tier : call.sign_tiers) options.sign_tiers.push_back(parse_sign_tier(tier));
  options.phase_tiers = call.phase_tiers;
  options.no_sign_tier = call.no_sign_tier;
  options.no_phase_tier = call.no_phase_tier;
  if (call.no_sign_tier && !call.sign_tiers.empty()) refuse_both("no_sign_tier", "sign_tier", call.sign_tiers[0]);
  if (call.no_phase_tier && !call.phase_tiers.empty()) refuse_both("no_phase_tier", "phase_tier", call.phase_tiers[0]);
  if (!call.phase_labels.empty()) options.phase_labels = read_phase_labels(call.phase_labels);
  if (call.offset_ms) options.offset = Seconds(*call.offset_ms / 1000.0);
  if (call.face.offset_ms) options.face_offset = Seconds(*call.face.offset_ms / 1000.0);
  if (!call.face.timecode.empty()) options.face_timecode = call.face.timecode;
  for (const std::string& sync : call.syncs) options.sync.push_back(*parse_sync(sync));
  if (!call.rig.empty()) options.rig = read_rig_names(call.rig);
  options.strict = call.strict;
  options.replace_motion = call.replace_motion;
  if (!call.if_annotation.empty()) options.if_annotation = call.if_annotation;
  return options;
}

Pairing pairing_of(const ImportCall& call, const std::vector<std::filesystem::path>& inputs, bool plain_files) {
  Pairing pairing = pair_files(
      inputs, call.pairs.empty() ? std::nullopt : std::optional<std::filesystem::path>(call.pairs), plain_files);
  if (call.recordings.empty()) return pairing;
  std::vector<std::string> known;
  for (const ImportJob& job : pairing.jobs) known.push_back(job.name);
  for (const std::string& name : call.recordings) {
    if (std::ranges::find(known, name) != known.end()) continue;
    throw Error(ErrorCode::not_found, fmt::format("recordings: there is no '{}' among these files{}", printable(name),
                                                  did_you_mean(name, known)));
  }
  std::erase_if(pairing.jobs, [&](const ImportJob& job) {
    return std::ranges::find(call.recordings, job.name) == call.recordings.end();
  });
  return pairing;
}

void run(Database& database, const Pairing& pairing, const ImportOptions& options, const Listener& listener,
         const std::function<void(const Imported&)>& done) {
  const std::vector<ImportJob>& jobs = pairing.jobs;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const auto advance = [&](double fraction) {
      listener.advance((static_cast<double>(i) + fraction) / static_cast<double>(jobs.size()));
    };
    Imported imported{.name = jobs[i].name};
    try {
      advance(0);
      imported.report = import_recording(database, jobs[i], options, advance);
      imported.name = imported.report->name;
    } catch (const Error& error) {  // its stored data is unchanged; the others are imported
      if (error.code() == ErrorCode::cancelled) throw;
      imported.error = error;
    }
    done(imported);
  }
}

}  // namespace signweave::calls
