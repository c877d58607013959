#include "signweave/formats/eaf/eaf.h"

#include <algorithm>

#include "signweave/core/atomic_file.h"
#include "signweave/formats/eaf/edit.h"
#include "signweave/formats/eaf/elements.h"
#include "signweave/formats/eaf/generate.h"
#include "signweave/formats/eaf/parse.h"

namespace signweave::eaf {

File read(const std::filesystem::path& path, Unsound unsound) {
  return read_text(path.string(), read_file(path), unsound);
}

File read_text(std::string name, std::string_view text, Unsound unsound) {
  const Xml xml(std::move(name), text);
  refuse_control_characters(xml);
  FileParts parts = parse(xml, unsound);
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

/// True if the document is still what its source says.
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
  if (document.source.empty() || document.source_format != SourceFormat::eaf) return generate(check(document));
  const Xml xml("the document's source", document.source);
  const FileParts old = parse(xml, Unsound::left_out);
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
