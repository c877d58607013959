// Queries over annotation by other authors, each answer compared with a plain loop over the result of the EAF reader.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <tuple>

#include "signweave/core/text.h"
#include "signweave/database/import.h"
#include "signweave/formats/eaf/eaf.h"
#include "signweave/kv/test_folder.h"
#include "signweave/query/parse.h"

namespace signweave {
namespace {

namespace fs = std::filesystem;

using testing::IsEmpty;
using testing::Not;

using Row = std::tuple<std::string, std::int64_t, std::int64_t>;  ///< recording, begin, end
using Rows = std::set<Row>;

/// An annotation as returned by the reader, its label without surrounding white space.
struct Read {
  std::string label;
  TimeSpan span{};
  std::string id;
  std::string parent;
  std::int64_t duration() const { return (span.end - span.begin).count(); }
};

struct File {
  std::string recording;
  std::map<std::string, std::vector<Read>> tiers;  ///< in time order
  std::string sign_tier;
  std::vector<Sign> signs;

  const std::vector<Read>& tier(const std::string& id) const {
    static const std::vector<Read> kNone;
    const auto at = tiers.find(id);
    return at == tiers.end() ? kNone : at->second;
  }
  /// The labelled annotations of the sign tier: its signs.
  std::vector<Read> glosses() const {
    std::vector<Read> result = tier(sign_tier);
    std::erase_if(result, [](const Read& one) { return one.label.empty(); });
    return result;
  }
};

bool overlap(TimeSpan a, TimeSpan b) {
  return std::max(a.begin, b.begin) < std::min(a.end, b.end);
}

/// All annotated shared files, imported once.
class SharedQueries : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new kv::TestFolder;
    Database::create(*folder_ / "db", {});
    database_ = new Database(*folder_ / "db", kv::Access::read_write);
    files_ = new std::vector<File>;
    import("eaf/mocapgrip", "EVENT", {});
    import("eaf/pympi", "text", "gest_included");
    import("bvh/ksl-always", "Gloss", "Phase");
    import("bvh/signon-thanks", "Gloss", "Phase");
    std::ranges::sort(*files_, {}, &File::recording);
  }
  static void TearDownTestSuite() {
    delete files_;
    delete database_;
    delete folder_;
  }

  static void import(const std::string& below, const std::string& sign_tier, const std::string& phase_tier) {
    ImportOptions options;
    options.sign_tiers = {{sign_tier, Hand::both, ""}};
    if (!phase_tier.empty()) options.phase_tiers = {phase_tier};
    for (const ImportJob& job : pair_files({fs::path(SIGNWEAVE_SHARED_DATA) / below}).jobs) {
      if (!job.annotation) continue;
      File file;
      file.sign_tier = sign_tier;
      file.recording = import_recording(*database_, job, options).name;
      const AnnotationDocument document = eaf::read(*job.annotation).document;
      for (const Tier& tier : document.tiers) {
        std::vector<Read>& list = file.tiers[tier.id];
        for (const Annotation& one : tier.annotations) {
          list.push_back({std::string(trimmed(one.label)), one.span, one.id, one.parent});
        }
        std::ranges::stable_sort(list, {}, [](const Read& one) { return std::pair(one.span.begin, one.span.end); });
      }
      file.signs = signs_in(document, database_->info(file.recording)->tiers).signs;
      files_->push_back(std::move(file));
    }
  }

  static Rows answers(const std::string& query) {
    Rows rows;
    const std::vector<Segment> found = database_->find(parse(query));
    for (const Segment& one : found) rows.emplace(one.recording, one.span.begin.count(), one.span.end.count());
    EXPECT_EQ(found.size(), rows.size()) << query << ": one of them twice";
    return rows;
  }

  /// The rows that a loop over all files adds.
  static Rows loop(const std::function<void(const File&, const std::function<void(TimeSpan)>&)>& look) {
    Rows rows;
    for (const File& file : *files_) {
      look(file, [&](TimeSpan span) { rows.emplace(file.recording, span.begin.count(), span.end.count()); });
    }
    return rows;
  }
  /// The annotations of a tier, or the signs if `tier` is empty, for which a predicate holds.
  static Rows those(const std::string& tier, const std::function<bool(const File&, const Read&)>& holds) {
    return loop([&](const File& file, const auto& add) {
      for (const Read& one : tier.empty() ? file.glosses() : file.tier(tier)) {
        if (holds(file, one)) add(one.span);
      }
    });
  }
  /// Expects these rows, and some: an empty answer would prove nothing.
  static void expect(const std::string& query, const Rows& rows) {
    EXPECT_EQ(answers(query), rows) << query;
    EXPECT_THAT(rows, Not(IsEmpty())) << query;
  }

  static kv::TestFolder* folder_;
  static Database* database_;
  static std::vector<File>* files_;
};

kv::TestFolder* SharedQueries::folder_ = nullptr;
Database* SharedQueries::database_ = nullptr;
std::vector<File>* SharedQueries::files_ = nullptr;

/// Pairs of signs of one recording in which the second directly follows the first.
void neighbours(const File& file, const std::function<void(const Read&, const Read&)>& look) {
  const std::vector<Read> signs = file.glosses();
  for (std::size_t i = 1; i < signs.size(); ++i) look(signs[i - 1], signs[i]);
}

TEST_F(SharedQueries, TheNumberOfFilesIsAsExpected) {
  EXPECT_GE(files_->size(), 37U);
  EXPECT_EQ(database_->contents()->recordings.size(), files_->size());
}

TEST_F(SharedQueries, EveryExampleOfTheInterfaceIsAnsweredAndThoseOfMissingSignsAreEmpty) {
  for (const char* query : {
           R"(gloss = "VANNES")",
           R"(gloss =~ /NUAGE.*/)",
           R"(gloss = "VANNES" & recording = "meteo")",
           R"(gloss = "VANNES" & phase = stroke)",
           R"(gloss = "MATIN" -> gloss = "NUAGES")",
           R"(gloss = "MATIN" ->[..500ms] gloss = "BROUILLARD")",
           R"(gloss = "PLUIE" overlaps tier("Mouthing") = "pluie")",
           R"(gloss = "VANNES" & end(right_hand).height > shoulder)",
       }) {
    EXPECT_THAT(answers(query), IsEmpty()) << query;
  }
  expect("phase = stroke & duration > 300ms", loop([](const File& file, const auto& add) {
           for (const Sign& sign : file.signs) {
             for (const Phase& phase : sign.phases) {
               if (phase.kind == PhaseKind::stroke && phase.span.duration() > 300ms) add(phase.span);
             }
           }
         }));
  EXPECT_EQ(answers("gloss = $X -> gloss = $X"), loop([](const File& file, const auto& add) {
              neighbours(file, [&](const Read& a, const Read& b) {
                if (a.label == b.label) add({a.span.begin, b.span.end});
              });
            }));
}

TEST_F(SharedQueries, FastStrokesAreStrokesOfRecordingsWithMotion) {
  const Rows strokes = loop([](const File& file, const auto& add) {
    if (!database_->info(file.recording)->motion) return;
    for (const Sign& sign : file.signs) {
      for (const Phase& phase : sign.phases) {
        if (phase.kind == PhaseKind::stroke) add(phase.span);
      }
    }
  });
  const Rows fast = answers("phase = stroke & speed(right_hand) > 1.5 m/s");
  const Rows moving = answers("phase = stroke & speed(right_hand) > 0.01 m/s");
  EXPECT_TRUE(std::ranges::includes(strokes, moving));
  EXPECT_TRUE(std::ranges::includes(moving, fast));
  EXPECT_EQ(moving.size(), strokes.size()) << "every one of these signers moves the right hand in each stroke";
  const Rows slow = answers("phase = stroke & speed(right_hand) <= 1.5 m/s");
  EXPECT_EQ(fast.size() + slow.size(), moving.size());
}

TEST_F(SharedQueries, LabelsAndExpressions) {
  expect(R"(gloss = "GRIP")", those("", [](const File&, const Read& one) { return one.label == "GRIP"; }));
  expect(R"(gloss =~ /gr.*|re.*/i)", those("", [](const File&, const Read& one) {
           return one.label.starts_with("GR") || one.label.starts_with("RE");
         }));
  expect(R"(gloss != "GRIP" & duration >= 1s)",
         those("", [](const File&, const Read& one) { return one.label != "GRIP" && one.duration() >= 1000; }));
  expect(R"(gloss = "THANKS" | gloss = "ALWAYS")",
         those("", [](const File&, const Read& one) { return one.label == "THANKS" || one.label == "ALWAYS"; }));
  expect(R"(tier("OVERLAPS") =~ /7 ACTION .*/)",
         those("OVERLAPS", [](const File&, const Read& one) { return one.label.starts_with("7 ACTION "); }));
  expect(R"(tier("words-timesub") = "fox" & begin > 60s & end <= 120s)",
         those("words-timesub", [](const File&, const Read& one) {
           return one.label == "fox" && one.span.begin > 60s && one.span.end <= 120s;
         }));
  expect(R"(gloss = "GRIP" & recording =~ /.*TRIAL_00.*/)", those("", [](const File& file, const Read& one) {
           return one.label == "GRIP" && file.recording.find("TRIAL_00") != std::string::npos;
         }));
  expect(R"(gloss = "GRIP" & tier("TASK") = "ACTION")", those("", [](const File& file, const Read& one) {
           return one.label == "GRIP" && std::ranges::any_of(file.tier("TASK"), [&](const Read& task) {
                    return task.label == "ACTION" && overlap(task.span, one.span);
                  });
         }));
}

TEST_F(SharedQueries, Sequences) {
  expect(R"(gloss = "GRIP" -> gloss = "MOVEMENT")", loop([](const File& file, const auto& add) {
           neighbours(file, [&](const Read& a, const Read& b) {
             if (a.label == "GRIP" && b.label == "MOVEMENT") add({a.span.begin, b.span.end});
           });
         }));
  expect(R"(gloss = "OBSERVE" ->[500ms..4s] gloss = "RELEASE")", loop([](const File& file, const auto& add) {
           for (const Read& a : file.glosses()) {
             for (const Read& b : file.glosses()) {
               const Milliseconds gap = b.span.begin - a.span.end;
               if (a.label == "OBSERVE" && b.label == "RELEASE" && gap >= 500ms && gap <= 4s) {
                 add({a.span.begin, b.span.end});
               }
             }
           }
         }));
  expect(R"(gloss = "OBSERVE" -> @gloss = "GRIP")", loop([](const File& file, const auto& add) {
           neighbours(file, [&](const Read& a, const Read& b) {
             if (a.label == "OBSERVE" && b.label == "GRIP") add(b.span);
           });
         }));
}

TEST_F(SharedQueries, RelationsInTime) {
  struct Relation {
    const char* word;
    bool (*holds)(TimeSpan, TimeSpan);
  };
  for (const Relation& relation :
       {Relation{"overlaps", [](TimeSpan a, TimeSpan b) { return overlap(a, b); }},
        Relation{"during", [](TimeSpan a, TimeSpan b) { return b.begin <= a.begin && a.end <= b.end; }},
        Relation{"starts", [](TimeSpan a, TimeSpan b) { return a.begin == b.begin; }},
        Relation{"ends", [](TimeSpan a, TimeSpan b) { return a.end == b.end; }}}) {
    expect(fmt::format(R"(gloss =~ /[A-Z]+/ {} tier("TASK") = "ACTION")", relation.word),
           those("", [&](const File& file, const Read& one) {
             const bool capitals = std::ranges::all_of(one.label, [](char c) { return c >= 'A' && c <= 'Z'; });
             return capitals && std::ranges::any_of(file.tier("TASK"), [&](const Read& task) {
                      return task.label == "ACTION" && relation.holds(one.span, task.span);
                    });
           }));
  }
  expect(R"(tier("EVENT") = "MOVEMENT" equals tier("OVERLAPS") =~ /7 .*/)",
         those("EVENT", [](const File& file, const Read& one) {
           return one.label == "MOVEMENT" && std::ranges::any_of(file.tier("OVERLAPS"), [&](const Read& other) {
                    return other.label.starts_with("7 ") && other.span == one.span;
                  });
         }));
}

const Read* find_id(const File& file, const std::string& id) {
  for (const auto& [name, tier] : file.tiers) {
    for (const Read& one : tier) {
      if (one.id == id) return &one;
    }
  }
  return nullptr;
}

TEST_F(SharedQueries, ParentsAndChildren) {
  expect(R"(tier("words-timesub") = "quick" & parent(gloss =~ /.* 00[1-9]/))",
         those("words-timesub", [](const File& file, const Read& one) {
           if (one.label != "quick") return false;
           const Read* parent = find_id(file, one.parent);
           return parent != nullptr && parent->label.size() > 4 &&
                  parent->label.compare(parent->label.size() - 4, 3, " 00") == 0 && parent->label.back() != '0';
         }));
  expect(R"(tier("words-pos") = "adj" & ancestor(gloss =~ /.*/))",
         those("words-pos", [](const File& file, const Read& one) {
           if (one.label != "adj") return false;
           const Read* word = find_id(file, one.parent);
           return word != nullptr && find_id(file, word->parent) != nullptr;
         }));
  expect(R"(gloss =~ /The .*/ & child(tier("words-symsub") = "001"))", those("", [](const File& file, const Read& one) {
           return one.label.starts_with("The ") &&
                  std::ranges::any_of(file.tier("words-symsub"),
                                      [&](const Read& word) { return word.parent == one.id && word.label == "001"; });
         }));
  expect(R"(gloss =~ /[A-Z].*/ & !child(phase = hold))", loop([](const File& file, const auto& add) {
           for (const Sign& sign : file.signs) {
             const bool hold =
                 std::ranges::any_of(sign.phases, [](const Phase& phase) { return phase.kind == PhaseKind::hold; });
             if (!hold && trimmed(sign.gloss).front() >= 'A' && trimmed(sign.gloss).front() <= 'Z') add(sign.span);
           }
         }));
}

TEST_F(SharedQueries, Units) {
  expect("unit & duration > 2s", loop([](const File& file, const auto& add) {
           std::optional<TimeSpan> unit;
           const auto finish = [&] {
             if (unit && unit->duration() > 2s) add(*unit);
           };
           for (const Read& sign : file.glosses()) {
             if (unit && sign.span.begin - unit->end < 1s) {
               unit->end = std::max(unit->end, sign.span.end);
             } else {
               finish();
               unit = sign.span;
             }
           }
           finish();
         }));
}

TEST_F(SharedQueries, VariablesAcrossTiers) {
  const std::string query = R"(tier("words-timesub") = $X overlaps tier("words-symsub") = $X)";
  expect(query, those("words-timesub", [](const File& file, const Read& one) {
           return std::ranges::any_of(file.tier("words-symsub"), [&](const Read& other) {
             return other.label == one.label && overlap(other.span, one.span);
           });
         }));
  for (const Segment& found : database_->find(parse(query))) {
    ASSERT_EQ(found.bindings.size(), 1U);
    EXPECT_EQ(found.bindings[0], std::pair(std::string("X"), found.name));
  }
  expect("gloss = $X ->[..20s] gloss = $X & duration > 1s", loop([](const File& file, const auto& add) {
           for (const Read& a : file.glosses()) {
             for (const Read& b : file.glosses()) {
               const Milliseconds gap = b.span.begin - a.span.end;
               if (a.label == b.label && gap >= 0ms && gap <= 20s && b.duration() > 1000) {
                 add({a.span.begin, b.span.end});
               }
             }
           }
         }));
}

}  // namespace
}  // namespace signweave
