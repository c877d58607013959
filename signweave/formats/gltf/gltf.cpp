#include "signweave/formats/gltf/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <streambuf>

#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/drawing/body_mesh.h"
#include "signweave/drawing/face_mesh.h"
#include "signweave/formats/gltf/document.h"
#include "signweave/formats/gltf/keys.h"

namespace signweave::gltf {
namespace {

using Eigen::Vector3f;

constexpr std::uint64_t kMostFileBytes = std::numeric_limits<std::uint32_t>::max();  // a GLB stores its size in 32 bits
constexpr const char* kTooLarge = "the motion is larger than the 4 GiB that a .glb file may have; write a part of it";
constexpr std::size_t kMostTextBytes = std::size_t{64} << 20;

/// A joint's or frame's number as an index.
template <std::integral Number>
std::size_t at(Number number) {
  return static_cast<std::size_t>(number);
}

/// Returns each name once: the second "Hand" is "Hand 2".
class Names {
 public:
  std::string unique(const std::string& wanted) {
    std::string name = utf8(wanted);
    for (int& number = last_[name]; !taken_.insert(name).second;) {
      number = std::max(number, 1) + 1;
      name = fmt::format("{} {}", utf8(wanted), number);
    }
    return name;
  }

 private:
  std::set<std::string> taken_;
  std::map<std::string, int> last_;
};

std::vector<double> doubles(const Vector3f& v) {
  return {v.x(), v.y(), v.z()};
}

RigMap rig_of(const Motion& motion, const WriteOptions& options) {
  RigMap rig = options.rig ? *options.rig : map_rig(motion);
  if (options.head) rig[Part::head] = {.joint = *options.head, .evidence = Evidence::file, .confidence = 1};
  return rig;
}

/// Writes one motion into a document, part by part.
class Writer {
 public:
  Writer(const Motion& motion, const WriteOptions& options, Document& document)
      : motion_(motion),
        skeleton_(motion.skeleton()),
        options_(options),
        plan_(plan_of(motion, rig_of(motion, options))),
        document_(document),
        model_(document.model()) {}

  void write() {
    model_.asset.version = "2.0";
    model_.asset.generator = "signweave";
    tinygltf::Value::Object declared;
    for (const auto& [name, value] : options_.declarations) {
      tinygltf::Value& entry = declared[utf8(name)];
      entry = tinygltf::Value((entry.IsString() ? entry.Get<std::string>() + "; " : std::string()) + utf8(value));
    }
    if (!declared.empty()) model_.asset.extras = tinygltf::Value(std::move(declared));
    animation_.name = utf8(options_.name);
    find_bind_pose();
    add_nodes();
    add_body();
    add_times();
    add_rotations();
    add_translations();
    add_tracks();
    if (animation_.channels.empty()) {  // nothing moves, but an animation must have a channel
      const Eigen::Vector4f key = motion_.rotations()[0].coeffs().normalized();
      add_channel(0, "rotation", document_.quaternions({&key, 1}), false);
    }
    model_.animations.push_back(std::move(animation_));
    model_.defaultScene = 0;
  }

 private:
  /// Every rotation is the identity, and the translations are those of the first frame.
  void find_bind_pose() {
    for (JointIndex joint = 0; at(joint) < skeleton_.joint_count(); ++joint) {
      const Joint& one = skeleton_.joint(joint);
      const auto moved = skeleton_.translation_of(joint);
      offsets_.push_back(moved ? motion_.pose(0).translations[*moved] : one.offset);
      places_.push_back(offsets_.back() +
                        (one.parent == kNoJoint ? Vector3f(Vector3f::Zero()) : places_[at(one.parent)]));
    }
  }

  /// Converts a direction from the plan's pose to a joint's space.
  Vector3f turned_back(JointIndex joint, const Vector3f& direction) const {
    return plan_.pose.rotations[at(joint)].conjugate() * direction;
  }
  Vector3f in_joint(JointIndex joint, const Vector3f& place) const {
    return turned_back(joint, place - plan_.place(joint));
  }

  int add_node(const std::string& name, const Vector3f& translation) {
    tinygltf::Node node;
    node.name = names_.unique(name);
    if (!translation.isZero(0)) node.translation = doubles(translation);
    model_.nodes.push_back(std::move(node));
    return static_cast<int>(model_.nodes.size()) - 1;
  }

  /// Node i is joint i, so no lookup is needed; tips and the node above the root follow.
  void add_nodes() {
    for (std::size_t joint = 0; joint < skeleton_.joint_count(); ++joint) {
      const Joint& one = skeleton_.joint(static_cast<JointIndex>(joint));
      const int node = add_node(one.name, offsets_[joint]);
      if (one.parent != kNoJoint) model_.nodes[at(one.parent)].children.push_back(node);
    }
    for (const Tip& tip : skeleton_.tips()) {
      const int node = add_node(skeleton_.joint(tip.joint).name + " tip", tip.offset);
      model_.nodes[at(tip.joint)].children.push_back(node);
    }
    const int top = add_node(options_.name, Vector3f::Zero());
    model_.nodes[at(top)].children.push_back(0);
    tinygltf::Scene scene;
    scene.nodes.push_back(top);
    model_.scenes.push_back(std::move(scene));
  }

  int add_material(const char* name, std::vector<double> colour, bool flat) {
    tinygltf::Material material;
    material.name = name;
    material.pbrMetallicRoughness.baseColorFactor = std::move(colour);
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 0.8;
    material.doubleSided = flat;
    model_.materials.push_back(std::move(material));
    return static_cast<int>(model_.materials.size()) - 1;
  }

  /// Adds the one mesh that moves with all joints.
  void add_body() {
    BodyMesh mesh = body_mesh(skeleton_, plan_);
    if (mesh.positions.empty()) return;  // a root alone
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const JointIndex joint = mesh.joints[i];
      mesh.positions[i] = places_[at(joint)] + in_joint(joint, mesh.positions[i]);
      mesh.normals[i] = turned_back(joint, mesh.normals[i]).normalized();
      if (!mesh.positions[i].allFinite()) throw Error(ErrorCode::bad_input, "the skeleton is too large to be drawn");
    }
    tinygltf::Primitive primitive;
    primitive.attributes["POSITION"] = document_.vectors(mesh.positions, {.vertices = true, .with_bounds = true});
    primitive.attributes["NORMAL"] = document_.vectors(mesh.normals, {.vertices = true});
    primitive.attributes["JOINTS_0"] = document_.joints(mesh.joints);
    primitive.attributes["WEIGHTS_0"] = document_.full_weights(mesh.positions.size());
    primitive.indices = document_.indices(mesh.indices);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = add_material("body", {0.62, 0.55, 0.5, 1}, false);
    const int node = add_mesh("body", std::move(primitive), {});
    model_.scenes[0].nodes.push_back(node);  // a skinned mesh does not move with the nodes above it

    tinygltf::Skin skin;
    skin.name = "skeleton";
    std::vector<Eigen::Matrix4f> from_model;
    const auto add_joint = [&](std::size_t joint_node, const Vector3f& position) {
      skin.joints.push_back(static_cast<int>(joint_node));
      Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
      matrix.topRightCorner<3, 1>() = -position;
      from_model.push_back(matrix);
    };
    for (std::size_t joint = 0; joint < skeleton_.joint_count(); ++joint) add_joint(joint, places_[joint]);
    // Tips are bones too: otherwise Blender creates an empty object for each, and does not know the length of the last
    // bones.
    for (std::size_t i = 0; i < skeleton_.tips().size(); ++i) {
      const Tip& tip = skeleton_.tips()[i];
      add_joint(skeleton_.joint_count() + i, places_[at(tip.joint)] + tip.offset);
    }
    skin.inverseBindMatrices = document_.matrices(from_model);
    model_.skins.push_back(std::move(skin));
    model_.nodes[at(node)].skin = 0;
  }

  /// Adds a node with a mesh of one primitive.
  int add_mesh(const std::string& name, tinygltf::Primitive primitive, tinygltf::Value extras) {
    const int node = add_node(name, Vector3f::Zero());
    tinygltf::Mesh mesh;
    mesh.name = model_.nodes[at(node)].name;
    mesh.primitives.push_back(std::move(primitive));
    mesh.extras = std::move(extras);
    model_.meshes.push_back(std::move(mesh));
    model_.nodes[at(node)].mesh = static_cast<int>(model_.meshes.size()) - 1;
    return node;
  }

  void add_times() {
    const std::vector<float> times = key_times(motion_.rate(), motion_.frame_count());
    times_ = document_.scalars(times, true);
    if (times.size() == 1) start_ = times_;
  }

  void add_channel(int node, const char* path, int keys, bool moves) {
    if (!moves && start_ < 0) {
      const float start[] = {0};
      start_ = document_.scalars(start, true);
    }
    tinygltf::AnimationSampler sampler;
    sampler.input = moves ? times_ : start_;
    sampler.output = keys;
    sampler.interpolation = "LINEAR";
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation_.samplers.size());
    channel.target_node = node;
    channel.target_path = path;
    animation_.samplers.push_back(std::move(sampler));
    animation_.channels.push_back(std::move(channel));
  }

  void add_rotations() {
    std::vector<Eigen::Vector4f> keys;
    for (std::size_t joint = 0; joint < skeleton_.joint_count(); ++joint) {
      const bool moves = rotation_keys(motion_, joint, keys);
      if (!moves && (keys[0] == Eigen::Vector4f(0, 0, 0, 1) || keys[0] == Eigen::Vector4f(0, 0, 0, -1))) continue;
      const std::span<const Eigen::Vector4f> all(keys);
      add_channel(static_cast<int>(joint), "rotation", document_.quaternions(moves ? all : all.first(1)), moves);
    }
  }

  /// A joint that stays where it is in frame 0 needs no keys, because its node is there.
  void add_translations() {
    std::vector<Vector3f> keys;
    for (std::size_t i = 0; i < skeleton_.translation_count(); ++i) {
      if (!translation_keys(motion_, i, keys)) continue;
      add_channel(skeleton_.translated_joints()[i], "translation", document_.vectors(keys, {}), true);
    }
  }

  /// Adds the face's weights if there is a head to draw it on; all other tracks as plain numbers.
  void add_tracks() {
    std::vector<const ScalarTrack*> shown;
    std::vector<const ScalarTrack*> others;
    for (const ScalarTrack& track : motion_.tracks()) {
      const auto known = face_target_names();
      const bool again =
          std::any_of(shown.begin(), shown.end(), [&](const auto* one) { return one->name == track.name; });
      const bool drawn = plan_.head && !again && std::find(known.begin(), known.end(), track.name) != known.end();
      (drawn ? shown : others).push_back(&track);
    }
    if (!shown.empty()) add_face(shown);
    if (others.empty()) return;
    tinygltf::Value::Array list;
    for (const ScalarTrack* track : others) {
      tinygltf::Value::Array values;
      values.reserve(track->values.size());
      for (const float value : track->values) values.emplace_back(static_cast<double>(value));
      tinygltf::Value::Object entry;
      entry["name"] = tinygltf::Value(utf8(track->name));
      entry["rate"] = tinygltf::Value(motion_.rate().hertz());
      entry["values"] = tinygltf::Value(std::move(values));
      list.emplace_back(std::move(entry));
    }
    tinygltf::Value::Object extras;
    extras["tracks"] = tinygltf::Value(std::move(list));
    animation_.extras = tinygltf::Value(std::move(extras));
  }

  void add_face(const std::vector<const ScalarTrack*>& tracks) {
    std::vector<std::string> names;
    tinygltf::Value::Array listed;
    for (const ScalarTrack* track : tracks) {
      names.push_back(track->name);
      listed.emplace_back(track->name);
    }
    FaceMesh face = face_mesh(*plan_.head, names);
    const JointIndex head = plan_.head->joint;
    for (Vector3f& position : face.positions) position = in_joint(head, position);
    for (Vector3f& normal : face.normals) normal = turned_back(head, normal).normalized();
    for (FaceTarget& target : face.targets) {
      for (Vector3f& delta : target.deltas) delta = turned_back(head, delta);
    }
    tinygltf::Primitive primitive;
    primitive.attributes["POSITION"] = document_.vectors(face.positions, {.vertices = true, .with_bounds = true});
    primitive.attributes["NORMAL"] = document_.vectors(face.normals, {.vertices = true});
    primitive.indices = document_.indices(face.indices);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = add_material("face", {0.05, 0.04, 0.05, 1}, true);
    for (const FaceTarget& target : face.targets) {
      primitive.targets.push_back(
          {{"POSITION", document_.vectors(target.deltas, {.vertices = true, .with_bounds = true})}});
    }
    tinygltf::Value::Object extras;
    extras["targetNames"] = tinygltf::Value(std::move(listed));
    const int node = add_mesh("face", std::move(primitive), tinygltf::Value(std::move(extras)));
    model_.meshes.back().weights.assign(tracks.size(), 0.0);
    model_.nodes[at(head)].children.push_back(node);

    std::vector<float> weights;
    weights.reserve(at(motion_.frame_count()) * tracks.size());
    for (std::size_t frame = 0; frame < at(motion_.frame_count()); ++frame) {
      for (const ScalarTrack* track : tracks) weights.push_back(track->values[frame]);
    }
    add_channel(node, "weights", document_.scalars(weights), true);
  }

  const Motion& motion_;
  const Skeleton& skeleton_;
  const WriteOptions& options_;
  const BodyPlan plan_;
  std::vector<Vector3f> offsets_;  ///< [joint] from its parent, in the bind pose
  std::vector<Vector3f> places_;   ///< [joint] model space of the bind pose
  Document& document_;
  tinygltf::Model& model_;
  tinygltf::Animation animation_;
  Names names_;
  int times_ = 0;   ///< accessor of every frame's time
  int start_ = -1;  ///< accessor of the time 0 alone, once it is needed
};

void write_to(std::ostream& out, const Motion& motion, const WriteOptions& options, Container container) {
  if (motion.frame_count() < 1 || motion.skeleton().joint_count() < 1) {
    throw Error(ErrorCode::bad_input, "a motion without frames or joints has nothing to show in glTF");
  }
  require_finite(motion);
  const bool binary = container == Container::binary;
  Document document(
      binary ? kMostFileBytes : kMostTextBytes,
      binary ? kTooLarge : "the motion has more than the 64 MiB of numbers that go into a .gltf file; write .glb");
  Writer(motion, options, document).write();
  tinygltf::TinyGLTF().WriteGltfSceneToStream(&document.model(), out, false, binary);
}

/// Checks the size of the whole file once it is known: tracks that are written as text were not counted before.
void require_size(std::uint64_t bytes) {
  if (bytes > kMostFileBytes) throw Error(ErrorCode::unsupported, kTooLarge);
}

}  // namespace

std::string to_bytes(const Motion& motion, const WriteOptions& options, Container container) {
  std::ostringstream out;
  write_to(out, motion, options, container);
  std::string bytes = std::move(out).str();
  if (container == Container::binary) require_size(bytes.size());
  return bytes;
}

void write(const std::filesystem::path& path, const Motion& motion, const WriteOptions& options) {
  const bool text = fold_case(path.extension().string()) == ".gltf";
  AtomicFile file(path);
  AtomicFileBuffer buffer(file);
  std::ostream out(&buffer);
  out.exceptions(std::ios::badbit);  // a full disk becomes AtomicFile's Error, not an unread flag
  try {
    write_to(out, motion, options, text ? Container::text : Container::binary);
    if (!text) require_size(buffer.bytes());
  } catch (const Error& error) {
    if (error.code() == ErrorCode::io) throw;
    throw Error(error.code(), fmt::format("{}: {}", path.string(), error.what()), error.remedies());
  }
  file.commit();
}

}  // namespace signweave::gltf
