#pragma once

#include <filesystem>

namespace hedgehop::scenes::mesh {

/// Refuses a mesh file that the importer would choke on: none, no regular one, larger than 64 MB, of another name than
/// .obj, .gltf and .glb, JSON nested deeper than 200, a glTF of more than 2,000 nodes, an OBJ of more than 500,000
/// faces. Throws std::invalid_argument with the reason, without the file's name.
void require_importable(const std::filesystem::path& mesh);

/// Whether it is a regular file of at most 64 MB.
bool may_be_read(const std::filesystem::path& file);

}  // namespace hedgehop::scenes::mesh
