#pragma once

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <filesystem>
#include <set>

namespace hedgehop::scenes::mesh {

inline constexpr size_t kMaxTriangles = 500'000;

/// Reads an OBJ or a glTF as it stands in its file, and nothing else that `importer`, which owns what comes back,
/// could. Throws std::invalid_argument with the reason, without the file's name, for what require_importable() refuses,
/// what the importer cannot read, files named in it that are no regular ones of at most 64 MB, a face of more than
/// 1,000 corners (triangulation takes their square), and more than kMaxTriangles.
/// @param opened  gets every file that was opened, where it is not null.
const aiScene& read_mesh(const std::filesystem::path& mesh, Assimp::Importer& importer,
                         std::set<std::filesystem::path>* opened = nullptr);

}  // namespace hedgehop::scenes::mesh
