#include "signweave/choose/non_manuals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "signweave/core/text.h"
#include "signweave/nonmanual/blinks.h"
#include "signweave/nonmanual/gaze.h"
#include "signweave/nonmanual/mouthing/mouthing.h"
#include "signweave/space/locus.h"

namespace signweave {
namespace {

/// The lids are shut this long after the stroke before a pause. (ours)
constexpr Milliseconds kBlinkAfterStroke{120};

/// The time of a place in the output.
struct PlaceTime {
  Milliseconds preparation{0};  ///< begin of its preparation
  TimeSpan stroke;
};

/// The times of the places of a score, [place].
class PlaceTimes {
 public:
  explicit PlaceTimes(const Score& score) : score_(score) {}

  PlaceTime at(std::size_t place) const {
    const std::size_t body = body_clips(score_);
    std::size_t found = 0;
    while (found + 1 < body && score_.clips[found + 1].place <= place) ++found;
    const Clip& clip = score_.clips[found];
    PlaceTime time{.preparation = ms(clip.at.begin), .stroke = {ms(clip.at.begin), ms(clip.at.end)}};
    const auto sign = std::ranges::find(clip.sign_places, place);
    if (sign == clip.sign_places.end()) return time;
    const Sign& of_place = clip.signs[static_cast<std::size_t>(sign - clip.sign_places.begin())];
    if (const std::optional<TimeSpan> stroke = of_place.stroke_span()) {
      time.stroke = {std::clamp(output(clip, stroke->begin), ms(clip.at.begin), ms(clip.at.end)),
                     std::clamp(output(clip, stroke->end), ms(clip.at.begin), ms(clip.at.end))};
    }
    time.preparation = std::min(time.stroke.begin, output(clip, of_place.span.begin));
    return time;
  }

  Milliseconds ms(double frame) const { return Milliseconds(std::llround(frame * 1000.0 / score_.rate.hertz())); }
  Milliseconds ms(std::int64_t frame) const { return ms(static_cast<double>(frame)); }
  /// The frames of a time, inside the score and not empty.
  FrameRange frames(TimeSpan span) const {
    const auto frame = [&](Milliseconds time) {
      return std::llround(static_cast<double>(time.count()) * score_.rate.hertz() / 1000.0);
    };
    const std::int64_t begin = std::clamp<std::int64_t>(frame(span.begin), 0, score_.frames - 1);
    return {begin, std::clamp<std::int64_t>(frame(span.end), begin + 1, score_.frames)};
  }

 private:
  Milliseconds output(const Clip& clip, Milliseconds recorded) const {
    const double frame = clip.clock.frame_at(recorded) - static_cast<double>(clip.core.begin);
    return ms(static_cast<double>(clip.at.begin) + frame / clip.step);
  }

  const Score& score_;
};

TimedCurve curve_of(const NonManual& one, const PlaceTime& first, const PlaceTime& last,
                    const NonManualOptions& options, Pronouncer& pronouncer, std::vector<Notice>& notices) {
  const TimeSpan strokes{first.stroke.begin, last.stroke.end};
  switch (one.kind) {
    case NonManual::Kind::expression:
      return over(find_expression(options.expressions, one.what), strokes, one.begin, one.end);
    case NonManual::Kind::mouthing: {
      Pronunciation spoken = pronouncer.pronounce(one.what, fmt::format("mouth \"{}\"", one.what));
      notices.insert(notices.end(), spoken.notices.begin(), spoken.notices.end());
      return mouthing_over(one.what, spoken.phones, {strokes.begin + one.begin, strokes.end + one.end});
    }
    case NonManual::Kind::gaze: {
      const TimeSpan span = gaze_span(first.preparation, last.stroke.end);
      return {gaze_at(gaze_direction_of(one.what), one.what), {span.begin + one.begin, span.end + one.end}};
    }
  }
  return {};
}

/// Looks at the addressee at the begin, the pauses and the end of an utterance (plan_gaze).
void add_gazes(const Utterance& utterance, const Score& score, const PlaceTimes& times,
               std::vector<AuthoredCurve>& curves) {
  std::vector<TimeSpan> units;
  std::vector<std::size_t> first;  // [unit] place
  for (std::size_t place = 0; place < utterance.places.size(); ++place) {
    const PlaceTime time = times.at(place);
    if (place == 0 || utterance.places[place].pause_before > Milliseconds(0)) {
      units.push_back({time.preparation, time.stroke.end});
      first.push_back(place);
    }
    units.back().end = std::max(units.back().end, time.stroke.end);
  }
  for (const TimeSpan& glance : plan_gaze({Milliseconds(0), times.ms(score.frames)}, units)) {
    const auto next = std::ranges::lower_bound(units, glance.end, {}, &TimeSpan::begin);
    const std::size_t place =
        next == units.end() ? utterance.places.size() - 1 : first[static_cast<std::size_t>(next - units.begin())];
    curves.push_back(
        {.curve = gaze_at({0, 0}, "addressee"), .at = times.frames(glance), .first = place, .last = place});
  }
}

/// Blinks at the pauses of an utterance and at the ends of its curves (plan_blinks).
void add_blinks(const Utterance& utterance, const Score& score, const PlaceTimes& times,
                std::vector<AuthoredCurve>& curves) {
  std::vector<Milliseconds> boundaries;
  std::vector<TimeSpan> strokes;
  for (std::size_t place = 0; place < utterance.places.size(); ++place) {
    strokes.push_back(times.at(place).stroke);
    if (place > 0 && utterance.places[place].pause_before > Milliseconds(0)) {
      boundaries.push_back(strokes[place - 1].end + kBlinkAfterStroke);
    }
  }
  for (const AuthoredCurve& one : curves) {
    if (one.curve.mouth.empty()) boundaries.push_back(times.ms(one.at.end));
  }
  std::ranges::sort(boundaries);
  for (const Milliseconds shut : plan_blinks({Milliseconds(0), times.ms(score.frames)}, boundaries, strokes)) {
    const FrameRange at = blink_frames(shut, score.rate);
    const auto after = std::ranges::upper_bound(strokes, shut, {}, &TimeSpan::begin);
    const std::size_t place = after == strokes.begin() ? 0 : static_cast<std::size_t>(after - strokes.begin()) - 1;
    // A blink that the output cuts would shut or open the lids at once.
    if (at.begin < 0 || at.end > score.frames) continue;
    curves.push_back({.curve = blink_at(shut).curve, .at = at, .first = place, .last = place});
  }
}

}  // namespace

GazeDirection gaze_direction_of(std::string_view what) {
  if (what.find_first_of("+-.0123456789") != 0) return find_gaze(what);
  const LocusRef locus = read_locus(what);
  if (locus.kind != LocusRef::Kind::angles) {
    throw Error(ErrorCode::unsupported, fmt::format("a gaze at the point '@{}' is not possible yet; give angles such "
                                                    "as gaze @30/10",
                                                    printable(what)));
  }
  return {.yaw = locus.numbers[0], .pitch = locus.numbers[1]};
}

std::vector<AuthoredCurve> author_non_manuals(const Utterance& utterance, const Score& score,
                                              const NonManualOptions& options, std::vector<Notice>& notices) {
  const PlaceTimes times(score);
  Pronouncer pronouncer(options.pronounce);
  std::vector<AuthoredCurve> curves;
  if (options.gaze) add_gazes(utterance, score, times, curves);  // what the text says is shown over them
  for (const NonManual& one : utterance.non_manuals) {
    TimedCurve made = curve_of(one, times.at(one.first), times.at(one.last), options, pronouncer, notices);
    if (tracks_of(made.curve).empty() && !made.curve.head.moves()) continue;  // nothing to be seen, such as no sounds
    curves.push_back(
        {.curve = std::move(made.curve), .at = times.frames(made.at), .first = one.first, .last = one.last});
  }
  if (options.blinks) add_blinks(utterance, score, times, curves);
  return curves;
}

void check_non_manuals(const Utterance& utterance, const NonManualOptions& options) {
  if (utterance.non_manuals.empty()) return;
  Pronouncer pronouncer(options.pronounce);
  std::vector<Notice> notices;
  const PlaceTime any{.preparation = Milliseconds(0), .stroke = {Milliseconds(0), Milliseconds(1000)}};
  for (const NonManual& one : utterance.non_manuals) curve_of(one, any, any, options, pronouncer, notices);
}

}  // namespace signweave
