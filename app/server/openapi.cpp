#include "app/server/openapi.h"

#include <algorithm>

#include "app/server/routes.h"
#include "signweave/core/version.h"

namespace signweave::server {
namespace {

using Json = nlohmann::ordered_json;

Json reference(std::string_view kind, std::string_view name) {
  return {{"$ref", std::string("#/components/").append(kind).append("/").append(name)}};
}

std::vector<std::string> names_in(std::string_view path) {
  std::vector<std::string> names;
  for (const std::string_view segment : segments_of(path)) {
    if (segment.starts_with('{')) names.emplace_back(segment.substr(1, segment.size() - 2));
  }
  return names;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

Json path_parameter(const std::string& name) {
  constexpr std::pair<std::string_view, const char*> kHelp[] = {
      {"database", "name of a database that is served"},         {"recording", "name of a recording"},
      {"upload", "the id returned when the upload was opened"},  {"file", "a plain file name, such as meteo.bvh"},
      {"job", "the id returned by the call that began the job"},
  };
  std::string help;
  for (const auto& [of, text] : kHelp) {
    if (of == name) help = text;
  }
  return {{"name", name}, {"in", "path"}, {"required", true}, {"description", help}, {"schema", {{"type", "string"}}}};
}

/// The fields of a call that are not in its path.
struct Fields {
  Json properties = Json::object();
  std::vector<std::string> required;
};
Fields fields_of(const Route& route) {
  Fields found;
  if (route.parameters == nullptr) return found;
  const wire::SchemaWriter writer = route.parameters();
  const std::vector<std::string> in_path = names_in(route.path);
  for (const auto& [name, schema] : writer.properties.items()) {
    if (!has(in_path, name)) found.properties[name] = schema;
  }
  for (const std::string& name : writer.required) {
    if (!has(in_path, name)) found.required.push_back(name);
  }
  return found;
}

Json parameters_of(const Route& route) {
  Json parameters = Json::array();
  for (const std::string& name : names_in(route.path)) parameters.push_back(path_parameter(name));
  if (route.source != Source::query) return parameters;
  const Fields fields = fields_of(route);
  for (const auto& [name, schema] : fields.properties.items()) {
    Json of = schema;
    Json one = {{"name", name}, {"in", "query"}, {"description", of["description"]}};
    of.erase("description");
    if (has(fields.required, name)) one["required"] = true;
    if (of["type"] == "array") {  // a,b,c
      one["style"] = "form";
      one["explode"] = false;
    }
    one["schema"] = std::move(of);
    parameters.push_back(std::move(one));
  }
  return parameters;
}

Json body_of(const Route& route) {
  if (route.takes_file) {
    return {{"required", true}, {"content", {{"application/octet-stream", Json::object()}}}};
  }
  if (!route.takes.empty()) {
    return {{"required", true}, {"content", {{"application/json", {{"schema", reference("schemas", route.takes)}}}}}};
  }
  const Fields fields = fields_of(route);
  Json schema = {{"type", "object"}, {"properties", fields.properties}, {"additionalProperties", false}};
  if (!fields.required.empty()) schema["required"] = fields.required;
  return {{"required", !fields.required.empty()}, {"content", {{"application/json", {{"schema", std::move(schema)}}}}}};
}

/// The media types of the files that a call can answer with.
Json files_of(const Route& route) {
  Json content = Json::object();
  if (route.answer.empty() && !route.may_be_file) {  // always a file, of one kind where there is no choice
    if (!route.media_type.empty()) content[std::string(route.media_type)] = Json::object();
  }
  if (route.parameters == nullptr) return content;
  const Json properties = route.parameters().properties;
  if (!properties.contains("format")) return content;
  for (const Json& name : properties["format"]["enum"]) {
    const std::string type(answer_format(name.get<std::string>()).media_type);
    if (type != "application/json" || route.answer.empty()) content[type] = Json::object();
  }
  return content;
}

Json responses_of(const Route& route) {
  Json content = Json::object();
  if (!route.answer.empty()) content["application/json"] = {{"schema", reference("schemas", route.answer)}};
  const Json files = files_of(route);
  for (const auto& [type, none] : files.items()) content[type] = none;
  Json good = {{"description", std::string(route.summary)},
               {"headers",
                {{"Signweave-Declarations", reference("headers", "Declarations")},
                 {"Signweave-Notices", reference("headers", "Notices")}}},
               {"content", std::move(content)}};
  return {{std::to_string(route.status), std::move(good)}, {"default", reference("responses", "Fault")}};
}

Json components() {
  Json parts = Json::object();
  parts["schemas"] = answer_schemas();
  parts["responses"] = {
      {"Fault",
       {{"description",
         "400 the request is wrong, 403 served for reading only, 404 a named resource does not exist, 405, 409 another "
         "client is changing it, 413 exceeds the server's limits, 415, 422 understood, but cannot be done, 500, 503 "
         "stopped by a time limit, or busy"},
        {"content", {{"application/json", {{"schema", reference("schemas", "Fault")}}}}}}}};
  parts["headers"] = {
      {"Declarations",
       {{"description",
         "what the recordings used in the answer declare about themselves, as JSON in ASCII: that a demo's signs are "
         "placeholders, for example; a program that shows the answer must show this"},
        {"schema", {{"type", "string"}}}}},
      {"Notices",
       {{"description",
         "problems that did not stop the call, as a JSON list of objects with where and text, in ASCII; ten at most"},
        {"schema", {{"type", "string"}}}}}};
  parts["securitySchemes"] = {
      {"token", {{"type", "http"}, {"scheme", "bearer"}, {"description", "if the server requires one"}}}};
  return parts;
}

}  // namespace

Json openapi_document() {
  Json paths = Json::object();
  for (const Route& route : routes()) {
    std::string method(route.method);
    std::ranges::transform(method, method.begin(), [](char c) { return static_cast<char>(c - 'A' + 'a'); });
    Json operation = {{"operationId", std::string(route.id)},
                      {"summary", std::string(route.summary)},
                      {"parameters", parameters_of(route)}};
    if (route.source == Source::body || route.takes_file || !route.takes.empty())
      operation["requestBody"] = body_of(route);
    operation["responses"] = responses_of(route);
    paths[std::string("/").append(route.path)][method] = std::move(operation);
  }
  Json no_token = Json::object();
  Json document = {
      {"openapi", "3.1.0"},
      {"info",
       {{"title", "signweave"},
        {"version", std::string(version())},
        {"description",
         "A database of captured signing: search by meaning, make new signing. docs/http.md describes it by task. "
         "Frames as they are "
         "signed come over the WebSocket at /api/stream, which docs/stream.md describes."},
        {"license", {{"name", "see LICENSE and NOTICE"}}}}},
      {"servers", Json::array({{{"url", "/api"}}})},
      {"security", Json::array({no_token, {{"token", Json::array()}}})},
      {"paths", std::move(paths)},
      {"components", components()}};
  return document;
}

std::string Api::openapi() {
  return openapi_document().dump(2) + '\n';
}

}  // namespace signweave::server
