#pragma once

namespace hedgehop::avoidance {

/// The law of an avoidance method. The choices have the same names in every method.
enum class Law {
  published,  ///< the paper's law with the paper's thresholds
  modified,   ///< the paper's law with Hedgehop's additions
};

}  // namespace hedgehop::avoidance
