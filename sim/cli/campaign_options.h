#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace hedgehop::sim::cli {

/// Declares the commands that fly many scenarios. Parsing stores the call of the selected command in `chosen`.
void declare_campaigns(CLI::App& app, std::function<int()>& chosen);

}  // namespace hedgehop::sim::cli
