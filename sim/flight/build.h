#pragma once

#include <string_view>

namespace hedgehop::sim {

/// Hedgehop's version, "MAJOR.MINOR.PATCH".
std::string_view version();

/// 16 hexadecimal digits: a hash of all sources that are compiled in, the compiler and its options. Two builds of equal
/// identity fly equal flights on the same libraries.
std::string_view build_identity();

}  // namespace hedgehop::sim
