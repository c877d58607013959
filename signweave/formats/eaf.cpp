#include "signweave/formats/eaf.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "signweave/core/atomic_file.h"
#include "signweave/formats/eaf_edit.h"
#include "signweave/formats/eaf_elements.h"
#include "signweave/formats/eaf_generate.h"
#include "signweave/formats/eaf_parse.h"

namespace signweave::eaf {

File read(const std::filesystem::path& path) {
  return read_text(path.string(), read_file(path));
}

namespace {

/// Written out, at least; nearly no file does, and that is soon known.
bool holds_control_characters(std::string_view text) noexcept {
  unsigned char found = 0;  // without branches, so that the compiler looks at many letters at once
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    found |= static_cast<unsigned char>((code < 0x20) & (code != '\t') & (code != '\n') & (code != '\r'));
  }
  return found != 0;
}

/// XML cannot hold control characters, written out or as references; the parser lets them pass, and would cut a label
/// at &#0;.
void refuse_control_characters(const Xml& xml) {
  const std::string_view text = xml.text();
  if (!xml.has_references() && !holds_control_characters(text)) return;
  std::size_t line = 1;
  std::size_t plain_until = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned code = static_cast<unsigned char>(text[i]);
    if (code == '\n') ++line;
    if (i >= plain_until) {  // in comments and CDATA a reference means nothing
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
                fmt::format("{}:{}: a control character (\\x{:02x}), which XML cannot hold; take it out", xml.name(),
                            line, code));
  }
}

}  // namespace

File read_text(std::string name, std::string_view text) {
  const Xml xml(std::move(name), text);
  refuse_control_characters(xml);
  FileParts parts = parse(xml);
  File file{std::move(parts.head), std::move(parts.notices)};
  for (FileTier& from : parts.tiers) {
    Tier& tier = file.document.tiers.emplace_back(std::move(from.tier));
    tier.annotations.reserve(from.annotations.size());
    for (FileAnnotation& one : from.annotations) tier.annotations.push_back(std::move(one.annotation));
  }
  file.document.source = text;
  return file;
}

namespace {

/// True where the document is still what its source says.
bool is_unchanged(const FileParts& old, const AnnotationDocument& now) {
  const AnnotationDocument& head = old.head;
  if (head.author != now.author || head.date != now.date || head.format != now.format) return false;
  if (head.linked_files != now.linked_files || head.properties != now.properties) return false;
  if (head.types != now.types || old.tiers.size() != now.tiers.size()) return false;
  for (std::size_t t = 0; t < now.tiers.size(); ++t) {
    const Tier& was = old.tiers[t].tier;
    const Tier& tier = now.tiers[t];
    if (was.id != tier.id || was.type != tier.type || was.parent != tier.parent ||
        was.participant != tier.participant || was.annotator != tier.annotator || was.language != tier.language) {
      return false;
    }
    const std::vector<FileAnnotation>& annotations = old.tiers[t].annotations;
    if (!std::equal(annotations.begin(), annotations.end(), tier.annotations.begin(), tier.annotations.end(),
                    [](const FileAnnotation& a, const Annotation& b) { return a.annotation == b; })) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::string write_text(const AnnotationDocument& document) {
  if (document.source.empty()) return generate(check(document));
  const Xml xml("the document's source", document.source);
  const FileParts old = parse(xml);
  if (is_unchanged(old, document)) return document.source;
  return edit(xml, old, check(document, &old));
}

void write(const std::filesystem::path& path, const AnnotationDocument& document) {
  const std::string text = write_text(document);
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace signweave::eaf
