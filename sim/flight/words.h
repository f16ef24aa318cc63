#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

#include "sim/flight/flight.h"

/// Results of a flight in words, the same in the terminal, JUnit files, tables and pages.
namespace hedgehop::sim {

/// Returns "1 flight", "2 flights". @param noun  singular, with a plural in s.
std::string counted(size_t count, std::string_view noun);

/// Returns a number with this many decimals, >= 0. A number that is printed as zero has no sign.
std::string decimals(double value, int count);

/// Returns a number with as many significant figures, at least 4, as distinguish it from a number printed next to it.
std::string distinct_figures(double value, double other);

/// Returns the number as decimals(), with 3 or more of them.
std::string distinct_decimals(double value, double other);

/// Returns a number with its unit: "0.62 m", "12"; "unknown" unless it is finite.
/// @param other  number next to it, as in distinct_figures(); NaN if there is none.
std::string figure_words(double value, const std::string& unit,
                         double other = std::numeric_limits<double>::quiet_NaN());

/// Returns the value of a check, its time, its limit and, if it failed, its cause:
/// "0.62 m at 6.40 s, must be >= 1 m: tree 8".
std::string check_words(const CheckResult& check);

/// Returns the versions of the libraries: "OpenCV 4.6.0, SLEEF 3.5.1".
std::string library_words(const Libraries& libraries);

/// Returns the renderer without the vector width of the processor, which does not change images.
std::string renderer_words(const Libraries& libraries);

/// Returns a word, quoted for a POSIX shell if necessary. Bytes that are not UTF-8 and control characters are octal:
/// "$(printf 'caf\351.yaml')".
std::string shell_quoted(const std::string& word);

/// Returns the last line of a program's output that is not empty; a carriage return ends a line, too.
std::string last_line(std::string_view text);

/// Returns a text as a cell of a Markdown table, on one line and with its bars escaped.
std::string markdown_cell(std::string_view text);

/// Advice for flights with FlightResult::goal_missed_unchecked.
inline constexpr const char* kGoalMissedUnchecked =
    "timed out before the goal, and no check requires the goal; to require it, add {check: reached_goal} to the checks";

}  // namespace hedgehop::sim
