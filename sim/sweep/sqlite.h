#pragma once

#include <filesystem>

#include "sim/batch/table.h"

namespace hedgehop::sim {

/// Writes the table as table `flights` of an SQLite 3 file, aside and then renamed, so that a file that is there is
/// whole. Throws std::runtime_error naming the file and the cause.
void write_sqlite(const std::filesystem::path& file, const Table& table);

}  // namespace hedgehop::sim
