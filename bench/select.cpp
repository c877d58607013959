// The cost of choosing one token per place: utterances of 1,000 and of 10,000 places (`--quick`: 200 and 2,000) with
// 100 tokens each, against a plain loop over the same pairs of tokens and against the aim of 50 ms; three places ahead;
// and the complete selection on a database.

#include <random>

#include "bench/measure.h"
#include "signweave/choose/select.h"
#include "signweave/notation/utterance.h"
#include "tests/demo_database.h"

namespace {

using namespace signweave;

constexpr std::size_t kTokens = 100;
constexpr std::size_t kGlosses = 400;  // different ones

/// How tokens are distributed.
enum class Corpus {
  glosses,  ///< a gloss has its position and shape; its tokens differ by a fifth of the difference between glosses
  blur,     ///< anywhere: tokens of one gloss are not similar to each other, so few can be skipped
};

std::vector<std::shared_ptr<const JoinEnds>> make_glosses(Corpus corpus) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  std::vector<std::shared_ptr<const JoinEnds>> glosses;
  const auto point = [&](const JoinPoint* around) {
    JoinPoint made{.values = {}, .known = 127};
    for (std::size_t i = 0; i < JoinPoint::kSize; ++i) {
      made.values[i] =
          (around != nullptr ? around->values[i] : 0.0f) + (around != nullptr ? 0.1f : 0.5f) * normal(random);
    }
    return made;
  };
  for (std::size_t gloss = 0; gloss < kGlosses; ++gloss) {
    const JoinPoint begin = point(nullptr);
    const JoinPoint end = point(nullptr);
    std::vector<JoinPoint> begins;
    std::vector<JoinPoint> ends;
    for (std::size_t token = 0; token < kTokens; ++token) {
      begins.push_back(point(corpus == Corpus::glosses ? &begin : nullptr));
      ends.push_back(point(corpus == Corpus::glosses ? &end : nullptr));
    }
    glosses.push_back(std::make_shared<const JoinEnds>(begins, ends));
  }
  return glosses;
}

std::vector<PlaceCosts> make_places(Corpus corpus, std::size_t count) {
  const std::vector<std::shared_ptr<const JoinEnds>> glosses = make_glosses(corpus);
  std::mt19937 random(2);
  std::vector<PlaceCosts> places(count);
  for (PlaceCosts& place : places) {
    place.ends = glosses[random() % glosses.size()];
    place.made_before.assign(kTokens, 0);
    place.made_after.assign(kTokens, 0);
    place.kept.assign(kTokens, PlaceCosts::kNone);
    for (std::size_t i = 0; i < kTokens; ++i) place.own.push_back(random() % 2 == 0 ? 0.1f : 0.0f);
  }
  return places;
}

/// Every pair once, in a plain loop.
double bare(const std::vector<PlaceCosts>& places) {
  double total = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    for (std::size_t b = 0; b < kTokens; ++b) {
      float least = 1e9f;
      for (std::size_t a = 0; a < kTokens; ++a) {
        const JoinPoint& from = places[i - 1].ends->end(a);
        const JoinPoint& to = places[i].ends->begin(b);
        float sum = 0;
        for (std::size_t k = 0; k < JoinPoint::kSize; ++k) {
          const float difference = from.values[k] - to.values[k];
          sum += difference * difference;
        }
        least = std::min(least, sum);
      }
      total += static_cast<double>(least);
    }
  }
  return total;
}

void on_made_tokens(Corpus corpus, std::string_view name, std::size_t count, int rounds) {
  const JoinScale scale;
  const std::vector<PlaceCosts> places = make_places(corpus, count);
  const std::vector<PlaceCosts> many = make_places(corpus, 10 * count);
  const auto best = [&](const std::vector<PlaceCosts>& of) { bench::keep(best_path(of, scale)); };
  bench::print(fmt::format("select/{}/{}_places", name, count), 1e3, "ms",
               bench::compare(
                   rounds, [&] { best(places); }, [&] { bench::keep(bare(places)); }),
               "<= 0.5");
  const double whole = bench::median([&] {
    std::vector<double> seconds;
    for (int i = 0; i < rounds; ++i) seconds.push_back(bench::seconds_of([&] { best(places); }));
    return seconds;
  }());
  const double aim = 0.05 * static_cast<double>(count);  // ms
  bench::print(fmt::format("select/{}/{}_places_against_the_aim", name, count), 1e3 * whole, "ms", aim,
               1e3 * whole / aim, "<= 1");
  const bench::Compared longer = bench::compare(
      rounds, [&] { best(many); }, [&] { best(places); });
  bench::print(fmt::format("select/{}/a_place_of_{}_against_{}", name, 10 * count, count),
               1e6 * longer.ours / static_cast<double>(10 * count), "us",
               1e6 * longer.yardstick / static_cast<double>(count), longer.ratio / 10, "<= 1.3");
  const auto ahead = [&] {
    PathAhead path(scale);
    for (const PlaceCosts& place : places) bench::keep(path.push(place));
    bench::keep(path.finish());
  };
  bench::print(fmt::format("select/{}/three_ahead", name), 1e3, "ms",
               bench::compare(rounds, ahead, [&] { best(places); }), "-");
  PathAhead path(scale);
  std::vector<std::size_t> chosen;
  for (const PlaceCosts& place : places) {
    if (const auto decided = path.push(place)) chosen.push_back(*decided);
  }
  for (const std::size_t rest : path.finish()) chosen.push_back(rest);
  const double total = path_cost(places, chosen, scale);
  const double least = best_path(places, scale).total;
  bench::print(fmt::format("select/{}/cost_three_ahead", name), total, "cost", least, total / least, "<= 1.05");
}

/// 1,000 signs from a few minutes of the demo corpus, including the lookup of candidates.
void on_database(double minutes, int rounds) {
  constexpr int kPlaces = 1000;
  const bench::Folder folder("select");
  const std::unique_ptr<const Database> database = demo_database(folder.path() / "db", demo::corpus_scripts(minutes));
  const Snapshot snapshot = database->snapshot();
  const std::vector<std::string> glosses = snapshot.contents().segments.glosses();
  std::mt19937 random(3);
  Utterance utterance;
  for (int i = 0; i < kPlaces; ++i) {
    utterance.places.push_back(place_of({glosses[random() % glosses.size()], 0}));
  }
  std::vector<Choice> choices;
  const auto look_up = [&] {
    choices.clear();
    for (const Place& place : utterance.places) {
      choices.push_back({candidates_for(snapshot.contents(), place), place.pause_before});
    }
  };
  look_up();
  const double first = bench::seconds_of([&] { bench::keep(select(snapshot, choices)); });
  const bench::Compared compared = bench::compare(
      rounds, [&] { bench::keep(select(snapshot, choices)); }, look_up);
  std::size_t candidates = 0;
  for (const Choice& choice : choices) candidates += choice.candidates.size();
  fmt::print("select/database: {} signs of {} glosses, {} candidates\n", kPlaces, glosses.size(), candidates);
  bench::print("select/database/against_looking_candidates_up", 1e3, "ms", compared, "-");
  bench::print("select/database/the_first_time", 1e3 * first, "ms", 1e3 * compared.ours, first / compared.ours, "-");
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::string_view(argv[1]) == "--quick";
  const int rounds = quick ? 3 : 15;
  const std::size_t places = quick ? 200 : 1000;
  on_made_tokens(Corpus::glosses, "glosses", places, rounds);
  on_made_tokens(Corpus::blur, "blur", places, rounds);
  on_database(quick ? 2 : 20, quick ? 3 : 9);
}
