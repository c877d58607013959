#include <fmt/format.h>
#include <stdlib.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <ostream>
#include <random>
#include <thread>

#include "app/cli/bind.h"
#include "app/cli/browser.h"
#include "app/cli/command.h"
#include "app/cli/interrupts.h"
#include "app/cli/progress.h"
#include "app/cli/validators.h"
#include "app/server/api.h"
#include "app/server/server.h"
#include "app/wire/text.h"
#include "signweave/calls/synthesis_call.h"
#include "signweave/calls/table.h"
#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/formats/write_file.h"

namespace signweave::cli {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using nlohmann::json;

/// After this time without progress, waiting for the browser ends.
constexpr auto kPatience = 120s;

/// What is drawn, as far as the fields of a call specify it.
struct Drawn {
  std::string utterance;
  std::string recording;
  std::vector<std::string> replace;
  std::string swap;
  std::optional<std::int64_t> from;
  std::optional<std::int64_t> to;
  calls::SynthesisChoices how;
};

template <class Visit>
void fields(Visit& visit, Drawn& drawn) {
  using calls::Field;
  visit(Field{.name = "utterance",
              .help = "glosses, as for 'sign'; a recording is drawn with --recording",
              .words = "UTTERANCE"},
        drawn.utterance);
  visit(Field{.name = "recording", .help = "draw this recording instead"}, drawn.recording);
  visit(Field{.name = "replace", .help = "change the recording, as 'edit' does", .several_words = true}, drawn.replace);
  visit(Field{.name = "swap", .help = "change the recording, as 'edit' does"}, drawn.swap);
  visit(Field{.name = "from", .help = "annotation time in ms of the recording to begin at"}, drawn.from);
  visit(Field{.name = "to", .help = "annotation time in ms of the recording to end at"}, drawn.to);
  calls::signing_fields(visit, drawn.how);
}

struct RenderArguments {
  std::string folder;
  std::string output;
  Drawn drawn;
  std::string size = "1280x720";
  double rate = 30;
  std::string view = "front";
  std::vector<std::string> moments;  ///< as given; `take_moments` reads them
  std::vector<std::int64_t> at;
  std::string studio;
  std::string browser;
};

struct Size {
  int width = 0;
  int height = 0;
};

std::optional<Size> parse_size(const std::string& text) {
  Size size;
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  if (width.ec != std::errc() || width.ptr == end || *width.ptr != 'x') return std::nullopt;
  const auto height = std::from_chars(width.ptr + 1, end, size.height);
  if (height.ec != std::errc() || height.ptr != end) return std::nullopt;
  const bool good = size.width >= 16 && size.height >= 16 && size.width <= 4096 && size.height <= 4096 &&
                    size.width % 2 == 0 && size.height % 2 == 0;
  return good ? std::optional(size) : std::nullopt;
}

class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "signweave-render-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw Error(ErrorCode::io, name + ": no folder could be created");
    path_ = name;
  }
  Folder(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const noexcept { return path_; }

 private:
  fs::path path_;
};

std::string random_name() {
  std::random_device random;
  std::string name;
  for (int i = 0; i < 4; ++i) name += fmt::format("{:08x}", random());
  return name;
}

std::string percent_encoded(const std::string& text) {
  std::string encoded;
  for (const char c : text) encoded += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return encoded;
}

/// The task given to the studio's page.
json task_of(const RenderArguments& given, const std::string& database, const std::string& character,
             const std::string& put) {
  const Drawn& drawn = given.drawn;
  json parameters;
  std::string call = "sign";
  if (drawn.recording.empty()) {
    parameters["utterance"] = drawn.utterance;
  } else {
    parameters["recording"] = drawn.recording;
    call = drawn.replace.empty() && drawn.swap.empty() ? "recording" : "edit";
  }
  if (call == "recording") {
    if (drawn.from) parameters["from"] = *drawn.from;
    if (drawn.to) parameters["to"] = *drawn.to;
  } else {
    parameters["transition"] = drawn.how.transition;
    parameters["duration"] = drawn.how.duration;
    parameters["tempo"] = drawn.how.tempo;
    parameters["align"] = drawn.how.align;
    if (!drawn.how.handedness.empty()) parameters["handedness"] = drawn.how.handedness;
    if (!drawn.how.junctions.empty()) parameters["junctions"] = drawn.how.junctions;
    if (!drawn.replace.empty()) parameters["replace"] = drawn.replace;
    if (!drawn.swap.empty()) parameters["swap"] = drawn.swap;
  }
  const Size size = *parse_size(given.size);
  return {{"database", database},
          {"call", call},
          {"parameters", std::move(parameters)},
          {"character", character},
          {"width", size.width},
          {"height", size.height},
          {"rate", given.rate},
          {"view", given.view},
          {"kind", extension_of(given.output) == ".png" ? "png" : "webm"},
          {"at_ms", given.at.empty() ? json() : json(given.at)},
          {"put", put}};
}

/// Waits until the page has reported that it is done; returns its final report.
json wait_for(Browser& browser, const fs::path& folder, Io& io) {
  Progress progress(io, "drawing", "stopped before the drawing was finished; nothing was written");
  auto heard = std::chrono::steady_clock::now();
  fs::file_time_type last{};
  for (;;) {
    std::error_code missing;
    if (fs::exists(folder / "fault")) {
      throw Error(ErrorCode::bad_input, printable(std::string(trimmed(read_file(folder / "fault")))));
    }
    if (fs::exists(folder / "done")) return json::parse(read_file(folder / "done"), nullptr, false);
    if (!browser.running()) {
      throw Error(ErrorCode::io,
                  fmt::format("the browser ended before the drawing was finished: {}", browser.last_words()));
    }
    const auto now = std::chrono::steady_clock::now();
    const fs::file_time_type said = fs::last_write_time(folder / "progress", missing);
    if (!missing && said != last) {
      last = said;
      heard = now;
      const json report = json::parse(read_file(folder / "progress"), nullptr, false);
      if (report.is_object()) progress.show(report.value("done", 0.0) / std::max(report.value("of", 1.0), 1.0));
    }
    if (now - heard > kPatience) {
      throw Error(ErrorCode::io,
                  fmt::format("the browser has drawn nothing for two minutes: {}", browser.last_words()));
    }
    if (Interrupts::noted())
      throw Error(ErrorCode::cancelled, "stopped before the drawing was finished; nothing was written");
    std::this_thread::sleep_for(20ms);
  }
}

void save_copy(const fs::path& from, const fs::path& to) {
  AtomicFile file(to.string());
  file.write(read_file(from));
  file.commit();
}

/// Moves the results to the requested output: "film.webm", "picture.png", or for several pictures "picture-00001.png",
/// ….
std::vector<std::string> save_all(const fs::path& folder, const std::string& output) {
  if (fs::exists(folder / "film.webm")) {
    save_copy(folder / "film.webm", output);
    return {output};
  }
  std::vector<fs::path> pictures;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".png") pictures.push_back(entry.path());
  }
  std::sort(pictures.begin(), pictures.end());
  if (pictures.empty()) throw Error(ErrorCode::io, "the browser has drawn nothing");
  if (pictures.size() == 1) {
    save_copy(pictures.front(), output);
    return {output};
  }
  std::vector<std::string> files;
  for (const fs::path& picture : pictures) {
    const fs::path to = fs::path(output).replace_extension();
    files.push_back(fmt::format("{}-{}", to.string(), picture.filename().string()));
    save_copy(picture, files.back());
  }
  return files;
}

calls::Characters characters_of(const RenderArguments& given) {
  if (!given.drawn.how.character.empty()) {
    return calls::Characters(calls::read_character_file(given.drawn.how.character));
  }
  const fs::path of_studio = fs::path(given.studio) / "characters";
  return fs::is_directory(of_studio) ? calls::Characters(of_studio) : calls::Characters();
}

/// Reads the moments of --at. Words after --at that are not numbers are the utterance, which the parser cannot
/// distinguish.
void take_moments(RenderArguments& given) {
  for (const std::string& word : given.moments) {
    std::int64_t ms = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), ms);
    if (error == std::errc() && end == word.data() + word.size() && ms >= 0) {
      given.at.push_back(ms);
    } else if (given.drawn.utterance.empty() && !word.empty() && word.front() != '-' && !given.at.empty()) {
      given.drawn.utterance = word;
    } else {
      throw Error(
          ErrorCode::bad_input,
          fmt::format("--at: '{}' is not a moment; give milliseconds from the first frame, such as --at 100 200",
                      printable(word)));
    }
  }
}

/// Options that would have no effect are refused, not ignored.
void check_options(const RenderArguments& given) {
  const Drawn& drawn = given.drawn;
  if (drawn.utterance.empty() == drawn.recording.empty()) {
    throw CLI::RequiredError("either UTTERANCE or --recording");
  }
  const bool edits = !drawn.replace.empty() || !drawn.swap.empty();
  const bool part = drawn.from || drawn.to;
  if (drawn.recording.empty() && (edits || part)) {
    throw Error(ErrorCode::bad_input, "--replace, --swap, --from and --to belong to a --recording");
  }
  if (edits && part) {
    throw Error(ErrorCode::bad_input,
                "--from and --to draw a part of a recording as it is; --at takes moments of an edit");
  }
  if (!drawn.how.junctions.empty() && !drawn.recording.empty() && !edits) {
    throw Error(ErrorCode::bad_input,
                "--junction belongs to an UTTERANCE or to a change: a recording has none to make");
  }
  if (!given.at.empty() && extension_of(given.output) != ".png") {
    throw Error(ErrorCode::bad_input, "--at is for pictures: name them -o FILE.png");
  }
}

void run_render(const RenderArguments& given, Io& io) {
  check_options(given);
  if (!fs::is_regular_file(fs::path(given.studio) / "render.html")) {
    throw Error(ErrorCode::not_found,
                fmt::format("{}: no built studio in this folder (render.html); build it with studio/build FOLDER",
                            given.studio));
  }
  const fs::path browser_program = find_browser(given.browser);
  server::ServedDatabases databases;
  databases.characters = characters_of(given);
  databases.add(given.folder, false);
  report_damage(databases.all().front()->database(), io);
  const Folder scratch;
  const fs::path drawn_here = scratch.path() / "drawn";
  fs::create_directory(drawn_here);
  databases.render = server::Render{random_name(), drawn_here};
  server::Api api(databases, {}, scratch.path());
  server::ServerOptions options;
  options.port = 0;
  options.files = given.studio;
  options.scratch = scratch.path();
  const server::Server server(databases, api, options);

  const auto& characters = databases.characters.all();
  const json task = task_of(given, databases.all().front()->name(), characters.empty() ? "" : characters.front()->name,
                            "/api/renders/" + databases.render->id);
  json said;
  {
    const Interrupts interrupts;
    Browser browser(browser_program, server.url() + "/render.html#" + percent_encoded(task.dump()), scratch.path());
    said = wait_for(browser, drawn_here, io);
  }
  const std::vector<std::string> files = save_all(drawn_here, given.output);
  const auto contents = databases.all().front()->database().contents();
  Declarations declared;
  for (const RecordingInfo& info : contents->recordings) merge_declarations(info.declarations, declared);
  for (const auto& [name, value] : declared) io.err << "signweave: " << value << '\n';
  if (io.json) {
    said["files"] = files;
    io.out << wire::text_of(said);
    return;
  }
  io.out << fmt::format("{}: {} at {} frames a second\n", files.size() == 1 ? files.front() : files.front() + " …",
                        counted(said.value("frames", std::size_t{0}), "frame"), given.rate);
}

}  // namespace

Run render(CLI::App& verb) {
  auto options = std::make_shared<RenderArguments>();
  verb.add_option("DB", options->folder, "the database")->required();
  bind(verb, options->drawn, [](std::string_view) {});
  verb.add_option("-o,--output", options->output,
                  "FILE.webm, a film; FILE.png, the picture of each --at, or of every frame (FILE-00001.png …)")
      ->required()
      ->check([](const std::string& path) {
        return check_extension(path, {".webm", ".png"});
      });
  verb.add_option("--at", options->moments, "moments of pictures, ms from the first frame: --at 100 200")
      ->type_name("MS");
  verb.add_option("--size", options->size, "WIDTHxHEIGHT, even numbers up to 4096")
      ->check([](const std::string& text) {
        return parse_size(text) ? std::string() : fmt::format("'{}' is not a size such as 1280x720", printable(text));
      })
      ->capture_default_str();
  verb.add_option("--rate", options->rate, "pictures a second")->check(within(1.0, 240.0))->capture_default_str();
  verb.add_option("--view", options->view, "front, side, hands")
      ->check(one_of({"front", "side", "hands"}))
      ->capture_default_str();
  verb.add_option("--studio", options->studio, "the folder built by studio/build")
      ->envname("SIGNWEAVE_STUDIO")
      ->required();
  verb.add_option("--browser", options->browser, "the Chromium to draw with; if not given, $CHROMIUM or the system's");
  return [options](Io& io) {
    take_moments(*options);
    run_render(*options, io);
  };
}

}  // namespace signweave::cli
