// Reading and writing files, against the least that such work can cost: a plain scan of the same numbers with
// fast_float, a plain loop of std::to_chars, a plain parse by pugixml; and against Assimp, which also reads BVH.
//
// Prints lines "name value unit yardstick ratio goal": medians of interleaved rounds. For the files under
// ../shared/data the median and the worst of each class, with the name of the worst in the line's name; with --each
// every file.
//   --quick        only small and generated files, few rounds
//   --only bvh     or eaf, or memory
//   --data FOLDER  instead of ../shared/data
// The result is compared with what the yardstick read; a difference ends the program with status 1.

#include <assimp/scene.h>
#include <fast_float/fast_float.h>
#include <malloc.h>
#include <assimp/Importer.hpp>
#include <charconv>
#include <fstream>
#include <numbers>
#include <pugixml.hpp>
#include <stdexcept>
#include <string>

#include "bench/import_memory.h"
#include "bench/measure.h"
#include "bench/table.h"
#include "demo/corpus.h"
#include "signweave/core/atomic_file.h"
#include "signweave/core/text_reader.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/formats/bvh/frames.h"
#include "signweave/formats/bvh/hierarchy.h"
#include "signweave/formats/eaf/eaf.h"

namespace {

using namespace signweave;
namespace fs = std::filesystem;

constexpr std::size_t kMegabyte = 1'000'000;

struct Settings {
  fs::path data = SIGNWEAVE_SHARED_DATA;
  bool each = false;
  bool quick = false;
  std::string only;

  bool wants(std::string_view part) const { return only.empty() || only == part; }
};

[[noreturn]] void differ(const std::string& name, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", name, what));
}

// --- BVH: yardsticks ---

bool is_blank(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/// The text after the line "Frame Time: …".
std::string_view frames_of(std::string_view text) {
  const std::size_t at = text.find('\n', text.find("Frame Time"));
  return at == text.npos ? std::string_view() : text.substr(at);
}

/// The plain scan: every number of the frames into `numbers`, which must be large enough. Returns their count.
std::size_t scan(std::string_view text, std::vector<double>& numbers) {
  text = frames_of(text);
  const char* at = text.data();
  const char* const end = at + text.size();
  double* out = numbers.data();
  for (;;) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) return static_cast<std::size_t>(out - numbers.data());
    const auto [next, error] = fast_float::from_chars(at, end, *out);
    if (error != std::errc()) throw std::runtime_error("the scan found something that is not a number");
    at = next;
    ++out;
  }
}

/// The same numbers read by our reader: all that bvh::read does up to its channels.
std::size_t read_channels(const std::string& name, std::string_view text, std::vector<double>& numbers) {
  TextReader reader(name, text);
  std::vector<Notice> notices;
  const bvh::Hierarchy hierarchy = bvh::read_hierarchy(reader, notices);
  const bvh::MotionHeader header = bvh::read_header(reader, notices);
  const bvh::ReadOptions options;
  bvh::FrameReader frames(reader, hierarchy, header, options);
  std::size_t count = 0;
  for (std::span<const double> row = frames.next(); !row.empty(); row = frames.next()) {
    std::copy(row.begin(), row.end(), numbers.begin() + static_cast<std::ptrdiff_t>(count));
    count += row.size();
  }
  return count;
}

// --- BVH: correctness ---

/// Checks the rotations of the file's first and last frame, computed from the scan's numbers in the simplest manner.
void check_rotations(const std::string& name, const bvh::File& file, const std::vector<double>& numbers) {
  const std::int64_t last = file.motion.frame_count() - 1;
  std::size_t columns = 0;
  for (const auto& channels : file.layout.channels) columns += channels.size();
  for (const std::int64_t frame : {std::int64_t{0}, last / 2, last}) {
    std::size_t at = static_cast<std::size_t>(frame) * columns;
    for (std::size_t joint = 0; joint < file.layout.channels.size(); ++joint) {
      Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
      for (const bvh::Channel channel : file.layout.channels[joint]) {
        const double value = numbers[at++];
        const int kind = static_cast<int>(channel);
        if (kind < 3) continue;
        rotation = rotation * Eigen::AngleAxisd(value * std::numbers::pi / 180, Eigen::Vector3d::Unit(kind - 3));
      }
      if (file.layout.up == bvh::UpAxis::z) {
        rotation = Eigen::Quaterniond(rotation.w(), rotation.x(), rotation.z(), -rotation.y());
      }
      const Eigen::Quaterniond ours = file.motion.pose(frame).rotations[joint].cast<double>();
      const double off = (ours.conjugate() * rotation).vec().norm() * 360 / std::numbers::pi;
      if (!(off < 1e-4)) differ(name, fmt::format("joint {} of frame {} is {} degrees off", joint, frame, off));
    }
  }
}

// --- BVH: one file ---

struct BvhFile {
  std::string name;
  fs::path path;
};

struct BvhTables {
  bench::Table channels, read, write, write_shortest, assimp;
  BvhTables(const std::string& kind, const std::string& channel_goal, const std::string& read_goal,
            const std::string& write_goal, bool each)
      : channels("bvh_to_channels/" + kind, "us", 1e6, channel_goal, each),
        read("bvh_read/" + kind, "us", 1e6, read_goal, each),
        write("bvh_write/" + kind, "us", 1e6, write_goal, each),
        write_shortest("bvh_write_vs_shortest/" + kind, "us", 1e6, "-", each),
        assimp("bvh_read_vs_assimp/" + kind, "us", 1e6, "<= 0.2", each) {}
  void print() {
    for (bench::Table* table : {&channels, &read, &write, &write_shortest, &assimp}) table->print();
  }
};

/// Calls per round, and number of rounds. Rounds are short (well under a millisecond if the file allows), so that on a
/// busy machine most of them are undisturbed, including the median.
struct Effort {
  int calls = 1;
  int rounds = 1;
};
Effort effort_for(std::size_t bytes, bool quick) {
  if (quick) return {1, 11};
  return {static_cast<int>(std::clamp<std::size_t>(kMegabyte / 5 / bytes, 1, 50)), bytes > 10 * kMegabyte ? 9 : 51};
}

/// The numbers of a written file, each with its number of decimals.
struct Printed {
  std::vector<double> numbers;
  std::vector<int> decimals;
};
Printed printed_in(std::string_view written) {
  Printed printed;
  written = frames_of(written);
  for (std::size_t at = 0; at < written.size();) {
    if (is_blank(written[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < written.size() && !is_blank(written[end])) ++end;
    const std::string_view word = written.substr(at, end - at);
    double value = 0;
    fast_float::from_chars(word.data(), word.data() + word.size(), value);
    const std::size_t point = word.find('.');
    printed.numbers.push_back(value);
    printed.decimals.push_back(point == word.npos ? 0 : static_cast<int>(word.size() - point - 1));
    at = end;
  }
  return printed;
}

void measure_write(const std::string& name, const bvh::File& file, const Effort& effort, BvhTables& tables) {
  const std::string written = bvh::write_text(file.motion, file.layout);
  const Printed printed = printed_in(written);
  std::string buffer(written.size() + 64, ' ');
  // Line ends are written as blanks here; both print the same digits.
  std::size_t used = 0;
  const auto fixed = [&] {
    char* at = buffer.data();
    for (std::size_t i = 0; i < printed.numbers.size(); ++i) {
      at = std::to_chars(at, buffer.data() + buffer.size(), printed.numbers[i], std::chars_format::fixed,
                         printed.decimals[i])
               .ptr;
      *at++ = ' ';
    }
    used = static_cast<std::size_t>(at - buffer.data());
  };
  const auto shortest = [&] {
    char* at = buffer.data();
    for (const double value : printed.numbers) {
      at = std::to_chars(at, buffer.data() + buffer.size(), value, std::chars_format::fixed).ptr;
      *at++ = ' ';
    }
    used = static_cast<std::size_t>(at - buffer.data());
  };
  const auto check = [&] {
    std::string expected(frames_of(written).substr(1));
    std::replace(expected.begin(), expected.end(), '\n', ' ');
    if (std::string_view(buffer).substr(0, used) != expected) differ(name, "to_chars printed other digits");
  };
  const auto ours = [&] { bench::keep(bvh::write_text(file.motion, file.layout)); };
  fixed();
  check();
  shortest();
  check();
  tables.write.add(name, bench::compare(effort.rounds, ours, fixed, effort.calls));
  tables.write_shortest.add(name, bench::compare(effort.rounds, ours, shortest, effort.calls));
}

void measure_assimp(const BvhFile& from, const bvh::File& file, const Effort& effort, BvhTables& tables) {
  Assimp::Importer importer;
  const auto theirs = [&] { return importer.ReadFile(from.path.string(), 0); };
  const aiScene* scene = theirs();
  if (scene == nullptr || scene->mNumAnimations == 0) {
    fmt::print(stderr, "Assimp refuses {}: {}\n", from.name,
               scene == nullptr ? importer.GetErrorString() : "no frames");
    bench::print("bvh_read_vs_assimp/refused:" + from.name, 0, "us", 0, 0, "-");
    return;
  }
  const unsigned keys = scene->mAnimations[0]->mChannels[0]->mNumRotationKeys;
  if (keys != file.motion.frame_count()) {
    differ(from.name, fmt::format("Assimp reads {} frames, we {}", keys, file.motion.frame_count()));
  }
  const int rounds = std::min(effort.rounds, 9);
  const int calls = std::min(effort.calls, 5);
  tables.assimp.add(from.name, bench::compare(
                                   rounds, [&] { bench::keep(bvh::read(from.path)); }, theirs, calls));
}

void measure_bvh(const BvhFile& from, bool quick, BvhTables& tables) {
  const std::string text = read_file(from.path);
  const Effort effort = effort_for(text.size(), quick);
  std::vector<double> scanned(text.size() / 2 + 1);
  std::vector<double> ours(scanned.size());
  const std::size_t count = scan(text, scanned);
  if (read_channels(from.name, text, ours) != count) differ(from.name, "we read a different number of values");
  for (std::size_t i = 0; i < count; ++i) {
    if (ours[i] != scanned[i])
      differ(from.name, fmt::format("number {} is {}, the scan says {}", i, ours[i], scanned[i]));
  }
  const bvh::File file = bvh::read(from.path);
  check_rotations(from.name, file, scanned);

  const auto yardstick = [&] { bench::keep(scan(text, scanned)); };
  tables.channels.add(from.name, bench::compare(
                                     effort.rounds, [&] { bench::keep(read_channels(from.name, text, ours)); },
                                     yardstick, effort.calls));
  tables.read.add(from.name, bench::compare(
                                 effort.rounds, [&] { bench::keep(bvh::read(from.path)); }, yardstick, effort.calls));
  measure_write(from.name, file, effort, tables);
  measure_assimp(from, file, effort, tables);
}

// --- EAF ---

struct Count : pugi::xml_tree_walker {
  std::size_t annotations = 0;
  bool for_each(pugi::xml_node& node) override {
    const std::string_view name = node.name();
    annotations += name == "ALIGNABLE_ANNOTATION" || name == "REF_ANNOTATION" ? 1 : 0;
    return true;
  }
};

void measure_eaf(const fs::path& path, const std::string& name, bool quick, bench::Table& table) {
  const std::string text = read_file(path);
  const Effort effort = effort_for(text.size(), quick);
  const auto theirs = [&] {
    pugi::xml_document document;
    if (!document.load_buffer(text.data(), text.size(), pugi::parse_full | pugi::parse_ws_pcdata,
                              pugi::encoding_utf8)) {
      differ(name, "pugixml refuses it");
    }
    return document;
  };
  Count count;
  pugi::xml_document document = theirs();
  document.traverse(count);
  std::size_t ours = 0;
  for (const Tier& tier : eaf::read(path).document.tiers) ours += tier.annotations.size();
  if (ours != count.annotations) differ(name, fmt::format("{} annotations, the file has {}", ours, count.annotations));
  table.add(name, bench::compare(
                      effort.rounds, [&] { bench::keep(eaf::read_text(name, text)); }, [&] { bench::keep(theirs()); },
                      effort.calls));
}

// --- generated files ---

/// `frames` frames of the demo's weather forecast, repeated.
void write_long(const fs::path& path, const std::string& once, std::int64_t frames) {
  const std::size_t count_at = once.find("Frames: ") + 8;
  const std::size_t first = once.find('\n', once.find("Frame Time")) + 1;
  std::ofstream out(path, std::ios::binary);
  out << once.substr(0, count_at) << frames
      << once.substr(once.find('\n', count_at), first - once.find('\n', count_at));
  std::size_t at = first;
  for (std::int64_t i = 0; i < frames; ++i) {
    if (at == once.size()) at = first;
    const std::size_t end = once.find('\n', at) + 1;
    out.write(once.data() + at, static_cast<std::streamsize>(end - at));
    at = end;
  }
  if (!out) throw std::runtime_error(path.string() + " cannot be written");
}

std::vector<fs::path> files_in(const fs::path& folder, const char* extension) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// As one word in a line of results.
std::string word_of(const fs::path& path, const fs::path& folder) {
  std::string name = path.lexically_relative(folder).string();
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

void measure_shared(const Settings& settings) {
  if (!fs::is_directory(settings.data)) {
    fmt::print("not run: no shared data\n");
    return;
  }
  if (settings.wants("bvh")) {
    // Files of a few frames consist mostly of HIERARCHY, of which the plain scan reads nothing: no goal for them.
    BvhTables tiny("under_10kB", "-", "-", "-", settings.each);
    BvhTables small("under_1MB", "<= 1.5", "<= 1.8", "<= 1.2", settings.each);
    BvhTables large("over_1MB", "<= 1.3", "<= 1.8", "<= 1.2", settings.each);
    for (const fs::path& path : files_in(settings.data / "bvh", ".bvh")) {
      const std::size_t size = fs::file_size(path);
      measure_bvh({word_of(path, settings.data / "bvh"), path}, settings.quick,
                  size < 10'000      ? tiny
                  : size < kMegabyte ? small
                                     : large);
    }
    for (BvhTables* tables : {&tiny, &small, &large}) tables->print();
  }
  if (settings.wants("eaf")) {
    bench::Table annotations("eaf_read/shared", "us", 1e6, "<= 3", settings.each);
    for (const fs::path& path : files_in(settings.data, ".eaf")) {
      measure_eaf(path, word_of(path, settings.data), settings.quick, annotations);
    }
    annotations.print();
  }
}

void run(const Settings& settings) {
  const bench::Folder folder("import");
  const demo::SyntheticRecording recording = demo::make_recording(demo::meteo(), FrameRate{100, 1}, 1);
  const std::string once = bvh::write_text(recording.motion, bvh::default_layout(recording.motion.skeleton()));
  const fs::path made = folder.path() / "made.bvh";
  if (settings.wants("bvh")) {
    const std::int64_t frames = settings.quick ? 1'000 : 12'000;
    write_long(made, once, frames);
    BvhTables tables("made", "<= 1.3", "<= 1.8", "<= 1.2", settings.each);
    measure_bvh({fmt::format("{}_frames_of_56_joints", frames), made}, settings.quick, tables);
    tables.print();
  }
  if (settings.wants("eaf")) {
    const fs::path path = folder.path() / "made.eaf";
    eaf::write(path, recording.document);
    bench::Table annotations("eaf_read", "us", 1e6, "<= 3", settings.each);
    measure_eaf(path, "made", settings.quick, annotations);
    annotations.print();
  }
  if (!settings.quick) measure_shared(settings);
  if (settings.wants("memory")) {
    const std::int64_t frames = settings.quick ? 500 : 44 * 60 * 60;  // the paper's 44 minutes, at 60 frames a second
    write_long(made, once, frames);
    bench::measure_memory(made, fmt::format("{}_frames_of_56_joints", frames), frames, settings.quick ? "-" : "<= 1.5");
  }
}

}  // namespace

int main(int count, char** arguments) {
  // What is read is large and allocated again each time. By default, glibc returns its memory to the system after each
  // read, and much of what is measured would be page faults.
  ::mallopt(M_TRIM_THRESHOLD, 1 << 28);
  ::mallopt(M_MMAP_THRESHOLD, 1 << 25);
  try {
    Settings settings;
    for (int i = 1; i < count; ++i) {
      const std::string_view word = arguments[i];
      if (word == "--each") {
        settings.each = true;
      } else if (word == "--quick") {
        settings.quick = true;
      } else if (word == "--data" && i + 1 < count) {
        settings.data = arguments[++i];
      } else if (word == "--only" && i + 1 < count) {
        settings.only = arguments[++i];
        if (settings.only != "bvh" && settings.only != "eaf" && settings.only != "memory") {
          fmt::print(stderr, "import: --only takes bvh, eaf or memory\n");
          return 2;
        }
      } else if (word == "--import-memory" && i + 2 < count) {
        ::mallopt(M_TRIM_THRESHOLD, 128 << 10);  // as in any program
        ::mallopt(M_MMAP_THRESHOLD, 128 << 10);
        return bench::import_and_tell(arguments[i + 1], arguments[i + 2]);
      } else {
        fmt::print(stderr, "import: no option '{}'; available: --each, --quick, --only and --data\n", word);
        return 2;
      }
    }
    run(settings);
  } catch (const std::exception& error) {
    fmt::print(stderr, "import: {}\n", error.what());
    return 1;
  }
  return 0;
}
