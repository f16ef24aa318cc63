#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

// Loops of the plane sweep over the pixels of a row or an image. Integers only: results are equal on every processor.
namespace hedgehop::vision::motion {

inline constexpr int16_t kNoCost = std::numeric_limits<int16_t>::max();
inline constexpr int kUnit = 32;  ///< weights of linear interpolation are in units of 1 / kUnit

/// Computes upper (1 - w) + lower w, times kUnit. @param weight  w times kUnit, in [0, kUnit].
void blend(const uint8_t* upper, const uint8_t* lower, int weight, int count, int16_t* blended);

void absolute_difference(const uint8_t* a, const uint8_t* b, int count, uint8_t* difference);

/// Replaces the row that leaves the window by the one that enters, in sums over the columns of the window.
void replace_row(const uint8_t* leaving, const uint8_t* entering, int count, int16_t* sums);

/// Computes the costs of windows from the sums of their columns. @param sums  `sides` elements before and after
/// [0, count) are read.
void sum_columns(const int16_t* sums, int sides, int count, int16_t* costs);

/// Keeps the minimum cost of each pixel and the plane that has it; the first of equal ones.
void keep_smaller(const int16_t* costs, int16_t plane, size_t count, int16_t* best, int16_t* best_plane);

/// Keeps the minimum cost of each pixel over planes outside of its range [first, last].
void keep_smaller_outside(const int16_t* costs, int16_t plane, size_t count, const int16_t* first, const int16_t* last,
                          int16_t* second);

}  // namespace hedgehop::vision::motion
