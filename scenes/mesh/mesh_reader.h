#pragma once

#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>

namespace hedgehop::scenes::mesh {

inline constexpr int kMaxNesting = 200;  ///< of JSON and XML, whose readers recurse

/// Throws std::invalid_argument with the reason, without the file's name, if the importer cannot process the file
/// safely: it is missing, not a regular file or larger than 256 MB; its suffix is not that of an OBJ, glTF, DAE, PLY or
/// STL file; an OBJ or a glTF is text in UTF-16; its JSON or XML is nested deeper than kMaxNesting; a DAE has indices
/// that are not whole numbers or arrays that are too short; or a PLY announces more elements than it has bytes.
/// @return the contents of the file; of an OBJ without a byte order mark.
std::string require_importable(const std::filesystem::path& mesh);

/// Returns the suffix of a file in lower case, such as ".obj".
std::string suffix_of(const std::filesystem::path& file);

/// Returns whether the path is a regular file of at most 256 MB.
bool may_be_read(const std::filesystem::path& file);

inline constexpr size_t kMaxTriangles = 2'000'000;
inline constexpr uint32_t kMaxFaceCorners = 1000;  ///< triangulation cost is quadratic

/// Returns the contents of a DAE, PLY, STL or old glTF file without post-processing. `importer` owns the result;
/// all its other formats are disabled. Throws std::invalid_argument with the reason, without the file's name, if the
/// importer rejects the file, a file named in it is not a regular file of at most 256 MB, a face has more than
/// kMaxFaceCorners, or it has more than kMaxTriangles.
/// @param text  its contents, from require_importable(); may differ from the file.
/// @param opened  receives all files that were opened, if it is not null.
const aiScene& read_mesh(const std::filesystem::path& mesh, const std::string& text, Assimp::Importer& importer,
                         std::set<std::filesystem::path>* opened = nullptr);

}  // namespace hedgehop::scenes::mesh
