#include "signweave/score/provenance.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/score/lane_chain.h"

namespace signweave {
namespace {

Annotation annotation(TimeSpan span, std::string label, std::string id, std::string parent = {}) {
  return {.id = std::move(id), .label = std::move(label), .span = span, .parent = std::move(parent)};
}

/// Adds tiers to a document whose annotations are numbered in order.
class TierWriter {
 public:
  explicit TierWriter(const Synthesis& synthesis)
      : synthesis_(synthesis), clock_{synthesis.motion.rate().frame_time(), Seconds(0)} {}

  /// The signs of one channel, their phases and places. `suffix` is "" or, such as " left", names the channel.
  void add_signs(Channel channel, const std::string& suffix) {
    Tier gloss{.id = "Gloss" + suffix, .type = "gloss"};
    Tier phase{.id = "Phase" + suffix, .type = "phase", .parent = gloss.id};
    Tier place{.id = "Place" + suffix, .type = "place", .parent = gloss.id};
    for (const PlacedSign& placed : synthesis_.signs) {
      if (placed.channel != channel || placed.sign.span.duration() <= Milliseconds(0)) continue;
      const std::string id = new_id();
      gloss.annotations.push_back(annotation(placed.sign.span, placed.sign.gloss, id));
      place.annotations.push_back(
          annotation(placed.sign.span, fmt::format("{}, clip {}", placed.place, placed.clip), new_id(), id));
      for (const Phase& one : placed.sign.phases) {
        phase.annotations.push_back(annotation(one.span, one.label, new_id(), id));
      }
    }
    tiers_.insert(tiers_.end(), {std::move(gloss), std::move(phase), std::move(place)});
  }

  /// The clips of the whole body and the transitions between them.
  void add_body() {
    Tier source{.id = "Source", .type = "source"};
    Tier junction{.id = "Junction", .type = "junction"};
    const std::size_t body = body_clips(synthesis_.score);
    for (std::size_t i = 0; i < body; ++i) {
      const ShownClip& placed = synthesis_.clips[i];
      source.annotations.push_back(annotation(span_of(placed.output, clock_), source_of(i, placed.output), new_id()));
    }
    for (std::size_t i = 0; i < synthesis_.junctions.size(); ++i) {
      const Junction& one = synthesis_.junctions[i];
      const TimeSpan span = span_of(one.frames, clock_);
      if (span.duration() <= Milliseconds(0)) continue;
      junction.annotations.push_back(
          annotation(span,
                     fmt::format("clip {} -> {}: {} {} ms: {} -> {} (m_i {}, m_j {}, p {})", i, i + 1, one.method,
                                 span.duration().count(), one.from, one.to, one.cut.retraction_frames,
                                 one.cut.preparation_frames, one.cut.blend_frames),
                     new_id()));
    }
    tiers_.insert(tiers_.end(), {std::move(source), std::move(junction)});
  }

  /// All items of a lane.
  void add_lane(const Lane& lane) {
    const std::string suffix = suffix_of(lane.channel);
    const bool has_signs =
        std::ranges::find(synthesis_.signs, lane.channel, &PlacedSign::channel) != synthesis_.signs.end();
    if (has_signs) add_signs(lane.channel, suffix);
    Tier source{.id = "Source" + suffix, .type = "source"};
    Tier junction{.id = "Junction" + suffix, .type = "junction"};
    Tier hold{.id = "Hold" + suffix, .type = "hold"};
    Tier rest{.id = "Rest" + suffix, .type = "rest"};
    for (const Item& item : lane.items) {
      const TimeSpan span = span_of(item.at, clock_);
      if (span.duration() <= Milliseconds(0)) continue;
      if (const auto* const use = std::get_if<ClipUse>(&item.what)) {
        std::string text = source_of(use->clip, item.at);
        if (use->place) {
          text += fmt::format(", hand kept in {}, moved {:.0f} mm", signweave::name_of(use->place->kept_in),
                              use->place->moved_mm);
        }
        if (synthesis_.score.clips[use->clip].at_rest) rest.annotations.push_back(annotation(span, text, new_id()));
        source.annotations.push_back(annotation(span, std::move(text), new_id()));
      } else if (const auto* const held = std::get_if<Hold>(&item.what)) {
        if (synthesis_.score.clips[held->clip].at_rest) {  // a hold of a rest is a longer rest
          rest.annotations.back().span.end = span.end;
          continue;
        }
        hold.annotations.push_back(
            annotation(span, fmt::format("clip {}: {}", held->clip, synthesis_.clips[held->clip].recording), new_id()));
      } else {
        const Transition& made = std::get<Transition>(item.what);
        junction.annotations.push_back(
            annotation(span,
                       fmt::format("clip {} -> {}: {} {} ms (m_i {}, m_j {}, p {})", made.from, made.to,
                                   synthesis_.score.junctions[made.to - 1].method, span.duration().count(),
                                   made.cut.retraction_frames, made.cut.preparation_frames, made.cut.blend_frames),
                       new_id()));
      }
    }
    has_rests_ = has_rests_ || !rest.annotations.empty();
    for (Tier* const tier : {&source, &junction, &hold, &rest}) {
      if (!tier->annotations.empty()) tiers_.push_back(std::move(*tier));
    }
  }

  /// The authored movements of face, gaze and head.
  void add_curves() {
    const std::size_t first = tiers_.size();
    for (const AuthoredCurve& one : synthesis_.score.curves) {
      const std::string name = !one.curve.mouth.empty() ? "Mouth" : one.curve.gaze ? "Gaze" : "Expression";
      const TimeSpan span = span_of(one.at, clock_);
      Tier& tier = free_tier(first, name, span);
      tier.annotations.push_back(annotation(span, one.curve.name, new_id()));
    }
    for (std::size_t i = first; i < tiers_.size(); ++i) {
      std::ranges::sort(tiers_[i].annotations, {}, [](const Annotation& one) { return one.span.begin; });
    }
  }

  std::vector<Tier> take() { return std::move(tiers_); }
  int last_id() const noexcept { return next_ - 1; }
  bool has_rests() const noexcept { return has_rests_; }

 private:
  static std::string suffix_of(Channel channel) {
    std::string name(name_of(channel));
    std::ranges::replace(name, '_', ' ');
    return ' ' + name;
  }
  /// "clip 2, place 1: meteo frames 12..80": what output frames show of a clip.
  std::string source_of(std::size_t clip, FrameRange output) const {
    const ShownClip& placed = synthesis_.clips[clip];
    const double after = static_cast<double>(output.end - placed.core.begin) * placed.step;
    const double before = static_cast<double>(placed.core.begin - output.begin) * placed.step;
    std::string changes;
    for (const ClipChange& change : synthesis_.score.clips[clip].changes) {
      changes += fmt::format(", {} ({}: {:.0f} mm, {:.0f}°)", change.asked, name_of(change.basis), change.moved_mm,
                             change.turned_degrees);
    }
    return fmt::format("clip {}, place {}: {} frames {:.10g}..{:.10g}{}{}", clip, synthesis_.score.clips[clip].place,
                       placed.recording, placed.first_frame - before, placed.first_frame + after,
                       synthesis_.score.clips[clip].mirrored ? ", mirrored" : "", changes);
  }
  /// The first tier of a name, from `first` on, on which nothing overlaps a time; added if there is none.
  Tier& free_tier(std::size_t first, const std::string& name, TimeSpan span) {
    std::size_t number = 1;
    for (std::size_t i = first; i < tiers_.size(); ++i) {
      if (tiers_[i].type != "movement" || !tiers_[i].id.starts_with(name)) continue;
      const bool is_free = std::ranges::none_of(tiers_[i].annotations, [&](const Annotation& one) {
        return one.span.begin < span.end && span.begin < one.span.end;
      });
      if (is_free) return tiers_[i];
      ++number;
    }
    return tiers_.emplace_back(Tier{.id = number == 1 ? name : fmt::format("{} {}", name, number), .type = "movement"});
  }
  std::string new_id() { return fmt::format("a{}", next_++); }

  const Synthesis& synthesis_;
  FrameClock clock_;
  std::vector<Tier> tiers_;
  int next_ = 1;
  bool has_rests_ = false;
};

}  // namespace

AnnotationDocument annotation_of(const Synthesis& synthesis, const std::string& motion_file) {
  AnnotationDocument document;
  document.author = "signweave";
  document.date = "1970-01-01T00:00:00+00:00";  // constant, so that the same synthesis gives the same bytes
  if (!motion_file.empty()) {
    document.linked_files.push_back(
        {.url = motion_file, .relative_url = "./" + motion_file, .mime_type = "unknown", .media = false});
  }
  document.properties.emplace_back("signweave:synthesis",
                                   "made from captured clips; see the tiers Source and Junction");
  document.properties.insert(document.properties.end(), synthesis.declarations.begin(), synthesis.declarations.end());
  document.types = {{"gloss", Stereotype::none, {}},
                    {"phase", Stereotype::time_subdivision, {}},
                    {"place", Stereotype::symbolic_association, {}},
                    {"source", Stereotype::none, {}},
                    {"junction", Stereotype::none, {}}};
  TierWriter writer(synthesis);
  writer.add_signs(Channel::body, {});
  writer.add_body();
  const std::vector<const Lane*> lanes = lanes_that_differ(synthesis.score);
  for (const Lane* const lane : lanes) writer.add_lane(*lane);
  writer.add_curves();
  if (!synthesis.score.curves.empty()) document.types.push_back({"movement", Stereotype::none, {}});
  if (!lanes.empty()) document.types.push_back({"hold", Stereotype::none, {}});
  if (writer.has_rests()) document.types.push_back({"rest", Stereotype::none, {}});
  document.properties.emplace_back("lastUsedAnnotationId", fmt::format("{}", writer.last_id()));
  document.tiers = writer.take();
  return document;
}

}  // namespace signweave
