#include "app/wire/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave::wire {
namespace {

using calls::Bound;
using nlohmann::json;

constexpr std::string_view kTextFlags[] = {"true", "1", "", "false", "0"};

/// A value as it may be shown in a message.
std::string shown(const json& value) {
  return value.is_string() ? fmt::format("'{}'", printable(value.get<std::string>()))
                           : printable(value.dump(-1, ' ', false, json::error_handler_t::replace));
}

[[noreturn]] void refuse(const Field& field, const std::string& what) {
  throw Error(ErrorCode::bad_input, fmt::format("{}: {}", field.name, what));
}

double as_double(const Bound& bound) {
  return std::visit([](auto value) { return static_cast<double>(value); }, bound);
}

std::string range_text(const Field& field) {
  return field.range ? fmt::format(" from {} to {}", as_double(field.range->least), as_double(field.range->most)) : "";
}

void check_range(const Field& field, double value, const json& given) {
  if (!std::isfinite(value) ||
      (field.range && (value < as_double(field.range->least) || value > as_double(field.range->most)))) {
    refuse(field, fmt::format("expected a number{}, not {}", range_text(field), shown(given)));
  }
}

void check_text(const Field& field, const std::string& text) {
  if (!field.one_of.empty() && std::ranges::find(field.one_of, text) == field.one_of.end()) {
    refuse(field, fmt::format("'{}' is none of {}{}", printable(text), fmt::join(field.one_of, ", "),
                              did_you_mean(text, field.one_of)));
  }
  if (field.check == nullptr) return;
  if (const std::string fault = field.check(text); !fault.empty()) refuse(field, fault);
}

template <class Number>
Number whole_number(const Field& field, const json& value, bool texts) {
  Number number{};
  bool good = false;
  if (texts && value.is_string()) {
    const std::string text = value.get<std::string>();
    const char* end = text.data() + text.size();
    const auto [parsed, error] = std::from_chars(text.data(), end, number);
    good = error == std::errc{} && parsed == end;
  } else if constexpr (std::is_signed_v<Number>) {
    good = value.is_number_integer() && !(value.is_number_unsigned() && value.get<std::uint64_t>() >> 63 != 0);
  } else {
    good = value.is_number_unsigned() || (value.is_number_integer() && value.get<std::int64_t>() >= 0);
  }
  if (!good) refuse(field, fmt::format("expected a whole number{}, not {}", range_text(field), shown(value)));
  if (value.is_number()) number = value.get<Number>();
  check_range(field, static_cast<double>(number), value);
  if (field.check != nullptr) check_text(field, fmt::format("{}", number));
  return number;
}

constexpr std::size_t kMostNested = 64;

/// The position where the text nests lists or objects too deeply; npos if it does not. Copying and writing a value
/// takes stack space for each level, so deep nesting must be refused before a value is built.
std::size_t too_deep(std::string_view text) {
  std::size_t depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_text) {
      if (c == '\\') ++i;
      in_text = c != '"';
    } else if (c == '"') {
      in_text = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kMostNested) return i;
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return std::string_view::npos;
}

[[noreturn]] void refuse_body(std::string_view text, std::size_t at, const std::string& what) {
  const std::string_view before = text.substr(0, at);
  const auto line = 1 + std::ranges::count(before, '\n');
  const std::size_t start = before.find_last_of('\n') + 1;  // npos + 1 is 0
  const auto column = 1 + std::ranges::count_if(before.substr(start), [](char c) { return (c & 0xC0) != 0x80; });
  throw Error(ErrorCode::bad_input, fmt::format("body:{}:{}: {}", line, column, what));
}

}  // namespace

Notice renamed(const Field& field) {
  return {.where = "", .text = fmt::format("'{}' is now '{}'", field.former, field.name)};
}

FieldReader::FieldReader(json object, const Texts& given) : object_(std::move(object)), given_(&given) {
  if (!object_.is_object()) throw Error(ErrorCode::bad_input, "expected a JSON object, such as {\"text\": \"…\"}");
}

FieldReader::FieldReader(const Texts& texts, const Texts& given)
    : object_(json::object()), given_(&given), texts_(true) {
  for (const auto& [name, text] : texts) object_[name] = text;
}

std::optional<json> FieldReader::take(const Field& field) {
  const std::string name(field.name);
  if (const auto at = given_->find(name); at != given_->end()) return json(at->second);
  known_.push_back(name);
  auto at = object_.find(name);
  if (!field.former.empty()) {
    formers_.emplace_back(field.former);
    if (const auto former = object_.find(formers_.back()); former != object_.end()) {
      if (at != object_.end()) refuse(field, fmt::format("also given as '{}', its former name", field.former));
      notices_.push_back(renamed(field));
      at = former;
    }
  }
  if (at != object_.end()) return *at;
  if (field.required) refuse(field, "missing: " + field.help);
  return std::nullopt;
}

void FieldReader::finish() const {
  for (const auto& [name, value] : object_.items()) {
    if (std::ranges::find(known_, name) != known_.end()) continue;
    if (std::ranges::find(formers_, name) != formers_.end()) continue;
    throw Error(ErrorCode::bad_input, fmt::format("no field '{}'{}", printable(name), did_you_mean(name, known_)));
  }
}

void FieldReader::read(const Field& field, const json& value, std::string& member) const {
  if (field.or_number && value.is_number()) {
    member = value.dump();
  } else if (value.is_string()) {
    member = value.get<std::string>();
  } else {
    refuse(field, fmt::format("expected a text, not {}", shown(value)));
  }
  check_text(field, member);
}

void FieldReader::read(const Field& field, const json& value, std::vector<std::string>& member) const {
  json list = value;
  if (texts_ && value.is_string()) {
    list = json::array();
    const std::string text = value.get<std::string>();
    for (std::size_t begin = 0; begin <= text.size() && !text.empty();) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      list.push_back(text.substr(begin, end - begin));
      begin = end + 1;
    }
  }
  if (!list.is_array()) refuse(field, fmt::format("expected a list of texts, not {}", shown(value)));
  member.clear();
  for (const json& one : list) {
    if (!one.is_string()) refuse(field, fmt::format("expected a list of texts, not {} in it", shown(one)));
    member.push_back(one.get<std::string>());
    check_text(field, member.back());
  }
}

void FieldReader::read(const Field& field, const json& value, bool& member) const {
  if (value.is_boolean()) {
    member = value.get<bool>();
    return;
  }
  const std::string text = texts_ && value.is_string() ? value.get<std::string>() : "?";
  const auto at = std::ranges::find(kTextFlags, text);
  if (at == std::end(kTextFlags)) refuse(field, fmt::format("expected true or false, not {}", shown(value)));
  member = at - std::begin(kTextFlags) < 3;
}

void FieldReader::read(const Field& field, const json& value, double& member) const {
  bool good = value.is_number();
  std::string text;
  if (good) {
    member = value.get<double>();
    text = value.dump();
  } else if (texts_ && value.is_string()) {
    text = value.get<std::string>();
    const char* end = text.data() + text.size();
    const auto [parsed, error] = std::from_chars(text.data(), end, member);
    good = error == std::errc{} && parsed == end;
  }
  if (!good) refuse(field, fmt::format("expected a number{}, not {}", range_text(field), shown(value)));
  check_range(field, member, value);
  if (field.check != nullptr) check_text(field, text);
}

void FieldReader::read(const Field& field, const json& value, std::int64_t& member) const {
  member = whole_number<std::int64_t>(field, value, texts_);
}

void FieldReader::read(const Field& field, const json& value, std::size_t& member) const {
  member = whole_number<std::size_t>(field, value, texts_);
}

json parse_body(std::string_view text) {
  if (trimmed(text).empty()) return json::object();
  if (const std::size_t at = too_deep(text); at != std::string_view::npos) {
    refuse_body(text, at, fmt::format("lists and objects are nested deeper than {}", kMostNested));
  }
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    const std::size_t at = std::min(error.byte == 0 ? 0 : error.byte - 1, text.size());
    refuse_body(text, at,
                fmt::format("this is not JSON; {}", at >= text.size() ? "it ends too early" : "look at this place"));
  } catch (const json::exception&) {  // a number that is out of range
    throw Error(ErrorCode::bad_input, "body:1:1: this is not JSON that can be read: a number is out of range");
  }
}

}  // namespace signweave::wire
