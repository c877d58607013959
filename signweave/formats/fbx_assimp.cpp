#include <assimp/config.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <charconv>
#include <cmath>
#include <cstring>

#include "signweave/core/bytes.h"
#include "signweave/formats/fbx_keys.h"

namespace signweave::fbx {
namespace {

/// Assimp may open nothing but the bytes that it is given.
class NoFiles : public Assimp::IOSystem {
 public:
  bool Exists(const char*) const override { return false; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char*, const char*) override { return nullptr; }
  void Close(Assimp::IOStream*) override {}
};

/// Writes records of a binary FBX file of version 7.4.
class RecordWriter {
 public:
  RecordWriter() {
    text_.append("Kaydara FBX Binary  \0\x1a\0", 23);
    number<std::uint32_t>(7400);
  }

  template <typename Values, typename Children>
  void record(std::string_view name, const Values& values, const Children& children) {
    const std::size_t head = open(name, values);
    children();
    text_.append(13, '\0');
    put(head, text_.size());
  }
  template <typename Values>
  void leaf(std::string_view name, const Values& values) {
    const std::size_t head = open(name, values);
    put(head, text_.size());
  }

  void whole(std::int64_t value) {
    type('L');
    number(value);
  }
  void small(std::int32_t value) {
    type('I');
    number(value);
  }
  void text(std::string_view value) {
    type('S');
    number(static_cast<std::uint32_t>(value.size()));
    text_.append(value);
  }
  template <typename T>
  void array(char of, const std::vector<T>& values) {
    type(of);
    number(static_cast<std::uint32_t>(values.size()));
    number<std::uint32_t>(0);
    number(static_cast<std::uint32_t>(values.size() * sizeof(T)));
    text_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  std::string finish() {
    text_.append(13, '\0');
    return std::move(text_);
  }

 private:
  /// Writes a record up to its values; where its end belongs, which is known later, is the answer.
  template <typename Values>
  std::size_t open(std::string_view name, const Values& values) {
    const std::size_t head = text_.size();
    text_.append(12, '\0');
    text_.push_back(static_cast<char>(name.size()));
    text_.append(name);
    count_ = 0;
    const std::size_t begin = text_.size();
    values();
    put(head + 4, count_);
    put(head + 8, text_.size() - begin);
    return head;
  }

  void type(char of) {
    text_.push_back(of);
    ++count_;
  }
  template <typename T>
  void number(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    text_.append(bytes, sizeof(T));
  }
  void put(std::size_t at, std::size_t value) {
    const auto small_value = static_cast<std::uint32_t>(value);
    std::memcpy(text_.data() + at, &small_value, sizeof small_value);
  }

  std::string text_;
  std::uint32_t count_ = 0;
};

std::string binary_name(std::string_view name, std::string_view kind) {
  return std::string(name) + std::string("\0\1", 2) + std::string(kind);
}

// Numbers of objects: 1 the stack, 2 the layer, then three of each curve.
std::int64_t number_of(std::size_t curve) {
  return static_cast<std::int64_t>(10 + 3 * curve);
}

void write_curve(RecordWriter& out, std::size_t index, const Curve& curve) {
  const std::int64_t first = number_of(index);
  const auto nothing = [] {};
  const auto object = [&](std::int64_t number, std::string_view kind, std::string_view type) {
    out.whole(number);
    out.text(binary_name(fmt::format("c{}", index), kind));
    out.text(type);
  };
  out.record(
      "Model", [&] { object(first, "Model", "Null"); }, [&] { out.record("Properties70", nothing, nothing); });
  out.record(
      "AnimationCurveNode", [&] { object(first + 1, "AnimCurveNode", ""); },
      [&] { out.record("Properties70", nothing, nothing); });
  out.record(
      "AnimationCurve", [&] { object(first + 2, "AnimCurve", ""); },
      [&] {
        out.leaf("KeyTime", [&] { out.array('l', curve.ticks); });
        out.leaf("KeyValueFloat", [&] { out.array('f', curve.values); });
      });
}

void write_link(RecordWriter& out, std::int64_t from, std::int64_t to, std::string_view property_name = {}) {
  out.leaf("C", [&] {
    out.text(property_name.empty() ? "OO" : "OP");
    out.whole(from);
    out.whole(to);
    if (!property_name.empty()) out.text(property_name);
  });
}

/// The keys of a channel, its times from `zero`.
Curve curve_of(const aiNodeAnim& channel, double zero) {
  Curve curve;
  curve.ticks.reserve(channel.mNumPositionKeys);
  curve.values.reserve(channel.mNumPositionKeys);
  for (unsigned int i = 0; i < channel.mNumPositionKeys; ++i) {
    const aiVectorKey& key = channel.mPositionKeys[i];
    curve.ticks.push_back(std::llround((key.mTime - zero) * static_cast<double>(kTicks)));
    curve.values.push_back(key.mValue.x);
  }
  return curve;
}

}  // namespace

std::string document_of_curves(const std::vector<Curve>& curves) {
  RecordWriter out;
  const auto nothing = [] {};
  out.record("FBXHeaderExtension", nothing, [&] { out.leaf("FBXVersion", [&] { out.small(7400); }); });
  out.record("GlobalSettings", nothing, [&] { out.record("Properties70", nothing, nothing); });
  const Curve zero{.ticks = {0}, .values = {0.0f}, .parts = {}};
  out.record("Objects", nothing, [&] {
    out.record(
        "AnimationStack",
        [&] {
          out.whole(1);
          out.text(binary_name("take", "AnimStack"));
          out.text("");
        },
        nothing);
    out.record(
        "AnimationLayer",
        [&] {
          out.whole(2);
          out.text(binary_name("layer", "AnimLayer"));
          out.text("");
        },
        nothing);
    write_curve(out, 0, zero);
    for (std::size_t i = 0; i < curves.size(); ++i) write_curve(out, i + 1, curves[i]);
  });
  out.record("Connections", nothing, [&] {
    write_link(out, 2, 1);
    for (std::size_t i = 0; i <= curves.size(); ++i) {
      const std::int64_t first = number_of(i);
      write_link(out, first, 0);
      write_link(out, first + 1, 2);
      write_link(out, first + 1, first, "Lcl Translation");
      write_link(out, first + 2, first + 1, "d|X");
    }
  });
  return out.finish();
}

std::vector<Curve> read_by_assimp(const std::string& document, std::size_t count) {
  Assimp::Importer importer;
  importer.SetIOHandler(new NoFiles);  // the importer's own from here on
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_STRICT_MODE, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_OPTIMIZE_EMPTY_ANIMATION_CURVES, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  for (const char* unread : {AI_CONFIG_IMPORT_FBX_READ_MATERIALS, AI_CONFIG_IMPORT_FBX_READ_TEXTURES,
                             AI_CONFIG_IMPORT_FBX_READ_CAMERAS, AI_CONFIG_IMPORT_FBX_READ_LIGHTS}) {
    importer.SetPropertyBool(unread, false);
  }
  const aiScene* scene = importer.ReadFileFromMemory(document.data(), document.size(), 0, "fbx");
  if (scene == nullptr || scene->mNumAnimations != 1 || scene->mAnimations[0]->mNumChannels != count + 1) {
    throw Error(ErrorCode::bad_input, fmt::format("Assimp cannot read {} curves: {}", count,
                                                  scene == nullptr ? importer.GetErrorString() : "some are missing"));
  }
  const aiAnimation& take = *scene->mAnimations[0];
  std::vector<const aiNodeAnim*> channels(count + 1, nullptr);
  for (unsigned int i = 0; i < take.mNumChannels; ++i) {
    const std::string_view name(take.mChannels[i]->mNodeName.C_Str(), take.mChannels[i]->mNodeName.length);
    std::size_t index = channels.size();
    std::from_chars(name.data() + 1, name.data() + name.size(), index);
    if (index < channels.size()) channels[index] = take.mChannels[i];
  }
  std::vector<Curve> curves(count);
  for (std::size_t i = 0; i <= count; ++i) {
    if (channels[i] == nullptr || channels[i]->mNumPositionKeys == 0) {
      throw Error(ErrorCode::bad_input, fmt::format("Assimp cannot read curve {} of {}", i, count));
    }
    if (i > 0) curves[i - 1] = curve_of(*channels[i], channels[0]->mPositionKeys[0].mTime);
  }
  return curves;
}

}  // namespace signweave::fbx
