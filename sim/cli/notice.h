#pragma once

#include <cstdio>
#include <string>

namespace hedgehop::sim::cli {

/// Prints to standard error. Unlike fmt::print, it does not throw if standard error is full or closed.
inline void notice(const std::string& text) { std::fputs(text.c_str(), stderr); }

}  // namespace hedgehop::sim::cli
