#include "signweave/formats/motion_readers.h"

#include "signweave/formats/asf/asf.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/formats/fbx/fbx.h"
#include "signweave/formats/gltf/read.h"

namespace signweave::readers {

namespace fs = std::filesystem;
using motion_file::File;
using motion_file::ReadOptions;

File read_bvh(const fs::path& path, const ReadOptions& options) {
  bvh::File file = bvh::read(path, {.up = options.up,
                                    .unit = options.unit,
                                    .root_unit = options.root_unit,
                                    .root_columns = options.root_columns,
                                    .mirror = options.mirror,
                                    .progress = options.progress});
  return {.motion = std::move(file.motion),
          .layout = std::move(file.layout),
          .notices = std::move(file.notices),
          .format = {}};
}

File read_asf(const fs::path& path, const ReadOptions& options) {
  asf::File file =
      asf::read(path, {.skeleton = options.skeleton.empty() ? std::nullopt : std::optional(options.skeleton),
                       .unit = options.unit,
                       .up = options.up,
                       .rate = options.rate,
                       .progress = options.progress});
  return {.motion = std::move(file.motion), .layout = {}, .notices = std::move(file.notices), .format = {}};
}

std::vector<fs::path> with_skeleton(const fs::path& path, const ReadOptions& options) {
  return {path, options.skeleton.empty() ? asf::skeleton_of(path) : options.skeleton};
}

File read_fbx(const fs::path& path, const ReadOptions& options) {
  fbx::File file =
      fbx::read(path, {.take = options.take, .rate = options.rate, .unit = options.unit, .progress = options.progress});
  return {.motion = std::move(file.motion), .layout = {}, .notices = std::move(file.notices), .format = {}};
}

File read_gltf(const fs::path& path, const ReadOptions& options) {
  gltf::ReadFile file = gltf::read(
      path, {.take = options.take, .rate = options.rate, .unit = options.unit, .progress = options.progress});
  return {.motion = std::move(file.motion),
          .layout = {},
          .notices = std::move(file.notices),
          .format = {},
          .declarations = std::move(file.declarations)};
}

std::vector<fs::path> with_buffers(const fs::path& path, const ReadOptions&) {
  std::vector<fs::path> files = gltf::files_of(path);
  std::error_code ignored;  // a missing file is reported when it is read
  std::erase_if(files, [&](const fs::path& file) { return file != path && !fs::is_regular_file(file, ignored); });
  return files;
}

std::vector<fs::path> only_itself(const fs::path& path, const ReadOptions&) {
  return {path};
}

}  // namespace signweave::readers
