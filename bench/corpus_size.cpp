// The cost of a synthesis in a large corpus against a small one. The utterance and its tokens are the same; the large
// corpus holds a hundred times as many other recordings.
//
// Arguments: --quick takes 20 and 200 recordings instead of 100 and 10,000.

#include "bench/measure.h"
#include "signweave/choose/synthesizer.h"
#include "signweave/database/test_signing.h"
#include "signweave/notation/utterance.h"

namespace {

using namespace signweave;

constexpr int kWithTokens = 10;  ///< recordings that have the glosses of the utterance

/// Recordings of three seconds and seven signs each. The learned data is stored, as after an import.
void fill(const std::filesystem::path& folder, int recordings) {
  Database::create(folder, {});
  Database database(folder, kv::Access::read_write);
  for (int i = 0; i < recordings; ++i) {
    std::vector<std::string> glosses = {"A", "B", "C", "A", "B", "C", "B"};
    if (i >= kWithTokens) {
      for (std::string& gloss : glosses) gloss += std::to_string(i);
    }
    database.put(testing_database::recording_of(fmt::format("r{:06}", i), i % 7, glosses));
  }
  database.merge();
  database.learn();
}

}  // namespace

int main(int count, char** arguments) {
  const bool quick = count > 1 && std::string_view(arguments[1]) == "--quick";
  const int few = quick ? 20 : 100;
  const int many = quick ? 200 : 10'000;
  const bench::Folder folder("corpus_size");
  const auto few_folder = folder.path() / "few.db";
  const auto many_folder = folder.path() / "many.db";
  fill(few_folder, few);
  fill(many_folder, many);
  const Utterance utterance = parse_utterance("A B C B A C A C B");
  const auto name = [&](const char* what) { return fmt::format("corpus_size/{}_{}_against_{}", what, many, few); };
  {
    const Database small(few_folder, kv::Access::read_only);
    const Database large(many_folder, kv::Access::read_only);
    const auto sign = [&](const Database& database) { bench::keep(synthesize(database, utterance).timings.total); };
    bench::print(name("synthesis"), 1e3, "ms",
                 bench::compare(
                     quick ? 11 : 301, [&] { sign(large); }, [&] { sign(small); }),
                 "<= 1.1");
  }
  const auto open_and_sign = [&](const std::filesystem::path& of) {
    const Database database(of, kv::Access::read_only);
    bench::keep(synthesize(database, utterance).timings.total);
  };
  bench::print(name("open_and_synthesis"), 1e3, "ms",
               bench::compare(
                   quick ? 3 : 11, [&] { open_and_sign(many_folder); }, [&] { open_and_sign(few_folder); }),
               "-");
}
