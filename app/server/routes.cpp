#include "app/server/routes.h"

#include <chrono>

namespace signweave::server {
namespace {

constexpr Route kRoutes[] = {
    {"GET", "databases", "listDatabases", "the databases that are served", list_databases, Source::none, nullptr,
     "Databases"},
    {"GET", "databases/{database}", "showDatabase", "what a database holds", show_database, Source::none, nullptr,
     "Database"},
    {"GET", "databases/{database}/recordings/{recording}", "showRecording", "all that is known of a recording",
     show_recording, Source::none, nullptr, "Recording"},
    {"GET", "databases/{database}/vocabulary", "vocabulary",
     "glosses, tiers, recordings and signers, and the words of queries", list_vocabulary, Source::none, nullptr,
     "Vocabulary"},
    {"GET", "databases/{database}/labels", "labels", "what the annotations of a tier say, and how many say it",
     list_labels, Source::query, label_fields, "Labels"},
    {"GET", "databases/{database}/check", "checkDatabase", "verify every stored byte", check_database, Source::none,
     nullptr, "Check"},
    {"GET", "databases/{database}/query", "query", "find signs, phases and annotations", find_segments, Source::query,
     query_fields, "Answers", 200, true},
    {"POST", "databases/{database}/query", "postQuery", "the same, with the query in the body", find_segments,
     Source::body, query_fields, "Answers", 200, true},
    {"GET", "databases/{database}/xpath", "xpath", "ask the annotation documents themselves, in XPath 1.0", find_nodes,
     Source::query, xpath_fields, "Nodes", 200, true},
    {"POST", "databases/{database}/xpath", "postXPath", "the same, with the expression in the body", find_nodes,
     Source::body, xpath_fields, "Nodes", 200, true},
    {"GET", "databases/{database}/stats", "stats", "durations of the recorded transitions", count_transitions,
     Source::query, stats_fields, "Statistics", 200, true},
    {"POST", "databases/{database}/evaluate", "evaluate",
     "cut captured movements out, make them again by each method, compare: begins a job", evaluate_methods,
     Source::body, evaluate_fields, "JobBegun", 202},
    {"POST", "databases/{database}/sign", "sign", "make new signing from glosses", sign_utterance, Source::body,
     sign_fields, "Synthesis", 200, true},
    {"POST", "databases/{database}/edit", "edit", "change a recording's words", edit_recording, Source::body,
     edit_fields, "Synthesis", 200, true},
    {"POST",
     "databases/{database}/score",
     "renderScore",
     "render a score, or some of its frames: nothing is chosen",
     render_score,
     Source::query,
     score_fields,
     "Synthesis",
     200,
     true,
     false,
     false,
     nullptr,
     {},
     "Score"},
    {"GET", "databases/{database}/recordings/{recording}/motion", "exportMotion",
     "a recording's motion, or a part of it", export_motion, Source::query, motion_fields},
    {"GET",
     "databases/{database}/recordings/{recording}/annotation",
     "exportAnnotation",
     "a recording's annotation, or a part of it, as EAF",
     export_annotation,
     Source::query,
     annotation_fields,
     {},
     200,
     false,
     false,
     false,
     nullptr,
     "application/xml"},
    {"GET", "databases/{database}/recordings/{recording}/media", "listMedia",
     "video and sound that the annotation links, and whether the server has them", list_media, Source::none, nullptr,
     "Media"},
    {"GET",
     "databases/{database}/recordings/{recording}/media/{number}",
     "showMedia",
     "one of them, by its place in the list; takes Range",
     show_media,
     Source::none,
     nullptr,
     {},
     200,
     false,
     false,
     false,
     nullptr,
     "video/*"},
    {"GET", "databases/{database}/recordings/{recording}/segment", "segment",
     "propose phases of both hands, from motion alone", propose_segments, Source::query, segment_fields, "Proposals",
     200, true},
    {"DELETE", "databases/{database}/recordings/{recording}", "removeRecording", "remove a recording", remove_recording,
     Source::none, nullptr, "Removed", 200, false, true},
    {"POST", "databases/{database}/relayout", "relayout", "store motions in another access mode: begins a job",
     relayout_database, Source::body, relayout_fields, "JobBegun", 202, false, true},
    {"POST", "databases/{database}/uploads", "openUpload", "begin to send files", open_upload, Source::none, nullptr,
     "Upload", 201, false, true},
    {"GET", "databases/{database}/uploads/{upload}", "showUpload", "what was sent so far", show_upload, Source::none,
     nullptr, "Upload"},
    {"DELETE", "databases/{database}/uploads/{upload}", "discardUpload", "give an upload up", discard_upload,
     Source::none, nullptr, "Discarded", 200, false, true},
    {"PUT", "databases/{database}/uploads/{upload}/files/{file}", "putFile", "send a file: the body is its bytes",
     put_file, Source::none, nullptr, "UploadedFile", 200, false, true, true, require_upload},
    {"DELETE", "databases/{database}/uploads/{upload}/files/{file}", "removeFile", "take a file out of an upload",
     remove_file, Source::none, nullptr, "Upload", 200, false, true},
    {"POST", "databases/{database}/uploads/{upload}/inspect", "inspect",
     "what an import of what was sent would store, and what is guessed for it: begins a job", inspect_upload,
     Source::body, import_fields, "JobBegun", 202, false, true},
    {"POST",
     "databases/{database}/uploads/{upload}/preview",
     "preview",
     "a piece of a file's motion as an import would store it, for drawing",
     preview_upload,
     Source::body,
     preview_fields,
     {},
     200,
     false,
     true,
     false,
     nullptr,
     "application/vnd.signweave.frames"},
    {"POST", "databases/{database}/uploads/{upload}/import", "import", "import what was sent: begins a job",
     import_upload, Source::body, import_fields, "JobBegun", 202, false, true},
    {"GET", "jobs", "listJobs", "the jobs that wait, run, or were the last", list_jobs, Source::none, nullptr, "Jobs"},
    {"GET", "jobs/{job}", "showJob", "how far a job is, and what came of it", show_job, Source::query, job_fields,
     "Job"},
    {"DELETE", "jobs/{job}", "cancelJob", "stop a job", cancel_job, Source::none, nullptr, "Job", 202},
    {"GET", "characters", "listCharacters", "the characters that motions may be shown on", list_characters,
     Source::none, nullptr, "Characters"},
    {"GET",
     "characters/{character}",
     "showCharacter",
     "a character as GLB",
     show_character,
     Source::none,
     nullptr,
     {},
     200,
     false,
     false,
     false,
     nullptr,
     "model/gltf-binary"},
    {"PUT", "renders/{render}/{file}", "putRendered",
     "what the page that draws for `signweave render` sends back: the body is its bytes", put_rendered, Source::none,
     nullptr, "RenderedFile", 200, false, false, true, require_render},
    {"GET", "formats", "formats", "the file formats, and what each can hold", list_formats, Source::none, nullptr,
     "FileFormats"},
    {"GET", "openapi.json", "openapi", "this document", show_openapi, Source::none, nullptr, "OpenApi"},
};

}  // namespace

std::span<const Route> routes() {
  return kRoutes;
}

std::vector<std::string_view> segments_of(std::string_view path) {
  std::vector<std::string_view> segments;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    segments.push_back(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return segments;
}

std::optional<calls::Texts> match(const Route& route, const std::vector<std::string>& path) {
  const std::vector<std::string_view> segments = segments_of(route.path);
  if (segments.size() != path.size()) return std::nullopt;
  calls::Texts names;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (segments[i].starts_with('{')) {
      names.emplace(segments[i].substr(1, segments[i].size() - 2), path[i]);
    } else if (segments[i] != path[i]) {
      return std::nullopt;
    }
  }
  return names;
}

calls::Listener Call::listener() {
  const auto over = std::chrono::steady_clock::now() + state.limits.sign_time;
  return {.notice = [this](const Notice& notice) { notices.push_back(notice); },
          .fault =
              [this](const std::string& line, const Remedies& remedies) {
                notices.push_back({"", line, remedies});
              },
          .stage = {},
          .progress =
              [over](double) {
                if (std::chrono::steady_clock::now() < over) return;
                throw Error(ErrorCode::cancelled, "the call took longer than the server allows; ask for less");
              }};
}

void Call::declare(const std::vector<std::pair<std::string, std::string>>& of) {
  for (const auto& [name, value] : of) declarations[name] = value;
}

void Call::declare_all(const Contents& contents) {
  for (const RecordingInfo& info : contents.recordings) declare(info.declarations);
}

}  // namespace signweave::server
