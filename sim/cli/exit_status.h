#pragma once

/// Exit statuses of the command line; 0 means success.
namespace hedgehop::sim::cli {

inline constexpr int kFails = 1;          ///< a check fails
inline constexpr int kBadInput = 2;       ///< invalid input; one line is printed per error
inline constexpr int kInternalError = 3;  ///< error of Hedgehop or of the machine
inline constexpr int kUndecided = 4;      ///< a claim is undecided after the last seed
inline constexpr int kSignalled = 128;    ///< plus the number of the signal that ended the command, like in shells

}  // namespace hedgehop::sim::cli
