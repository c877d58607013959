#pragma once

#include <filesystem>
#include <vector>

#include "signweave/formats/motion_file.h"

/// Inside this module: the functions of MotionReader for each format that is read, for the table in file_format.cpp.
namespace signweave::readers {

motion_file::File read_bvh(const std::filesystem::path& path, const motion_file::ReadOptions& options);
motion_file::File read_asf(const std::filesystem::path& path, const motion_file::ReadOptions& options);
motion_file::File read_fbx(const std::filesystem::path& path, const motion_file::ReadOptions& options);
motion_file::File read_gltf(const std::filesystem::path& path, const motion_file::ReadOptions& options);

std::vector<std::filesystem::path> only_itself(const std::filesystem::path& path,
                                               const motion_file::ReadOptions& options);
/// An .amc and its skeleton.
std::vector<std::filesystem::path> with_skeleton(const std::filesystem::path& path,
                                                 const motion_file::ReadOptions& options);
/// A glTF file and the buffers next to it.
std::vector<std::filesystem::path> with_buffers(const std::filesystem::path& path,
                                                const motion_file::ReadOptions& options);

}  // namespace signweave::readers
