#pragma once

namespace hedgehop::sim::cli {

/// Runs the command line and prints errors to standard error. @return the exit status of the process.
int run_command_line(int argc, char** argv);

}  // namespace hedgehop::sim::cli
