#pragma once

#include <string>

namespace hedgehop::sim {

/// Returns the library that provides sin, exp and similar functions in programs linked with Hedgehop: "SLEEF 3.5.1".
std::string libm_version();

}  // namespace hedgehop::sim
