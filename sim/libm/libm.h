#pragma once

#include <string>

namespace hedgehop::sim {

/// "SLEEF 3.5.1": whose functions are those of sin, exp and the like in all that is linked against Hedgehop.
std::string libm_version();

}  // namespace hedgehop::sim
