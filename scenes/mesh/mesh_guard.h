#pragma once

#include <filesystem>

namespace hedgehop::scenes::mesh {

/// Refuses a mesh file that the importer would choke on: none, larger than 64 MB, JSON nested deeper than 200, a face
/// of more than 1,000 corners. Throws std::invalid_argument with the reason, without the file's name.
void require_importable(const std::filesystem::path& mesh);

/// Whether it is a regular file of at most 64 MB.
bool may_be_read(const std::filesystem::path& file);

}  // namespace hedgehop::scenes::mesh
