#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signweave/notation/utterance_options.h"

/// Changes in space and loci, as options name them. Only for the sources of utterances in this folder.
namespace signweave::utterances {

inline constexpr std::array kSpaceValues = {
    SpaceValue::from,     SpaceValue::to,     SpaceValue::at,      SpaceValue::along, SpaceValue::past,
    SpaceValue::unturned, SpaceValue::move,   SpaceValue::turn,    SpaceValue::scale, SpaceValue::size,
    SpaceValue::speed,    SpaceValue::repeat, SpaceValue::mirrored};
/// The word of its option: "from", "to", …
std::string_view name_of(SpaceValue value) noexcept;
constexpr std::uint16_t bit_of(SpaceValue value) {
  return static_cast<std::uint16_t>(1U << static_cast<unsigned>(value));
}
/// True for values that a scope or a bracket gives to each of its places.
constexpr bool is_spread(SpaceValue value) {
  return value == SpaceValue::size || value == SpaceValue::speed || value == SpaceValue::mirrored;
}
void copy_value(SpaceValue value, const SpaceChange& from, SpaceChange& to);

/// A word that alone gives a value: "big", "mirrored".
struct SpaceWord {
  std::string_view word;
  SpaceValue value = SpaceValue::size;
  SpaceChange change;
};
const SpaceWord* find_space_word(std::string_view word) noexcept;

/// A word before numbers: "move 10/0/-5", "repeat 3".
struct SpaceNumbers {
  std::string_view word;
  SpaceValue value = SpaceValue::size;
  std::string_view expected;  ///< a fault's message
};
/// Null unless `word` is such a word and `numbers` begins as numbers do, although not as an offset.
const SpaceNumbers* find_space_numbers(std::string_view word, std::string_view numbers) noexcept;
/// None if the numbers are not what the word expects. Does not check their range.
std::optional<SpaceChange> change_of(const SpaceNumbers& word, std::string_view numbers);

/// True for the name of an expression that would be read as a change in space without its quotes.
bool is_space_option(std::string_view name) noexcept;

/// True if a colon that stands before a locus may follow: "from:@left".
bool may_have_colon(const RawOption& raw);
/// Reads an option that says something about space. False if this one does not. Faults are reported.
bool read_space_option(Cursor& cursor, const RawOption& raw, OptionsOf of, SpaceOptions& into);

/// The options of a change: "from @self to @a", "size 1.3".
std::vector<std::string> space_texts(const SpaceChange& change);
/// "@a = @left"
std::string setup_text(const LocusSetup& setup);

/// Consecutive places, inclusive.
struct PlaceRange {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Gives changes and loci to the places of an utterance while it is read.
class SpaceOfPlaces {
 public:
  /// Takes the options of a place, a bracket or a scope, inner ones first. What is spread goes to each place without
  /// its own.
  void take(SpaceOptions options, PlaceRange range, Utterance& utterance, Cursor& cursor);
  /// Hands over the loci. If the text is `sound`, that is without other faults, reports and leaves out the loci that
  /// are not known where they are used.
  void finish(Utterance& utterance, Cursor& cursor, bool sound);

 private:
  struct Use {
    LocusUse use;
    std::size_t place = 0;
  };
  void set_up(LocusOption option, std::size_t place, Cursor& cursor);
  void change(SpaceOptions options, std::size_t place, Utterance& utterance, Cursor& cursor);
  void spread(const SpaceOptions& options, PlaceRange range, Utterance& utterance);

  std::vector<std::uint16_t> given_;  ///< [place] the values that it was given, one bit each
  std::vector<LocusOption> setups_;
  std::set<std::pair<std::size_t, std::string>> taken_;  ///< the places and names of `setups_`
  std::vector<Use> uses_;
};

}  // namespace signweave::utterances
