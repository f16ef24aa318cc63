#pragma once

#include <cstdio>
#include <string>

namespace hedgehop::sim::cli {

/// Prints to standard error. Where that is full or closed nothing ends for it, as it would by fmt::print.
inline void notice(const std::string& text) { std::fputs(text.c_str(), stderr); }

}  // namespace hedgehop::sim::cli
