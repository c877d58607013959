#include "signweave/formats/eaf/xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "signweave/core/text.h"

namespace signweave::eaf {
namespace {

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";

void append_utf8(std::string& out, std::uint32_t letter) {
  if (letter > 0x10FFFF || (letter >= 0xD800 && letter < 0xE000)) letter = 0xFFFD;
  const auto put = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
  if (letter < 0x80) {
    put(letter);
  } else if (letter < 0x800) {
    put(0xC0 | (letter >> 6));
    put(0x80 | (letter & 0x3F));
  } else if (letter < 0x10000) {
    put(0xE0 | (letter >> 12));
    put(0x80 | ((letter >> 6) & 0x3F));
    put(0x80 | (letter & 0x3F));
  } else {
    put(0xF0 | (letter >> 18));
    put(0x80 | ((letter >> 12) & 0x3F));
    put(0x80 | ((letter >> 6) & 0x3F));
    put(0x80 | (letter & 0x3F));
  }
}

/// The number of bytes in a unit and their order; width 1 is ISO-8859-1.
struct Encoding {
  std::size_t width = 0;  ///< 0: UTF-8
  bool big_endian = false;
  std::size_t mark = 0;  ///< bytes of the byte order mark
};

std::string to_utf8(std::string_view bytes, Encoding encoding) {
  std::string out;
  out.reserve(bytes.size());
  const std::size_t width = encoding.width;
  const auto unit = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < width; ++i) {
      const std::size_t from = encoding.big_endian ? at + i : at + width - 1 - i;
      value = (value << 8) | static_cast<unsigned char>(bytes[from]);
    }
    return value;
  };
  for (std::size_t at = encoding.mark; at + width <= bytes.size(); at += width) {
    std::uint32_t letter = unit(at);
    if (width == 2 && letter >= 0xD800 && letter < 0xDC00 && at + 4 <= bytes.size()) {
      const std::uint32_t low = unit(at + 2);
      if (low >= 0xDC00 && low < 0xE000) {
        letter = 0x10000 + ((letter - 0xD800) << 10) + (low - 0xDC00);
        at += 2;
      }
    }
    append_utf8(out, letter);
  }
  return out;
}

Encoding encoding_by_bytes(std::string_view bytes) {
  const auto starts = [&](std::string_view with) { return bytes.starts_with(with); };
  using namespace std::string_view_literals;
  if (starts("\xFF\xFE\0\0"sv)) return {.width = 4, .mark = 4};
  if (starts("\0\0\xFE\xFF"sv)) return {.width = 4, .big_endian = true, .mark = 4};
  if (starts("\xFF\xFE"sv)) return {.width = 2, .mark = 2};
  if (starts("\xFE\xFF"sv)) return {.width = 2, .big_endian = true, .mark = 2};
  if (starts("<\0\0\0"sv)) return {.width = 4};
  if (starts("\0\0\0<"sv)) return {.width = 4, .big_endian = true};
  if (starts("<\0"sv)) return {.width = 2};
  if (starts("\0<"sv)) return {.width = 2, .big_endian = true};
  return {};
}

/// The encoding in the XML declaration, in lower case; empty if there is none.
std::string declared_encoding(std::string_view bytes) {
  std::string_view head = bytes.substr(0, 1024);
  if (head.starts_with(kUtf8Mark)) head.remove_prefix(kUtf8Mark.size());
  if (!head.starts_with("<?xml")) return {};
  head = head.substr(0, head.find("?>"));
  std::size_t at = head.find("encoding");
  // The name of an attribute, not the end of a longer name.
  while (at != std::string_view::npos && std::string_view(" \t\r\n").find(head[at - 1]) == std::string_view::npos) {
    at = head.find("encoding", at + 1);
  }
  if (at == std::string_view::npos) return {};
  const std::size_t open = head.find_first_of("\"'", at);
  if (open == std::string_view::npos) return {};
  const std::size_t close = head.find(head[open], open + 1);
  if (close == std::string_view::npos) return {};
  const std::string_view name = head.substr(open + 1, close - open - 1);
  return name == "UTF-8" ? "utf-8" : fold_case(name);
}

/// Checks for control characters that are written out; almost no file has any, which this quickly establishes.
bool holds_control_characters(std::string_view text) noexcept {
  // Without branches and in bytes alone, so that the compiler tests sixteen characters at once.
  std::uint8_t found = 0;
  for (const char letter : text) {
    const auto code = static_cast<std::uint8_t>(letter);
    const std::uint8_t control = code < 0x20 && code != '\t' && code != '\n' && code != '\r' ? 1 : 0;
    found = std::max(found, control);
  }
  return found != 0;
}

}  // namespace

Xml::Xml(std::string name, std::string_view bytes, std::string_view wanted) : name_(std::move(name)) {
  decode(bytes, wanted);
  // Blank labels are valid labels: without ws_pcdata they would be dropped.
  const pugi::xml_parse_result result =
      document_.load_buffer(text_.data(), text_.size(), pugi::parse_full | pugi::parse_ws_pcdata, pugi::encoding_utf8);
  if (result.status == pugi::status_no_document_element) {
    fail_at(0, fmt::format("there is no XML element in it; give {}", wanted));
  }
  if (result.status != pugi::status_ok) {
    const auto offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0));
    std::string description = result.description();
    if (!description.empty()) description[0] = static_cast<char>(description[0] | 0x20);
    fail_at(offset, fmt::format("the XML is broken or cut off here ({}); restore the file from a copy", description));
  }
}

void Xml::decode(std::string_view bytes, std::string_view wanted) {
  using namespace std::string_view_literals;
  text_ = bytes;
  const std::string_view unmarked = bytes.starts_with(kUtf8Mark) ? bytes.substr(kUtf8Mark.size()) : bytes;
  if (trimmed(unmarked).empty()) {
    throw Error(ErrorCode::bad_input, fmt::format("{}: is empty; give {}", name_, wanted));
  }
  Encoding encoding = encoding_by_bytes(bytes);
  const std::string declared = encoding.width == 0 ? declared_encoding(bytes) : std::string();
  if (declared == "iso-8859-1" || declared == "latin1" || declared == "latin-1") encoding = {.width = 1};
  if (encoding.width != 0) {
    converted_ = to_utf8(bytes, encoding);
    text_ = converted_;
  }
  const std::string_view start = trimmed(text_.substr(text_.starts_with(kUtf8Mark) ? kUtf8Mark.size() : 0));
  if (text_.find('\0') != std::string_view::npos || !start.starts_with('<')) {
    fail_at(0, fmt::format("this is not XML; give {}", wanted));
  }
  has_references_ = text_.find("&#") != std::string_view::npos;
  if (is_utf8(text_)) return;
  if (!declared.empty() && declared != "utf-8" && declared != "utf8") {
    fail_at(0, fmt::format("the encoding '{}' is not read here; save the file as UTF-8", printable(declared)));
  }
  std::size_t begin = 0;
  for (std::size_t next : line_starts()) {
    if (!is_utf8(text_.substr(begin, next - begin))) break;
    begin = next;
  }
  fail_at(begin, "a byte here is not UTF-8; save the file as UTF-8, or name its encoding in the first line");
}

const std::vector<std::size_t>& Xml::line_starts() const {
  if (line_starts_.empty()) {
    line_starts_.push_back(0);
    for (std::size_t at = text_.find('\n'); at != std::string_view::npos; at = text_.find('\n', at + 1)) {
      line_starts_.push_back(at + 1);
    }
  }
  return line_starts_;
}

std::size_t Xml::line_at(std::size_t offset) const {
  const std::vector<std::size_t>& starts = line_starts();
  return static_cast<std::size_t>(std::upper_bound(starts.begin(), starts.end(), offset) - starts.begin());
}

std::size_t Xml::line_of(pugi::xml_node node) const {
  const std::ptrdiff_t offset = node.offset_debug();
  return offset < 0 ? 0 : line_at(static_cast<std::size_t>(offset));
}

std::string Xml::where(pugi::xml_node node) const {
  const std::size_t line = line_of(node);
  return line == 0 ? name_ : fmt::format("{}:{}", name_, line);
}

std::string_view Xml::attribute(pugi::xml_node node, const char* name) const {
  // Most files have their attributes in the order in which they are requested, so the search continues where it last
  // ended.
  if (node != last_node_) {
    last_node_ = node;
    last_attribute_ = pugi::xml_attribute();
  }
  const std::string_view value = node.attribute(name, last_attribute_).value();
  // A character reference may name half a surrogate pair.
  if (has_references_ && !is_utf8(value)) fail(node, fmt::format("{} is not valid Unicode; write it again", name));
  return value;
}

std::string_view Xml::required(pugi::xml_node node, const char* name) const {
  const std::string_view value = attribute(node, name);
  if (value.empty()) fail(node, fmt::format("<{}> has no {}; add it", node.name(), name));
  return value;
}

std::string Xml::content(pugi::xml_node node) const {
  std::string text;
  for (pugi::xml_node child = node.first_child(); child; child = child.next_sibling()) {
    if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) text += child.value();
  }
  if (has_references_ && !is_utf8(text))
    fail(node, fmt::format("the text of <{}> is not valid Unicode; write it again", node.name()));
  return text;
}

void Xml::fail(pugi::xml_node node, std::string_view what) const {
  throw Error(ErrorCode::bad_input, fmt::format("{}: {}", where(node), what));
}

void Xml::fail_at(std::size_t offset, std::string_view what) const {
  throw Error(ErrorCode::bad_input, fmt::format("{}:{}: {}", name_, line_at(offset), what));
}

Notice Xml::notice(pugi::xml_node node, std::string_view what) const {
  return {where(node), std::string(what)};
}

void refuse_control_characters(const Xml& xml) {
  const std::string_view text = xml.text();
  if (!xml.has_references() && !holds_control_characters(text)) return;
  std::size_t line = 1;
  std::size_t plain_until = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned code = static_cast<unsigned char>(text[i]);
    if (code == '\n') ++line;
    if (i >= plain_until) {  // in comments and CDATA a reference has no meaning
      if (text.substr(i, 4) == "<!--") plain_until = text.find("-->", i);
      if (text.substr(i, 9) == "<![CDATA[") plain_until = text.find("]]>", i);
    }
    if (i >= plain_until && text.substr(i, 2) == "&#") {
      const bool hexadecimal = text.substr(i + 2, 1) == "x";
      const char* begin = text.data() + i + (hexadecimal ? 3 : 2);
      if (std::from_chars(begin, text.data() + text.size(), code, hexadecimal ? 16 : 10).ec != std::errc()) code = '?';
    }
    if (code >= 0x20 || code == '\t' || code == '\n' || code == '\r') continue;
    throw Error(ErrorCode::bad_input,
                fmt::format("{}:{}: a control character (\\x{:02x}), which XML cannot hold; remove it", xml.name(),
                            line, code));
  }
}

std::string escaped(std::string_view text, std::string_view what) {
  const auto refuse = [&](std::string_view fault) {
    throw Error(ErrorCode::bad_input, fmt::format("{} '{}' {}; remove it", what, printable(text), fault));
  };
  if (!is_utf8(text)) refuse("has bytes that are not UTF-8");
  if (text.find("\xEF\xBF\xBE") != std::string_view::npos || text.find("\xEF\xBF\xBF") != std::string_view::npos) {
    refuse("has a code point that XML cannot hold");
  }
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\n':  // unescaped, it would be lost in an attribute
        out += "&#10;";
        break;
      case '\r':
        out += "&#13;";
        break;
      case '\t':
        out += "&#9;";
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20) refuse("has a control character, which XML cannot hold");
        out += c;
    }
  }
  return out;
}

}  // namespace signweave::eaf
