// The cost of a query against SQLite with covering indexes, on the same segments: 100 thousand and 1 million
// annotations, replicated from the ELAN files of the shared data with added generated sign and phase tiers. Both sides
// answer the same queries in turns, and their answers are compared row for row. Also: the cost of opening, the size of
// the tables, and the cost of importing the thousandth recording against the tenth (`--growth`: only that). `--quick`:
// a tenth of everything, and none of the shared data.

#include <sqlite3.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <tuple>

#include "bench/annotation_corpus.h"
#include "bench/import_growth.h"
#include "bench/measure.h"
#include "bench/query_stop.h"
#include "signweave/database/database.h"
#include "signweave/query/find.h"
#include "signweave/query/parse.h"

namespace {

using namespace signweave;
namespace fs = std::filesystem;

using Row = std::tuple<std::uint32_t, std::int64_t, std::int64_t>;  ///< recording, begin, end

constexpr int kSignsOfRecording = 100;
constexpr int kTokensOfGloss = 10;
int questions = 2'000;  // of each kind

void run_sql(sqlite3* db, const char* sql) {
  char* error = nullptr;
  if (sqlite3_exec(db, sql, nullptr, nullptr, &error) != SQLITE_OK) throw std::runtime_error(error);
}

/// A prepared statement whose columns are recording, begin, end.
class Statement {
 public:
  Statement(sqlite3* db, const char* sql) {
    if (sqlite3_prepare_v2(db, sql, -1, &statement_, nullptr) != SQLITE_OK)
      throw std::runtime_error(sqlite3_errmsg(db));
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  void bind(const std::string& text) {
    sqlite3_bind_text(statement_, 1, text.data(), static_cast<int>(text.size()), SQLITE_STATIC);
  }
  void run(std::vector<Row>& rows) {
    rows.clear();
    while (sqlite3_step(statement_) == SQLITE_ROW) {
      rows.emplace_back(static_cast<std::uint32_t>(sqlite3_column_int(statement_, 0)),
                        sqlite3_column_int64(statement_, 1), sqlite3_column_int64(statement_, 2));
    }
    sqlite3_reset(statement_);
  }

 private:
  sqlite3_stmt* statement_ = nullptr;
};

/// The same segments in both databases.
struct Corpus {
  std::string name;
  std::size_t annotations = 0;
  std::size_t glosses = 0;
  fs::path folder;
  std::unique_ptr<Database> database;
  sqlite3* sqlite = nullptr;

  Corpus() = default;
  Corpus(Corpus&& other) noexcept = default;
  ~Corpus() { sqlite3_close(sqlite); }
};

void fill_sqlite(const Corpus& corpus) {
  run_sql(corpus.sqlite,
          "PRAGMA page_size=16384; PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF; "
          "CREATE TABLE segment(id INTEGER PRIMARY KEY, recording INTEGER, tier TEXT, kind INTEGER, "
          "phase INTEGER, label TEXT, begin INTEGER, end INTEGER, parent INTEGER); BEGIN");
  sqlite3_stmt* insert = nullptr;
  sqlite3_prepare_v2(corpus.sqlite, "INSERT INTO segment VALUES(?,?,?,?,?,?,?,?,?)", -1, &insert, nullptr);
  const Segments segments = *corpus.database->segments();
  for (std::uint32_t recording = 0; recording < segments.recording_count(); ++recording) {
    const SegmentTable::RowRange rows = segments.recording_rows(recording);
    for (RowId row = rows.begin; row < rows.end; ++row) {
      if (segments.kind(row) == RowKind::unit) continue;
      const std::string_view tier = segments.tier(row);
      const std::string_view label = segments.label(row);
      sqlite3_bind_int64(insert, 1, row);
      sqlite3_bind_int64(insert, 2, recording);
      sqlite3_bind_text(insert, 3, tier.data(), static_cast<int>(tier.size()), SQLITE_STATIC);
      sqlite3_bind_int64(insert, 4, static_cast<int>(segments.kind(row)));
      sqlite3_bind_int64(insert, 5, static_cast<int>(segments.phase(row)));
      sqlite3_bind_text(insert, 6, label.data(), static_cast<int>(label.size()), SQLITE_STATIC);
      sqlite3_bind_int64(insert, 7, segments.span(row).begin.count());
      sqlite3_bind_int64(insert, 8, segments.span(row).end.count());
      sqlite3_bind_int64(insert, 9, segments.parent(row) == kNoRow ? -1 : std::int64_t{segments.parent(row)});
      sqlite3_step(insert);
      sqlite3_reset(insert);
    }
  }
  sqlite3_finalize(insert);
  run_sql(corpus.sqlite,
          "COMMIT; CREATE INDEX by_label ON segment(label, kind, recording, begin, end, id); "
          "CREATE INDEX by_parent ON segment(parent, kind, phase, recording, begin, end); "
          "CREATE INDEX by_time ON segment(recording, tier, begin, end, label); ANALYZE; "
          "PRAGMA cache_size=-2000000; PRAGMA mmap_size=8000000000; PRAGMA temp_store=MEMORY");
}

Corpus make(std::string name, std::size_t annotations, const std::vector<AnnotationDocument>& sources,
            const bench::Folder& folder) {
  Corpus corpus;
  corpus.name = std::move(name);
  corpus.folder = folder.path() / corpus.name;
  Database::create(corpus.folder, {});
  corpus.database = std::make_unique<Database>(corpus.folder, kv::Access::read_write);
  std::size_t per_recording = 0;
  for (const AnnotationDocument& source : sources) per_recording += bench::annotations_in(source);
  per_recording = per_recording / sources.size() + 4 * kSignsOfRecording + kSignsOfRecording / 3;
  corpus.glosses = std::max<std::size_t>(1, annotations / per_recording * kSignsOfRecording / kTokensOfGloss);
  std::mt19937 random(7);
  for (std::size_t i = 0; corpus.annotations < annotations; ++i) {
    Recording recording;
    recording.name = fmt::format("r{:06}", i);
    AnnotationPart part;
    part.document = sources[i % sources.size()];
    bench::add_signs(part.document, random, corpus.glosses, kSignsOfRecording);
    part.tiers.sign_tiers.push_back({"BenchGloss", Hand::right, ""});
    part.tiers.phase_tiers.emplace_back("BenchPhase");
    corpus.annotations += bench::annotations_in(part.document);
    recording.annotation = std::move(part);
    corpus.database->put(recording);
  }
  corpus.database->merge();
  sqlite3_open((corpus.folder.string() + ".sqlite").c_str(), &corpus.sqlite);
  fill_sqlite(corpus);
  return corpus;
}

std::vector<Row> rows_of(const Segments& segments, const std::vector<FoundRow>& found) {
  std::vector<Row> rows;
  for (const FoundRow& one : found) {
    rows.emplace_back(segments.recording(one.row), one.span.begin.count(), one.span.end.count());
  }
  return rows;
}

[[noreturn]] void differ(const std::string& query, std::size_t ours, std::size_t theirs) {
  throw std::runtime_error(fmt::format("{}: {} rows and SQLite's {} are not the same", query, ours, theirs));
}

double at(std::vector<double> values, double part) {
  std::ranges::sort(values);
  return values[std::min(values.size() - 1, static_cast<std::size_t>(part * static_cast<double>(values.size())))];
}

struct Times {
  std::vector<double> ours, peer;
  double p50() const { return at(ours, 0.5); }
};

/// One query for each of several glosses, in turns.
Times ask(const Corpus& corpus, const std::string& before, const std::string& after, const char* sql) {
  const std::shared_ptr<const Segments> segments = corpus.database->segments();
  Statement statement(corpus.sqlite, sql);
  std::mt19937 random(3);
  std::vector<FoundRow> found;
  std::vector<Row> rows;
  Times times;
  constexpr int kRounds = 3;
  constexpr int kCalls = 8;                 // reading the clock costs as much as a row
  for (int i = -200; i < questions; ++i) {  // the first ones warm up, and are compared too
    const std::string gloss = fmt::format("G{}", random() % corpus.glosses);
    const std::string text = fmt::format("{}\"{}\"{}", before, gloss, after);
    PreparedQuery query(parse(text), segments);
    statement.bind(gloss);
    double ours = 1e9;
    double peer = 1e9;
    for (int round = 0; round < kRounds; ++round) {
      ours = std::min(ours, bench::seconds_of([&] { query.find(found); }, kCalls));
      peer = std::min(peer, bench::seconds_of([&] { statement.run(rows); }, kCalls));
    }
    if (rows_of(*segments, found) != rows) differ(text, found.size(), rows.size());
    if (i < 0) continue;
    times.ours.push_back(ours);
    times.peer.push_back(peer);
  }
  return times;
}

void print(const std::string& name, const Times& times) {
  for (const auto& [part, called] : {std::pair(0.5, "p50"), std::pair(0.99, "p99")}) {
    const double ours = at(times.ours, part);
    const double peer = at(times.peer, part);
    bench::print(fmt::format("{}/{}", name, called), 1e6 * ours, "us", 1e6 * peer, ours / peer, "<= 0.1");
  }
}

constexpr const char* kGlossSql =
    "SELECT recording, begin, end FROM segment WHERE label = ?1 AND kind = 1 ORDER BY recording, begin, end";
constexpr const char* kStrokeSql =
    "SELECT p.recording, p.begin, p.end FROM segment s JOIN segment p ON p.parent = s.id AND p.kind = 2 AND p.phase = "
    "1 "
    "WHERE s.label = ?1 AND s.kind = 1 ORDER BY p.recording, p.begin, p.end";
// No mouthing is longer than a second, which lets SQLite use both bounds of its index.
constexpr const char* kOverlapSql =
    "SELECT recording, begin, end FROM segment s WHERE label = ?1 AND kind = 1 AND EXISTS (SELECT 1 FROM segment m "
    "WHERE "
    "m.recording = s.recording AND m.tier = 'BenchMouthing' AND m.begin > s.begin - 1000 AND m.begin < s.end AND m.end "
    "> "
    "s.begin) ORDER BY recording, begin, end";
constexpr const char* kJoinSql =
    "SELECT recording, begin, end FROM segment s WHERE tier = 'BenchGloss' AND EXISTS (SELECT 1 FROM segment m WHERE "
    "m.recording = s.recording AND m.tier = 'BenchMouthing' AND m.begin > s.begin - 1000 AND m.begin < s.end AND m.end "
    "> "
    "s.begin) ORDER BY recording, begin, end";

void overlap_join(const Corpus& corpus) {
  const std::shared_ptr<const Segments> segments = corpus.database->segments();
  const char* text = "tier(\"BenchGloss\") =~ /.*/ overlaps tier(\"BenchMouthing\") =~ /.*/";
  PreparedQuery query(parse(text), segments);
  Statement statement(corpus.sqlite, kJoinSql);
  std::vector<FoundRow> found;
  std::vector<Row> rows;
  const bench::Compared compared = bench::compare(
      5, [&] { query.find(found); }, [&] { statement.run(rows); });
  if (rows_of(*segments, found) != rows) differ(text, found.size(), rows.size());
  const double signs = static_cast<double>(segments->recording_count()) * kSignsOfRecording;
  bench::print(fmt::format("{}/overlap_join/row", corpus.name), 1e9 / signs, "ns", compared, "<= 0.1");
  bench::print(fmt::format("{}/overlap_join/row_bound", corpus.name), 1e9 * compared.ours / signs, "ns", 50,
               1e9 * compared.ours / signs / 50, "<= 1");
}

void opening(const Corpus& corpus) {
  std::size_t bytes = 0;
  const std::shared_ptr<const Segments> segments = corpus.database->segments();
  for (const Segments::Member& member : segments->members()) bytes += member.table.bytes().size();
  const double each = static_cast<double>(bytes) / static_cast<double>(corpus.annotations);
  bench::print(fmt::format("{}/index_bytes_per_annotation", corpus.name), each, "B", 40, each / 40, "<= 1");
  // The yardstick: a checksum of as many bytes, the part that cannot be avoided.
  const ByteSpan first = segments->members().front().table.bytes();
  const bench::Compared compared = bench::compare(
      9,
      [&] {
        const Database database(corpus.folder, kv::Access::read_only);
        bench::keep(database.segments()->row_count());
      },
      [&] { bench::keep(checksum(first)); });
  bench::print(fmt::format("{}/open", corpus.name), 1e3, "ms", compared, "-");
  bench::print(fmt::format("{}/open_bound", corpus.name), 1e3 * compared.ours, "ms", 10, 100 * compared.ours, "<= 1");
}

void run(bool quick, bool growth_only) {
  const std::vector<AnnotationDocument> sources = quick ? std::vector(1, AnnotationDocument()) : bench::documents();
  const bench::Folder folder("query");
  bench::measure_growth(sources, folder.path(), quick);
  if (growth_only) return;
  if (quick) questions = 400;
  const std::size_t thousand = quick ? 100 : 1000;
  const std::string names[] = {quick ? "10k" : "100k", quick ? "100k" : "1M"};
  Times gloss[2], stroke[2], overlap[2];
  for (int i = 0; i < 2; ++i) {
    const Corpus corpus = make(names[i], (i == 0 ? 100 : 1000) * thousand, sources, folder);
    gloss[i] = ask(corpus, "gloss = ", "", kGlossSql);
    stroke[i] = ask(corpus, "phase = stroke & gloss = ", "", kStrokeSql);
    overlap[i] = ask(corpus, "gloss = ", " overlaps tier(\"BenchMouthing\") =~ /.*/", kOverlapSql);
    print(corpus.name + "/gloss", gloss[i]);
    print(corpus.name + "/stroke_of_gloss", stroke[i]);
    print(corpus.name + "/overlap_of_gloss", overlap[i]);
    overlap_join(corpus);
    opening(corpus);
    if (i == 1) bench::measure_stops(corpus.name, corpus.database->segments(), quick);
  }
  const auto grows = [&](const char* name, const Times(&times)[2], const char* goal) {
    bench::print(fmt::format("{}_to_{}/{}/p50", names[1], names[0], name), 1e6 * times[1].p50(), "us",
                 1e6 * times[0].p50(), times[1].p50() / times[0].p50(), goal);
  };
  grows("gloss", gloss, "<= 1.3");
  grows("stroke_of_gloss", stroke, "<= 2.5");
  grows("overlap_of_gloss", overlap, "<= 2.5");
}

}  // namespace

int main(int argc, char** argv) {
  bool quick = false;
  bool growth_only = false;
  for (int i = 1; i < argc; ++i) {
    quick = quick || std::strcmp(argv[i], "--quick") == 0;
    growth_only = growth_only || std::strcmp(argv[i], "--growth") == 0;
  }
  try {
    run(quick, growth_only);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "query: %s\n", error.what());
    return 1;
  }
  return 0;
}
