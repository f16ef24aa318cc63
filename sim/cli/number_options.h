#pragma once

#include <CLI/CLI.hpp>

/// Numbers of options, read like those of a scenario: decimal, finite, without integer wrap-around. Attach these
/// validators with transform() before any range check.
namespace hedgehop::sim::cli {

/// Accepts whole numbers from 0 to 2^64 - 1; "010" is ten.
CLI::Validator whole_number();

/// Accepts any finite number.
CLI::Validator number();

/// Require a number >= 0 (not_negative) or > 0 (positive).
CLI::Validator not_negative();
CLI::Validator positive();

}  // namespace hedgehop::sim::cli
