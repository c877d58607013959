// The paper's trade-off between the two storages of annotation documents (its section 4.1): the costs of importing, of
// reading one annotation, one tier and everything, and of XPath, each with `node` against `document`, in turns, on the
// ELAN files of the shared data replicated and on one long generated document. Operations that must read a whole
// document are also compared with a plain pugixml parse of the same bytes. The answers of both are compared. `--quick`:
// only a tenth of the long document, and fewer rounds.

#include <cstring>
#include <map>
#include <pugixml.hpp>
#include <stdexcept>

#include "bench/annotation_corpus.h"
#include "bench/measure.h"
#include "signweave/database/database.h"

namespace {

using namespace signweave;
namespace fs = std::filesystem;

struct Corpus {
  std::string name;
  std::vector<Recording> recordings;
  std::vector<std::string> texts;  ///< [recording] its document's bytes
  std::size_t annotations = 0;
  std::size_t bytes = 0;

  void add(std::string called, AnnotationDocument document, TierNames tiers) {
    texts.push_back(document.source.empty() ? eaf::write_text(document) : document.source);
    document.source = texts.back();
    annotations += bench::annotations_in(document);
    bytes += texts.back().size();
    Recording recording;
    recording.name = std::move(called);
    AnnotationPart part;
    part.document = std::move(document);
    part.tiers = std::move(tiers);
    recording.annotation = std::move(part);
    recordings.push_back(std::move(recording));
  }
};

Corpus shared_corpus(int copies) {
  Corpus corpus;
  corpus.name = "shared";
  const fs::path folder = fs::path(SIGNWEAVE_SHARED_DATA) / "eaf";
  if (!fs::is_directory(folder)) return corpus;
  std::vector<fs::path> files;
  for (const fs::directory_entry& file : fs::recursive_directory_iterator(folder)) {
    if (file.path().extension() == ".eaf") files.push_back(file.path());
  }
  std::ranges::sort(files);
  for (int copy = 0; copy < copies; ++copy) {
    for (std::size_t i = 0; i < files.size(); ++i) {
      AnnotationDocument document = eaf::read(files[i]).document;
      corpus.add(fmt::format("r{}.{}", i, copy), std::move(document), {});
    }
  }
  return corpus;
}

Corpus long_corpus(int signs) {
  Corpus corpus;
  corpus.name = "long";
  AnnotationDocument document;
  std::mt19937 random(5);
  bench::add_signs(document, random, 500, signs);
  TierNames tiers;
  tiers.sign_tiers.push_back({"BenchGloss", Hand::right, ""});
  tiers.phase_tiers.emplace_back("BenchPhase");
  corpus.add("long", std::move(document), std::move(tiers));
  return corpus;
}

struct Stored {
  fs::path folder;
  std::unique_ptr<Database> database;
};

/// Puts all documents into a new database; returns seconds.
double load(const Corpus& corpus, const fs::path& folder, DocumentStorage storage, Stored& into) {
  into.database.reset();
  fs::remove_all(folder);
  CreateOptions options;
  options.documents = storage;
  Database::create(folder, options);
  into = {folder, std::make_unique<Database>(folder, kv::Access::read_write)};
  return bench::seconds_of([&] {
    for (const Recording& recording : corpus.recordings) into.database->put(recording);
  });
}

[[noreturn]] void differ(const std::string& what) {
  throw std::runtime_error(what + ": the two storages give different answers");
}

/// A sample of a corpus' annotations: recording and id.
std::vector<std::pair<std::string, std::string>> some_annotations(const Corpus& corpus, std::size_t count) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const Recording& recording : corpus.recordings) {
    for (const Tier& tier : recording.annotation->document.tiers) {
      for (const Annotation& annotation : tier.annotations) all.emplace_back(recording.name, annotation.id);
    }
  }
  std::mt19937 random(9);
  std::ranges::shuffle(all, random);
  all.resize(std::min(all.size(), count));
  return all;
}

std::vector<xpath::Value> values_of(const Database& database, const std::string& text, const std::string& recording) {
  XPathLimits limits;
  limits.recordings = {recording};
  std::vector<xpath::Value> values;
  for (XPathAnswer& answer : database.xpath(xpath::Expression(text), limits)) values.push_back(std::move(answer.value));
  return values;
}

/// Single annotations, measured in turns with `document`; `node` is called several times per measurement, because the
/// clock is coarse.
template <typename Ask>
void each_annotation(const std::string& name, const std::vector<std::pair<std::string, std::string>>& annotations,
                     const Stored& node, const Stored& document, const char* goal, Ask&& ask) {
  std::vector<double> ours, theirs, ratios;
  for (const auto& annotation : annotations) {
    const std::string& recording = annotation.first;
    const std::string& id = annotation.second;
    if (ask(*node.database, recording, id) != ask(*document.database, recording, id))
      differ(fmt::format("{} {}", name, id));
    ours.push_back(bench::seconds_of([&] { bench::keep(ask(*node.database, recording, id)); }, 10));
    theirs.push_back(bench::seconds_of([&] { bench::keep(ask(*document.database, recording, id)); }));
    ratios.push_back(ours.back() / theirs.back());
  }
  bench::print(name, 1e6, "us", {bench::median(ours), bench::median(theirs), bench::median(ratios)}, goal);
}

std::uintmax_t size_on_disk(const fs::path& folder) {
  std::uintmax_t size = 0;
  for (const fs::directory_entry& file : fs::directory_iterator(folder)) {
    if (file.path().filename() != "lock.mdb") size += file.file_size();
  }
  return size;
}

std::uint64_t bytes_of_documents(const Database& database) {
  std::uint64_t bytes = 0;
  for (const Usage& usage : database.usage()) {
    if (usage.kind == "documents") bytes += usage.bytes;
  }
  return bytes;
}

void measure(const Corpus& corpus, const fs::path& folder, bool quick) {
  if (corpus.recordings.empty()) {
    fmt::print(stderr, "not run: no shared data\n");
    return;
  }
  const std::string name = corpus.name;
  fmt::print(stderr, "{}: {} recordings, {} annotations, {} bytes\n", name, corpus.recordings.size(),
             corpus.annotations, corpus.bytes);
  const int rounds = quick ? 3 : 5;

  // Importing: the yardstick of both is the part that cannot be avoided, a parse.
  Stored node, document;
  std::vector<double> loads[2], parses, ratios;
  const auto parse_all = [&] {
    for (const std::string& text : corpus.texts) {
      pugi::xml_document parsed;
      if (!parsed.load_buffer(text.data(), text.size(), pugi::parse_full | pugi::parse_ws_pcdata)) {
        throw std::runtime_error("pugixml refuses a document");
      }
      bench::keep(parsed);
    }
  };
  for (int round = -1; round < rounds; ++round) {
    const double by_node = load(corpus, folder / (name + "_node"), DocumentStorage::node, node);
    const double by_document = load(corpus, folder / (name + "_document"), DocumentStorage::document, document);
    const double parse = bench::seconds_of(parse_all);
    if (round < 0) continue;
    loads[0].push_back(by_document);
    loads[1].push_back(by_node);
    parses.push_back(parse);
    ratios.push_back(by_node / by_document);
  }
  const double by_document = bench::median(loads[0]);
  const double by_node = bench::median(loads[1]);
  bench::print(name + "/load/document:to_parse", 1e3, "ms",
               {by_document, bench::median(parses), by_document / bench::median(parses)}, "-");
  bench::print(name + "/load/node:to_document", 1e3, "ms", {by_node, by_document, bench::median(ratios)}, "-");

  // One annotation.
  const auto annotations = some_annotations(corpus, quick ? 15 : 60);
  each_annotation(name + "/one_annotation/node:to_document", annotations, node, document, "<= 1",
                  [](const Database& database, const std::string& recording, const std::string& id) {
                    return database.annotation(recording, id).value().xml;
                  });
  std::map<std::pair<std::string, std::string>, std::string> expressions;  // EAF has two elements for them
  for (const auto& [recording, id] : annotations) {
    const bool aligned = node.database->annotation(recording, id).value().xml.find("<ALIGNABLE") != std::string::npos;
    expressions[{recording, id}] =
        fmt::format("//{}_ANNOTATION[@ANNOTATION_ID=\"{}\"]", aligned ? "ALIGNABLE" : "REF", id);
  }
  each_annotation(name + "/xpath_one_annotation/node:to_document", annotations, node, document, "<= 1",
                  [&](const Database& database, const std::string& recording, const std::string& id) {
                    return values_of(database, expressions.at({recording, id}), recording);
                  });

  // Everything: the same for both except for joining the pieces. Also against a parse of the same bytes.
  const auto everything = [&](const std::string& what, auto&& ask) {
    if (ask(*node.database) != ask(*document.database)) differ(name + "/" + what);
    std::vector<double> times[2], parse, both;
    for (int round = -1; round < rounds; ++round) {
      const double ours = bench::seconds_of([&] { bench::keep(ask(*node.database)); });
      const double theirs = bench::seconds_of([&] { bench::keep(ask(*document.database)); });
      const double bare = bench::seconds_of(parse_all);
      if (round < 0) continue;
      times[0].push_back(theirs);
      times[1].push_back(ours);
      parse.push_back(bare);
      both.push_back(ours / theirs);
    }
    const double theirs = bench::median(times[0]);
    bench::print(fmt::format("{}/{}/document:to_parse", name, what), 1e3, "ms",
                 {theirs, bench::median(parse), theirs / bench::median(parse)}, "-");
    bench::print(fmt::format("{}/{}/node:to_document", name, what), 1e3, "ms",
                 {bench::median(times[1]), theirs, bench::median(both)}, "-");
  };
  everything("xpath_whole", [](const Database& database) {
    std::vector<std::string> counts;
    const xpath::Expression expression("count(//ANNOTATION_VALUE)");
    for (const XPathAnswer& answer : database.xpath(expression)) counts.push_back(answer.value.value);
    return counts;
  });
  everything("read_all", [&](const Database& database) {
    std::vector<std::string> sources;
    for (const Recording& recording : corpus.recordings) sources.push_back(database.document(recording.name).source);
    return sources;
  });
  const Recording& first = *std::ranges::max_element(corpus.recordings, {}, [](const Recording& recording) {
    return bench::annotations_in(recording.annotation->document);
  });
  const Tier& shortest = *std::ranges::min_element(first.annotation->document.tiers, {}, [](const Tier& tier) {
    return tier.annotations.empty() ? SIZE_MAX : tier.annotations.size();
  });
  const auto one_tier = [&](const Stored& stored) { return stored.database->tier(first.name, shortest.id); };
  if (one_tier(node) != one_tier(document)) differ(name + "/one_tier");
  bench::print(name + "/one_tier/node:to_document", 1e3, "ms",
               bench::compare(
                   quick ? 3 : 15, [&] { bench::keep(one_tier(node)); }, [&] { bench::keep(one_tier(document)); }),
               "<= 1");

  const double text = static_cast<double>(corpus.bytes);
  const auto space = [&](const char* storage, const Stored& stored) {
    const double bytes = static_cast<double>(bytes_of_documents(*stored.database));
    bench::print(fmt::format("{}/bytes_of_documents/{}:to_text", name, storage), bytes, "B", text, bytes / text, "-");
    return static_cast<double>(size_on_disk(stored.folder));
  };
  const double of_document = space("document", document);
  const double of_node = space("node", node);
  bench::print(name + "/bytes_on_disk/node:to_document", of_node, "B", of_document, of_node / of_document, "-");
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
  const bench::Folder folder("documents");
  try {
    measure(long_corpus(quick ? 800 : 8'000), folder.path(), quick);
    if (!quick) measure(shared_corpus(4), folder.path(), quick);
  } catch (const std::exception& error) {
    fmt::print(stderr, "documents: {}\n", error.what());
    return 1;
  }
  return 0;
}
