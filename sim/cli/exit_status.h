#pragma once

/// Exit statuses of the command line; 0 when all is well.
namespace hedgehop::sim::cli {

inline constexpr int kFails = 1;          ///< a check fails
inline constexpr int kBadInput = 2;       ///< told in one line a fault
inline constexpr int kInternalError = 3;  ///< of Hedgehop or of the machine
inline constexpr int kUndecided = 4;      ///< the last seed left a claim open
inline constexpr int kSignalled = 128;    ///< plus the number of the signal that ended the command, as shells report it

}  // namespace hedgehop::sim::cli
