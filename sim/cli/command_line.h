#pragma once

namespace hedgehop::sim::cli {

/// Runs the command line; says on standard error what went wrong, if anything. @return the process's exit status.
int run_command_line(int argc, char** argv);

}  // namespace hedgehop::sim::cli
