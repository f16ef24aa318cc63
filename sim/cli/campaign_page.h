#pragma once

#include <filesystem>

namespace hedgehop::sim::cli {

/// Writes report.html of a batch or sweep that has just been flown, and prints its name. A page that cannot be made is
/// told on standard error: the tables stand without it.
void write_campaign_page(const std::filesystem::path& folder);

}  // namespace hedgehop::sim::cli
