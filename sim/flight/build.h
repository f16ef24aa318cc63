#pragma once

#include <string_view>

namespace hedgehop::sim {

/// Hedgehop's version, "MAJOR.MINOR.PATCH".
std::string_view version();

/// 16 hexadecimal digits: a hash of all sources that are compiled in, the compiler and its options. Two builds of equal
/// identity fly equal flights on the same libraries.
std::string_view build_identity();

/// The commit that changed these sources last, such as "44e015e", or "44e015e and changes"; empty where they are no git
/// checkout.
std::string_view build_commit();

/// What compiled them: "GNU 12.2.0".
std::string_view build_compiler();

}  // namespace hedgehop::sim
