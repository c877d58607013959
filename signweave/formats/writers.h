#pragma once

#include <filesystem>
#include <string>

#include "signweave/formats/write_file.h"

/// Inside this module: the functions of FileWriter for each format that is written, for the table in file_format.cpp.
namespace signweave::writers {

std::string bvh_text(const FileContent& content);
void write_bvh(const std::filesystem::path& path, const FileContent& content);
std::string glb_text(const FileContent& content);
std::string gltf_text(const FileContent& content);
void write_gltf(const std::filesystem::path& path, const FileContent& content);
std::string eaf_text(const FileContent& content);
std::string json_text(const FileContent& content);
std::string positions_text(const FileContent& content);
void write_positions(const std::filesystem::path& path, const FileContent& content);
std::string rotations_text(const FileContent& content);
void write_rotations(const std::filesystem::path& path, const FileContent& content);
std::string face_text(const FileContent& content);
std::string svg_text(const FileContent& content);

}  // namespace signweave::writers
