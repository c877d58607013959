#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/notation/utterance.h"

/// The words of utterances, and a cursor that reads them. Only for the sources of utterances in this folder.
namespace signweave::utterances {

/// Where a word stands, which determines the characters that end it.
enum class Context : std::uint8_t {
  text,     ///< outside of everything: brackets
  scope,    ///< brackets; `}` closes it
  bracket,  ///< brackets and `|`; `|` and `]` close what is before them
  option,   ///< brackets and `;`; `;` and `}` close it
  label,    ///< as option, and `:`
};

bool is_blank(char c) noexcept;
/// True if `c` ends what a word of this context belongs to.
bool closes(char c, Context context) noexcept;

/// Digits alone; none if they are too many.
std::optional<std::size_t> whole_number(std::string_view text);

/// "@1200..3400" at the end of a word.
struct PieceSuffix {
  std::size_t at = std::string_view::npos;
  TimeSpan span;
};
PieceSuffix piece_suffix(std::string_view word);
/// The begin of "#3" at the end of a bare word. A word that consists of it alone ("#3") is a gloss.
std::size_t token_suffix(std::string_view word);

/// One word of the syntax.
struct Word {
  WordSpan at;
  std::string text;      ///< without its quotes
  bool quoted = false;   ///< it began with a quote
  bool closed = true;    ///< it ends with the same
  bool literal = false;  ///< it is quoted, or a gloss of UtteranceWords
  std::string suffix;    ///< the text after the closing quote, or "#3" and "@1..2" of a bare word

  bool is_pause() const noexcept { return !quoted && suffix.empty() && (text == "," || text == "."); }
};

/// What a word asks for, or what is wrong with it.
struct SignReading {
  SignRef sign;
  std::optional<UtteranceFault> fault{};
};
SignReading read_sign(const Word& word, std::string_view text);

/// A name in quotes.
std::string in_quotes(std::string_view name);
/// A name in the form in which it must be typed: outside of everything, or anywhere.
std::string quoted_if_needed(std::string_view name);
std::string quoted_if_needed_inside(std::string_view name);

/// A position in a text, and the faults so far. `text` and `words` must outlive it.
class Cursor {
 public:
  Cursor(std::string_view text, const UtteranceWords& words) : text_(text), words_(words) {}

  std::size_t at = 0;
  bool stopped = false;  ///< nothing more can be read: brackets are too deep

  std::string_view text() const noexcept { return text_; }
  const UtteranceWords& words() const noexcept { return words_; }
  bool ended() const noexcept { return at >= text_.size(); }
  /// The character here; NUL at the end.
  char here() const noexcept { return ended() ? '\0' : text_[at]; }
  bool ends_word() const noexcept { return ended() || is_blank(text_[at]); }
  void skip_blanks() noexcept;

  /// The word that begins here, which is not a blank; at least one character, also if that would end it. Moves behind
  /// it.
  Word word(Context context);
  /// The text between quotes, the first of which is here. Moves behind the second.
  Word quotation();
  /// The end of the run of characters from here without blanks and without what closes `context`.
  std::size_t run_end(std::size_t from, Context context) const noexcept;
  /// Moves to the first character outside quotes that closes `context`, or to the end.
  void skip_to(Context context) noexcept;
  /// Moves behind the bracket that closes the one here, whatever kinds they are, and returns true; stays here if there
  /// is none. Reports brackets that are too deep, and stops.
  bool skip_brackets();

  void report(UtteranceFault::Kind kind, WordSpan span, std::string message, std::string replacement = {});
  void report(UtteranceFault fault);
  /// Reports the run from `begin` to the end of the brackets here, or of the word, as one that may be a gloss without
  /// its quotes, and moves behind it.
  void report_unquoted(UtteranceFault::Kind kind, std::size_t begin, Context context, std::string message);
  std::size_t fault_count() const noexcept { return count_; }
  /// Goes back to a position and the faults that were known there.
  void go_back(std::size_t position, std::size_t faults);
  std::vector<UtteranceFault>& faults() noexcept { return faults_; }

 private:
  std::optional<Word> known_gloss(std::size_t begin, std::size_t end, Context context) const;

  std::string_view text_;
  const UtteranceWords& words_;
  std::vector<UtteranceFault> faults_;
  std::size_t count_ = 0;  ///< of all faults, of which the first are kept
};

/// The signs of a part up to what closes `context`, or one hold.
struct PartReading {
  std::vector<PartSign> signs;
  std::optional<WordSpan> hold;
  std::optional<WordSpan> rest;  ///< the first of its rests
  bool sound = true;             ///< false: a fault was reported
};
PartReading read_part(Cursor& cursor, Context context);

/// The part of a label such as "weak", "right fingers", "fingers right" or "fingers".
std::optional<BodyPart> body_part_of(std::string_view label);
/// True for hands, which can be held and can rest.
bool is_hand(BodyPart part) noexcept;
/// "+200" or "-40"; none if it is not such a number of at most kMostUtteranceOffset.
std::optional<Milliseconds> offset_of(std::string_view text);
/// The name of an expression as an option, in quotes if it needs them.
std::string expression_text(const std::string& name);
/// Reports a label that is no part.
void report_unknown_part(Cursor& cursor, WordSpan span, std::string_view label);
/// False if `part` cannot rest, although `reading` has a rest; reports it. `begin` is that of the part.
bool check_rest(Cursor& cursor, const PartReading& reading, BodyPart part, std::size_t begin);

}  // namespace signweave::utterances
