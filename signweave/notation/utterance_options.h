#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "signweave/notation/utterance_word.h"

/// The options of places and scopes: what stands in braces. Only for the sources of utterances in this folder.
namespace signweave::utterances {

/// The place at which something ends, as an option names it.
struct Extent {
  enum class Kind : std::uint8_t {
    last,   ///< `..`: the last place of the utterance
    count,  ///< `..+2`: so many places on
    named,  ///< `..GLOSS`: the next place of that name
  };
  Kind kind = Kind::last;
  std::size_t count = 0;
  GlossRef name;
  WordSpan at;
};

struct PartOption {
  BodyPart part = BodyPart::weak;
  std::vector<PartSign> signs;
  std::optional<Extent> extent;  ///< none: the places of the options
  WordSpan at;
};
struct HoldOption {
  BodyPart hand = BodyPart::weak;
  Extent extent;
  WordSpan at;
};
struct NonManualOption {
  NonManual non_manual;  ///< without its places
  std::optional<Extent> extent;
};

struct Options {
  enum class End : std::uint8_t {
    complete,    ///< what closes them was read
    open_quote,  ///< a quote is never closed, which is reported
    broken,      ///< nothing closes them
  };
  End end = End::broken;
  std::vector<PartOption> parts;
  std::vector<HoldOption> holds;
  std::vector<NonManualOption> non_manuals;
  std::optional<Side> dominant;
};

enum class OptionsOf : std::uint8_t {
  place,  ///< to the `}`
  scope,  ///< to the `:`, behind which its places are
};
/// Reads options from behind their `{`. Moves behind what closes them, or to where nothing can be read. Faulty options
/// are reported and left out.
Options read_options(Cursor& cursor, OptionsOf of);

}  // namespace signweave::utterances
