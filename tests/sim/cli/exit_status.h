#pragma once

namespace hedgehop::sim {

/// Exit statuses that commands document, apart from the constants of the program.
inline constexpr int kFails = 1, kBadInput = 2, kInternalError = 3;

}  // namespace hedgehop::sim
