#pragma once

#include <filesystem>
#include <set>

namespace hedgehop::scenes::mesh {

/// Every file that a mesh is imported from: the file itself, its materials and buffers, its images. Images that lie in
/// another one are part of that. @throws std::invalid_argument when the mesh cannot be read.
std::set<std::filesystem::path> mesh_files(const std::filesystem::path& mesh);

}  // namespace hedgehop::scenes::mesh
