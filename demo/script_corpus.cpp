#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "demo/script.h"

namespace signweave::demo {
namespace {

using Words = std::vector<std::string_view>;

/// The word classes of the grammar. Every word of the sign table belongs to at least one.
const std::map<std::string_view, Words> kWords = {
    {"greeting", {"BONJOUR", "ATTENTION"}},
    {"news", {"METEO", "LE-TEMPS-PREVU", "CE-SERA-LE-MOMENT"}},
    {"day",
     {"LUNDI", "MARDI", "MERCREDI", "JEUDI", "VENDREDI", "SAMEDI", "DIMANCHE", "HIER", "AUJOURD'HUI", "DEMAIN",
      "APRES-DEMAIN"}},
    {"time", {"MATIN", "MIDI", "APRES-MIDI", "SOIR", "NUIT", "MAINTENANT"}},
    {"season", {"SEMAINE", "WEEK-END", "PRINTEMPS", "ETE", "AUTOMNE", "HIVER", "JANVIER", "SIX JUILLET"}},
    {"region", {"FRANCE", "BRETAGNE", "NORD", "SUD", "OUEST", "EST", "CENTRE", "MONTAGNE", "EN-MER"}},
    {"weather",
     {"SOLEIL-BRILLER", "CHAUD-SEC-FERA", "NUAGES", "PLUIE", "BROUILLARD", "VENT", "ORAGE", "NEIGE", "FROID", "GRELE",
      "GEL", "HUMIDE", "ECLAIRCIE", "ARC-EN-CIEL"}},
    {"much", {"FORT", "PEU", "BEAUCOUP", "PEUT-ETRE"}},
    {"number", {"UN", "DEUX", "TROIS", "CINQ", "DIX", "VINGT"}},
    {"city",
     {"VANNES", "MARSEILLE", "RENNES", "LE MANS", "PARIS", "LYON", "BREST", "NANTES", "QUIMPER", "LORIENT", "BORDEAUX",
      "TOULOUSE", "LILLE", "SAINT-MALO", "STRASBOURG"}},
    {"doing", {"INVITER", "ALLER", "ARRIVER", "PARTIR", "VOIR", "TRAVAILLER", "ATTENDRE", "NAGER"}},
    {"whom", {"VOUS", "POINTER-DROITE", "POINTER-GAUCHE"}},
    {"farewell", {"MERCI", "AU-REVOIR"}},
};

/// Recordings of one kind: a first sentence, sentences in any order, a last one. A lower-case word is any word of that
/// class, an upper-case word is that word itself; a question mark omits it every other time.
struct Theme {
  std::string_view name;
  Milliseconds mean, deviation;  ///< of transitions: between those of meteo and of villes
  float sink;
  std::string_view first;
  std::vector<std::string_view> sentences;
  std::string_view last;
};

const Theme kThemes[] = {
    {"bulletin",
     755ms,
     228ms,
     0.14f,
     "greeting METEO region day",
     {"day time region weather much?", "region weather time weather much?", "region TEMPERATURE number DEGRES time?",
      "city time weather city weather much?", "day region weather region weather time weather",
      "news day weather whom"},
     "news farewell whom day"},
    {"villes",
     1040ms,
     282ms,
     0.68f,
     "greeting FRANCE city city",
     {"city city city city", "city city whom city city", "region city city city city?",
      "city city city region city city"},
     "city city city farewell"},
    {"semaine",
     840ms,
     244ms,
     0.26f,
     "greeting SEMAINE day time",
     {"day doing city time whom?", "day whom doing time weather?", "day time doing day time doing",
      "season day number day doing much?", "whom day TRAVAILLER much? time city"},
     "WEEK-END doing whom farewell"},
    {"saisons",
     800ms,
     236ms,
     0.20f,
     "greeting news season region",
     {"season region weather much weather?", "season TEMPERATURE number DEGRES much",
      "season weather region season weather", "region season time weather doing?",
      "season much weather whom VOIR weather"},
     "season weather much farewell"},
    {"voyage",
     920ms,
     260ms,
     0.40f,
     "greeting whom INVITER city",
     {"whom ALLER city day time", "city ARRIVER time weather much?", "whom INVITER whom city season?",
      "PARTIR city time ARRIVER city time", "day city number season? doing whom",
      "city VOIR EN-MER NAGER much weather?"},
     "city PARTIR farewell day"},
};

Words split(std::string_view text) {
  Words words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (end > 0) words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

/// Writes sentences, and counts how often each word was used.
class Author {
 public:
  explicit Author(std::uint64_t seed) : random_(seed) {}

  void count(const Script& script) {
    for (const auto& unit : script.units) {
      for (const std::string_view gloss : unit) ++used_[gloss];
    }
  }

  std::vector<std::string_view> sentence(std::string_view pattern) {
    std::vector<std::string_view> glosses;
    for (std::string_view word : split(pattern)) {
      if (word.ends_with('?')) {
        word.remove_suffix(1);
        if (random_.uniform() < 0.5) continue;
      }
      const auto kind = kWords.find(word);
      const std::string_view gloss = kind == kWords.end() ? word : rarest(kind->second, glosses);
      ++used_[gloss];
      glosses.push_back(gloss);
    }
    return glosses;
  }

  const std::string_view& any(const std::vector<std::string_view>& choices) {
    return choices[random_.bits() % choices.size()];
  }

 private:
  /// Usually one of the least used words; never one already in the sentence.
  std::string_view rarest(const Words& words, const std::vector<std::string_view>& taken) {
    std::string_view best;
    double least = 0;
    for (const std::string_view word : words) {
      if (std::find(taken.begin(), taken.end(), word) != taken.end()) continue;
      const double score = used_[word] + 2.5 * random_.uniform();
      if (best.empty() || score < least) {
        best = word;
        least = score;
      }
    }
    return best.empty() ? words.front() : best;
  }

  Random random_;
  std::map<std::string_view, int> used_;
};

Script write_script(const Theme& theme, std::string name, double seconds, Author& author) {
  Script script{.name = std::move(name),
                .units = {author.sentence(theme.first)},
                .transition_mean = theme.mean,
                .transition_deviation = theme.deviation,
                .sink = theme.sink};
  const std::vector<std::string_view> last = author.sentence(theme.last);
  const auto with_last = [&] {
    Script whole = script;
    whole.units.push_back(last);
    return whole;
  };
  constexpr double kSentence = 8;  // approximate, seconds
  while (expected_seconds(with_last()) + 0.5 * kSentence < seconds) {
    script.units.push_back(author.sentence(author.any(theme.sentences)));
  }
  return with_last();
}

}  // namespace

std::vector<Script> corpus_scripts(double minutes) {
  std::vector<Script> scripts = {meteo(), villes()};
  double made = 0;
  Author author(20'090'914);
  for (const Script& script : scripts) {
    made += expected_seconds(script);
    author.count(script);
  }
  const auto further = static_cast<int>(std::max(0.0, std::round((60 * minutes - made) / 120)));
  for (int i = 0; i < further; ++i) {
    // The next recordings compensate for one that is longer or shorter.
    const double seconds = (60 * minutes - made) / (further - i);
    const Theme& theme = kThemes[static_cast<std::size_t>(i) % std::size(kThemes)];
    scripts.push_back(write_script(theme, fmt::format("{}-{:02}", theme.name, i + 1), seconds, author));
    made += expected_seconds(scripts.back());
  }
  return scripts;
}

}  // namespace signweave::demo
