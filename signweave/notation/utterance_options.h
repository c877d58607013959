#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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

struct OptionToken {
  std::string text;
  bool quoted = false;
  WordSpan at;
  bool is(std::string_view word) const { return !quoted && text == word; }
};
/// The texts of tokens with single blanks between them.
std::string joined(std::span<const OptionToken> tokens);

/// An option before it is known what it asks for.
struct RawOption {
  std::vector<OptionToken> tokens;  ///< without its extent
  std::optional<Extent> extent;
  bool faulty = false;  ///< a fault was reported
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

enum class OptionsOf : std::uint8_t {
  place,  ///< to the `}`
  scope,  ///< to the `:`, behind which its places are
};

/// A value of a place's SpaceChange.
enum class SpaceValue : std::uint8_t {
  from,
  to,
  at,
  along,
  past,
  unturned,
  move,
  turn,
  scale,
  size,
  speed,
  repeat,  ///< also whether it goes outward
  mirrored,
};
/// A value that names a locus that is not built in.
struct LocusUse {
  SpaceValue value = SpaceValue::to;
  std::string name;
  WordSpan at;
};
struct LocusOption {
  LocusSetup setup;
  WordSpan at;
};
/// What options say about space.
struct SpaceOptions {
  SpaceChange change;
  std::uint16_t given = 0;     ///< the values of `change`, one bit each
  WordSpan one_place_at;       ///< the last option for a single place
  std::vector<LocusUse> uses;  ///< in `change`
  std::vector<LocusOption> loci;
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
  SpaceOptions space;
};

/// Reads options from behind their `{`. Moves behind what closes them, or to where nothing can be read. Faulty options
/// are reported and left out.
Options read_options(Cursor& cursor, OptionsOf of);

}  // namespace signweave::utterances
