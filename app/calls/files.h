#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/calls/characters.h"
#include "signweave/annotation/document.h"
#include "signweave/choose/synthesizer.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/motion/motion.h"
#include "signweave/rig/rig_map.h"

namespace signweave::calls {

/// ".bvh", ".face.csv", …: in small letters. Empty where a name has none.
std::string ending_of(const std::string& path);

/// Empty where `path` has one of these endings (in small letters); else what is wrong with it, in one line: the file,
/// its ending and what it may be.
std::string check_ending(const std::string& path, const std::vector<std::string_view>& endings);

/// The help of --signing-space.
inline constexpr const char* kSigningSpaceHelp = "in .svg: the signer's heights and zones behind each figure";

/// Throws Error{bad_input} where a signing space is to be drawn and no path is a contact sheet's.
void check_signing_space(bool wanted, const std::vector<std::string>& paths);

/// What heads a contact sheet and what else it shows.
struct SheetWishes {
  std::string title;
  bool signing_space = false;
  RigNames rig;  ///< what a mapping file said of the skeleton
};

struct Outgoing;

/// How a synthesis is written.
struct SynthesisLook {
  std::optional<bvh::Layout> layout;                ///< for .bvh
  bvh::LayoutWishes wishes;                         ///< what of it is to be otherwise
  SheetWishes sheet;                                ///< for .svg
  SharedCharacter character;                        ///< whose joints it has; for .glb
  std::function<void(double fraction)> progress{};  ///< of each file; may throw to cancel
};

/// The motion of a synthesis, for what writes one.
Outgoing outgoing(const Synthesized& made, const SynthesisLook& look);

// What follows writes by the table of file formats (signweave/formats/file_format.h) and throws Error{bad_input},
// before anything is written, for an ending that has no writer there.

/// Writes a synthesis to each path, by its ending. An annotation written beside a motion links it.
void write_synthesis(const std::vector<std::string>& paths, const Synthesized& made, const SynthesisLook& look);

/// The same as text or bytes, of one ending. `motion_file`: the name of the motion's own file, which an annotation
/// links; empty for none.
std::string synthesis_text(std::string_view ending, const Synthesized& made, const SynthesisLook& look,
                           const std::string& motion_file);

/// What there is of a recording to write. Borrowed.
struct Outgoing {
  const Motion* motion = nullptr;
  std::optional<bvh::Layout> layout;             ///< for .bvh
  bvh::LayoutWishes wishes{};                    ///< what of it is to be otherwise
  const AnnotationDocument* document = nullptr;  ///< for .eaf
  std::string title;
  bool signing_space = false;                                     ///< for .svg
  RigNames rig;                                                   ///< what a mapping file said of the skeleton
  std::vector<std::pair<std::string, std::string>> declarations;  ///< what its sources say of themselves
  SharedCharacter character{};                                    ///< whose joints the motion has; for .glb
  std::function<void(double fraction)> progress{};                ///< of each file; may throw to cancel
};

/// About how many bytes a motion takes as a file of this ending, estimated from some of its frames; 0 where that is
/// little, or the ending is one whose files are never large.
std::uint64_t estimated_bytes(const std::string& path, const Outgoing& recording);
/// Throws Error{io} where a file of so many bytes has no room on the disk that it would be on.
void require_room(const std::string& path, std::uint64_t bytes);

/// Writes a motion or, to .eaf, an annotation document. Throws Error{not_found} where what the ending asks for is not
/// there.
void write_recording(const std::string& path, const Outgoing& recording);
/// The same as text or bytes; `where` stands before the text of an error.
std::string recording_text(std::string_view ending, const Outgoing& recording, const std::string& where);

}  // namespace signweave::calls
