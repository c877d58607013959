#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "signweave/annotation/document.h"
#include "signweave/formats/bvh.h"
#include "signweave/motion/motion.h"
#include "signweave/synthesis/synthesizer.h"

namespace signweave::cli {

/// Empty where `path` has an ending that can be written; else what is wrong with it.
std::string check_output(const std::string& path);

/// Writes a synthesis to each path, by its ending. An annotation written beside a motion links it. `title` heads a
/// contact sheet.
void write_synthesis(const std::vector<std::string>& paths, const Synthesized& made,
                     const std::optional<bvh::Layout>& layout, const std::string& title);

/// Writes a motion (.bvh .csv .json .svg) or an annotation document (.eaf). Throws Error{not_found} where what the
/// ending asks for is not there.
void write_recording(const std::string& path, const Motion* motion, const std::optional<bvh::Layout>& layout,
                     const AnnotationDocument* document, const std::string& title);

/// Signs, stretches and junctions of a synthesis, without its poses.
nlohmann::json describe(const Synthesis& synthesis);

}  // namespace signweave::cli
