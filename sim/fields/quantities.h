#pragma once

#include <cstdint>
#include <limits>
#include <numbers>

namespace hedgehop {

inline constexpr double kDegPerRad = 180.0 / std::numbers::pi, kRadPerDeg = std::numbers::pi / 180.0;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline double square(double x) { return x * x; }

/// Returns a time or duration in s. @param t_ns  in ns.
inline double seconds(int64_t t_ns) { return 1e-9 * static_cast<double>(t_ns); }

}  // namespace hedgehop
