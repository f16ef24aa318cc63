#pragma once

#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#include <filesystem>
#include <set>

namespace hedgehop::scenes::mesh {

/// Throws std::invalid_argument with the reason, without the file's name, if the importer cannot process the file
/// safely: it is missing, not a regular file or larger than 64 MB; its suffix is not .obj, .gltf or .glb; its JSON is
/// nested deeper than 200; a glTF has more than 2,000 nodes, or an OBJ more than 500,000 faces.
void require_importable(const std::filesystem::path& mesh);

/// Returns whether the path is a regular file of at most 64 MB.
bool may_be_read(const std::filesystem::path& file);

inline constexpr size_t kMaxTriangles = 500'000;

/// Returns the contents of an OBJ or glTF file without post-processing. `importer` owns the result; all its other
/// formats are disabled. Throws std::invalid_argument with the reason, without the file's name, if require_importable()
/// or the importer rejects the file, a file named in it is not a regular file of at most 64 MB, a face has more than
/// 1,000 corners (triangulation cost is quadratic), or it has more than kMaxTriangles.
/// @param opened  receives all files that were opened, if it is not null.
const aiScene& read_mesh(const std::filesystem::path& mesh, Assimp::Importer& importer,
                         std::set<std::filesystem::path>* opened = nullptr);

}  // namespace hedgehop::scenes::mesh
