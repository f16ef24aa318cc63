#pragma once

#include <span>

/// A function of the C library for many numbers at a time, with the bits of single calls on every processor.
namespace hedgehop {

/// Writes std::atan2(y[i], x[i]) to each out[i]. All spans must have equal sizes.
void atan2_of_each(std::span<const double> y, std::span<const double> x, std::span<double> out);

}  // namespace hedgehop
