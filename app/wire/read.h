#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/calls/field.h"
#include "signweave/core/error.h"

namespace signweave::wire {

using calls::Field;

using Texts = std::map<std::string, std::string>;

/// The notice about a parameter that was given by its former name: "'remake' is now 'regenerate'".
Notice renamed(const Field& field);

/// Reads a call's fields from a JSON object or from named texts, such as a URL's query. A wrong value, a missing field
/// and an unknown field are Error{bad_input, "FIELD: …"} in one line, the last with near matches. A field's former name
/// is also accepted, with a notice; giving both names is an error.
class FieldReader {
 public:
  /// `given`: fields that are known already, such as names in a URL's path; the source must not contain them.
  FieldReader(nlohmann::json object, const Texts& given);
  /// Lists are separated by commas; a flag is true, false, 1, 0, or nothing, which is true.
  FieldReader(const Texts& texts, const Texts& given);

  template <class Member>
  void operator()(const Field& field, Member& member) {
    if (const std::optional<nlohmann::json> value = take(field)) read(field, *value, member);
  }
  /// Throws if the source contains something that no field took.
  void finish() const;
  /// One notice for each field that was given by its former name.
  const std::vector<Notice>& notices() const { return notices_; }

 private:
  std::optional<nlohmann::json> take(const Field& field);
  void read(const Field& field, const nlohmann::json& value, std::string& member) const;
  void read(const Field& field, const nlohmann::json& value, std::vector<std::string>& member) const;
  void read(const Field& field, const nlohmann::json& value, bool& member) const;
  void read(const Field& field, const nlohmann::json& value, double& member) const;
  void read(const Field& field, const nlohmann::json& value, std::int64_t& member) const;
  void read(const Field& field, const nlohmann::json& value, std::size_t& member) const;
  template <class Member>
  void read(const Field& field, const nlohmann::json& value, std::optional<Member>& member) const {
    read(field, value, member.emplace());
  }

  nlohmann::json object_;
  const Texts* given_;
  bool texts_ = false;  ///< every value is a text
  std::vector<std::string> known_;
  std::vector<std::string> formers_;  ///< accepted like known names, but never suggested
  std::vector<Notice> notices_;
};

/// Reads a call from an object or texts; fields that are not given keep their defaults. Appends notices about former
/// names to `notices`.
template <class Call, class Source>
Call read_call(const Source& source, const Texts& given = {}, std::vector<Notice>* notices = nullptr) {
  Call call;
  FieldReader reader(source, given);
  fields(reader, call);
  reader.finish();
  if (notices != nullptr) notices->insert(notices->end(), reader.notices().begin(), reader.notices().end());
  return call;
}

/// Parses a JSON document; an empty text is an empty object. Nesting is limited to 64 levels. Throws Error{bad_input,
/// "body:LINE:COLUMN: …"}.
nlohmann::json parse_body(std::string_view text);

}  // namespace signweave::wire
