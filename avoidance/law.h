#pragma once

namespace hedgehop::avoidance {

/// Which law a method flies by, in the same words for every method.
enum class Law {
  printed,  ///< as the paper prints it, with the paper's thresholds
  ours,     ///< with our additions
};

}  // namespace hedgehop::avoidance
