#pragma once

#include <CLI/CLI.hpp>

/// Numbers that a person types as options, read as a scenario's are: decimal, finite, and nothing wraps. To be attached
/// with transform() before any range is checked.
namespace hedgehop::sim::cli {

/// 0 to 2^64 - 1; "010" is ten.
CLI::Validator whole_number();

/// Any number that is finite.
CLI::Validator number();

/// Of a number: 0 and more; more than 0.
CLI::Validator not_negative();
CLI::Validator positive();

}  // namespace hedgehop::sim::cli
