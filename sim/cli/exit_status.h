#pragma once

#include <cstdio>
#include <string>

/// Exit statuses, notices and warnings of commands.
namespace hedgehop::sim::cli {

/// Exit statuses; 0 means success.
inline constexpr int kFails = 1;          ///< a check fails
inline constexpr int kBadInput = 2;       ///< invalid input; one line is printed per error
inline constexpr int kInternalError = 3;  ///< error of Hedgehop or of the machine
inline constexpr int kUndecided = 4;      ///< a claim is undecided after the last seed
inline constexpr int kSignalled = 128;    ///< plus the number of the signal that ended the command, like in shells

/// Prints to standard error. Unlike fmt::print, it does not throw if standard error is full or closed.
inline void notice(const std::string& text) { std::fputs(text.c_str(), stderr); }

/// Prints a warning, one line, to standard error. @param text  without the prefix and the line break.
inline void warn(const std::string& text) { notice("warning: " + text + "\n"); }

}  // namespace hedgehop::sim::cli
