#pragma once

#include <string_view>

namespace hedgehop::sim {

/// Returns the version of Hedgehop, "MAJOR.MINOR.PATCH".
std::string_view version();

/// Returns a hash of the compiled sources except commands and pages, of the compiler and of its options, as 16
/// hexadecimal digits. Builds with equal identity fly equal flights with the same libraries.
std::string_view build_identity();

/// Returns the last commit that changed these sources, such as "44e015e" or "44e015e and changes"; empty if they are
/// not a git checkout.
std::string_view build_commit();

/// Returns the compiler, such as "GNU 12.2.0".
std::string_view build_compiler();

}  // namespace hedgehop::sim
