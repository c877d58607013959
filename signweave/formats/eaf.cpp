#include "signweave/formats/eaf.h"

#include "signweave/core/atomic_file.h"
#include "signweave/formats/eaf_parse.h"

namespace signweave::eaf {

File read(const std::filesystem::path& path) {
  return read_text(path.string(), read_file(path));
}

File read_text(std::string name, std::string_view text) {
  const Xml xml(std::move(name), text);
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

}  // namespace signweave::eaf
