#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/server/answer.h"
#include "app/server/api_state.h"
#include "app/wire/call_schema.h"
#include "app/wire/read.h"
#include "signweave/annotation/declarations.h"
#include "signweave/calls/listener.h"

namespace signweave::server {

struct Route;

/// A request being answered; belongs to one thread.
struct Call {
  ApiState& state;
  const ApiRequest& request;
  const Route& route;
  wire::Texts names;            ///< in the path: {"database": "demo"}
  Declarations declarations;    ///< of the recordings that the answer is built from
  std::vector<Notice> notices;  ///< problems that did not stop the call

  ServedDatabase& database() const { return state.databases.at(names.at("database")); }
  /// Collects notices and faults; its progress callback ends the call when the time limit is reached.
  calls::Listener listener();
  /// Adds what a recording declares.
  void declare(const Declarations& of);
  void declare_all(const Contents& contents);
};

/// Where a call's fields are.
enum class Source { none, query, body };

/// One call of the API. The table of routes is the only place that knows paths: answering, the OpenAPI document and the
/// test of docs/http.md all use it.
struct Route {
  std::string_view method;
  std::string_view path;     ///< below /api/, names in braces
  std::string_view id;       ///< operationId
  std::string_view summary;  ///< one line
  ApiResponse (*handle)(Call&);
  Source source = Source::none;
  wire::SchemaWriter (*parameters)() = nullptr;
  std::string_view answer = {};  ///< its schema in the document's components; empty: a file
  int status = 200;
  bool may_be_file = false;                ///< in addition to the JSON answer
  bool changes = false;                    ///< refused with 403 for a database that is served read-only
  bool takes_file = false;                 ///< the request's body is a file
  void (*require)(const Call&) = nullptr;  ///< throws if no body could make such a request valid
  std::string_view media_type = {};        ///< of an answer that is a file, if no field specifies it
  std::string_view takes = {};  ///< the request's body is a document of this schema, in addition to fields in the URL
};

std::span<const Route> routes();

/// The segments of a route's path: "databases", "{database}", ….
std::vector<std::string_view> segments_of(std::string_view path);
/// The values of the names in the path if the route matches, otherwise nullopt.
std::optional<wire::Texts> match(const Route& route, const std::vector<std::string>& path);

/// Reads the call's parameters from where the route puts them, and notes former names. Throws Error{bad_input},
/// StatusError 415.
template <class Parameters>
Parameters read_parameters(Call& call) {
  if (call.route.source == Source::query) {
    return wire::read_call<Parameters>(call.request.query, call.names, &call.notices);
  }
  return wire::read_call<Parameters>(wire::parse_body(call.request.body), call.names, &call.notices);
}

/// A call's parameters, and the requested format of its answer: empty for the JSON report.
template <class Parameters>
struct WithFormat {
  Parameters call;
  std::string format;
};

/// The formats that an answer can have; specialised for calls that have several.
template <class Parameters>
struct Formats;

template <class Visit, class Parameters>
void fields(Visit& visit, WithFormat<Parameters>& wanted) {
  fields(visit, wanted.call);
  visit(calls::Field{.name = "format", .help = Formats<Parameters>::help(), .one_of = Formats<Parameters>::names()},
        wanted.format);
}

// Handlers, by file.
ApiResponse list_databases(Call& call);  // handle_databases.cpp
ApiResponse show_database(Call& call);
ApiResponse show_recording(Call& call);
ApiResponse list_vocabulary(Call& call);
ApiResponse list_labels(Call& call);
ApiResponse check_database(Call& call);
ApiResponse list_formats(Call& call);
ApiResponse list_methods(Call& call);
ApiResponse list_phases(Call& call);
ApiResponse list_units(Call& call);
ApiResponse show_openapi(Call& call);
ApiResponse find_segments(Call& call);  // handle_search.cpp
ApiResponse find_nodes(Call& call);     // handle_xpath.cpp
ApiResponse count_transitions(Call& call);
ApiResponse propose_segments(Call& call);
ApiResponse evaluate_methods(Call& call);
ApiResponse list_characters(Call& call);  // handle_characters.cpp
ApiResponse show_character(Call& call);
ApiResponse list_media(Call& call);
ApiResponse show_media(Call& call);
ApiResponse put_rendered(Call& call);  // handle_renders.cpp
void require_render(const Call& call);
ApiResponse sign_utterance(Call& call);  // handle_signing.cpp
ApiResponse render_score(Call& call);
ApiResponse edit_recording(Call& call);
ApiResponse export_motion(Call& call);
ApiResponse export_annotation(Call& call);
ApiResponse annotate_recording(Call& call);  // handle_texts.cpp
ApiResponse read_text_of_utterance(Call& call);
ApiResponse relayout_database(Call& call);  // handle_changes.cpp
ApiResponse remove_recording(Call& call);
ApiResponse open_upload(Call& call);  // handle_uploads.cpp
ApiResponse show_upload(Call& call);
ApiResponse discard_upload(Call& call);
ApiResponse put_file(Call& call);
ApiResponse remove_file(Call& call);
void require_upload(const Call& call);
ApiResponse inspect_upload(Call& call);
ApiResponse import_upload(Call& call);
ApiResponse list_jobs(Call& call);
ApiResponse show_job(Call& call);
ApiResponse cancel_job(Call& call);
ApiResponse preview_upload(Call& call);  // handle_previews.cpp

/// The fields of each call that has any, for the table and the document.
wire::SchemaWriter label_fields();
wire::SchemaWriter query_fields();
wire::SchemaWriter xpath_fields();
wire::SchemaWriter stats_fields();
wire::SchemaWriter segment_fields();
wire::SchemaWriter evaluate_fields();
wire::SchemaWriter score_fields();
wire::SchemaWriter sign_fields();
wire::SchemaWriter edit_fields();
wire::SchemaWriter motion_fields();
wire::SchemaWriter annotation_fields();
wire::SchemaWriter annotate_fields();
wire::SchemaWriter utterance_fields();
wire::SchemaWriter relayout_fields();
wire::SchemaWriter import_fields();
wire::SchemaWriter preview_fields();
wire::SchemaWriter job_fields();

}  // namespace signweave::server
