#include "signweave/score/provenance.h"

#include <fmt/format.h>

#include <algorithm>

namespace signweave {
namespace {

Annotation annotation(TimeSpan span, std::string label, std::string id, std::string parent = {}) {
  return {.id = std::move(id), .label = std::move(label), .span = span, .parent = std::move(parent)};
}

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
  Tier gloss{.id = "Gloss", .type = "gloss"};
  Tier phase{.id = "Phase", .type = "phase", .parent = "Gloss"};
  Tier place{.id = "Place", .type = "place", .parent = "Gloss"};
  Tier source{.id = "Source", .type = "source"};
  Tier junction{.id = "Junction", .type = "junction"};

  const FrameClock clock{synthesis.motion.rate().frame_time(), Seconds(0)};
  int next = 1;
  const auto new_id = [&] { return fmt::format("a{}", next++); };
  for (const PlacedSign& placed : synthesis.signs) {
    if (placed.sign.span.duration() <= Milliseconds(0)) continue;
    const std::string id = new_id();
    gloss.annotations.push_back(annotation(placed.sign.span, placed.sign.gloss, id));
    place.annotations.push_back(
        annotation(placed.sign.span, fmt::format("{}, clip {}", placed.place, placed.clip), new_id(), id));
    for (const Phase& one : placed.sign.phases) {
      phase.annotations.push_back(annotation(one.span, one.label, new_id(), id));
    }
  }
  for (std::size_t i = 0; i < synthesis.clips.size(); ++i) {
    const ShownClip& placed = synthesis.clips[i];
    const double frames = static_cast<double>(placed.output.end - placed.core.begin) * placed.step;
    const double before = static_cast<double>(placed.core.begin - placed.output.begin) * placed.step;
    source.annotations.push_back(
        annotation(span_of(placed.output, clock),
                   fmt::format("clip {}, place {}: {} frames {:.10g}..{:.10g}{}", i, synthesis.score.clips[i].place,
                               placed.recording, placed.first_frame - before, placed.first_frame + frames,
                               synthesis.score.clips[i].mirrored ? ", mirrored" : ""),
                   new_id()));
  }
  for (std::size_t i = 0; i < synthesis.junctions.size(); ++i) {
    const Junction& one = synthesis.junctions[i];
    const TimeSpan span = span_of(one.frames, clock);
    if (span.duration() <= Milliseconds(0)) continue;
    junction.annotations.push_back(
        annotation(span,
                   fmt::format("clip {} -> {}: {} {} ms: {} -> {} (m_i {}, m_j {}, p {})", i, i + 1, one.method,
                               span.duration().count(), one.from, one.to, one.cut.retraction_frames,
                               one.cut.preparation_frames, one.cut.blend_frames),
                   new_id()));
  }
  document.properties.emplace_back("lastUsedAnnotationId", fmt::format("{}", next - 1));
  document.tiers = {std::move(gloss), std::move(phase), std::move(place), std::move(source), std::move(junction)};
  return document;
}

}  // namespace signweave
