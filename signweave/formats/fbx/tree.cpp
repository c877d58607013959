#include "signweave/formats/fbx/tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace signweave::fbx {
namespace {

constexpr std::string_view kBinaryMagic("Kaydara FBX Binary  \0", 21);

bool looks_like_text(std::string_view bytes) noexcept {
  const std::string_view head = bytes.substr(0, std::min<std::size_t>(bytes.size(), 4096));
  return head.find('\0') == std::string_view::npos &&
         (head.find("FBX") != std::string_view::npos || head.find("GlobalSettings") != std::string_view::npos);
}

/// The version, such as 7400; 0 if the file does not contain it.
std::int64_t version_of(const Source& source, const Record& root) {
  if (source.binary) return root.whole(0, 0);
  const Record* header = root.child("FBXHeaderExtension");
  const Record* version = header == nullptr ? nullptr : header->child("FBXVersion");
  return version == nullptr ? 0 : version->whole(0, 0);
}

}  // namespace

void Source::fail(std::size_t place, std::string_view what) const {
  if (binary) throw Error(ErrorCode::bad_input, fmt::format("{}: byte {}: {}", name, place, what));
  const std::string_view before = bytes.substr(0, std::min(place, bytes.size()));
  throw Error(ErrorCode::bad_input,
              fmt::format("{}:{}: {}", name, 1 + std::count(before.begin(), before.end(), '\n'), what));
}

const Record* Record::child(std::string_view child_name) const noexcept {
  for (const Record& one : children) {
    if (one.name == child_name) return &one;
  }
  return nullptr;
}

std::string_view Record::text(std::size_t index) const noexcept {
  if (index >= values.size() || values[index].kind != Value::Kind::text) return {};
  return values[index].bytes;
}

double Record::number(std::size_t index, double otherwise) const noexcept {
  if (index >= values.size()) return otherwise;
  if (values[index].kind == Value::Kind::whole) return static_cast<double>(values[index].whole);
  return values[index].kind == Value::Kind::real ? values[index].real : otherwise;
}

std::int64_t Record::whole(std::size_t index, std::int64_t otherwise) const noexcept {
  if (index >= values.size()) return otherwise;
  const Value& value = values[index];
  if (value.kind == Value::Kind::whole) return value.whole;
  const bool fits = value.kind == Value::Kind::real && value.real > -9e15 && value.real < 9e15;
  return fits ? static_cast<std::int64_t>(value.real) : otherwise;
}

bool matters(int depth, std::string_view name, std::string_view around) noexcept {
  constexpr std::array kSections{"FBXHeaderExtension", "GlobalSettings", "Definitions", "Objects", "Connections"};
  constexpr std::array kObjects{"Model",          "Deformer",           "AnimationStack",
                                "AnimationLayer", "AnimationCurveNode", "AnimationCurve"};
  if (depth == 0) return std::find(kSections.begin(), kSections.end(), name) != kSections.end();
  if (depth == 1 && around == "Objects") return std::find(kObjects.begin(), kObjects.end(), name) != kObjects.end();
  return true;
}

Record read_tree(Source& source) {
  source.binary = source.bytes.substr(0, kBinaryMagic.size()) == kBinaryMagic;
  if (source.bytes.empty()) {
    throw Error(ErrorCode::bad_input, fmt::format("{}: the file is empty; export it again", source.name));
  }
  if (!source.binary && !looks_like_text(source.bytes)) {
    throw Error(
        ErrorCode::bad_input,
        fmt::format("{}: this is not an FBX file: neither 'Kaydara FBX Binary' nor the text of one", source.name));
  }
  Record root = source.binary ? read_binary_tree(source) : read_text_tree(source);
  const std::int64_t version = version_of(source, root);
  if (version < 7100 || version >= 8000) {
    throw Error(version == 0 ? ErrorCode::bad_input : ErrorCode::unsupported,
                version == 0
                    ? fmt::format("{}: it does not contain its version (FBXVersion); export it again", source.name)
                    : fmt::format("{}: FBX version {} is not read, but 7100 to 7999; export it as FBX 2014 or later",
                                  source.name, version));
  }
  return root;
}

}  // namespace signweave::fbx
