#pragma once

#include <string>
#include <string_view>

#include "sim/config/input_error.h"

/// Syntax errors of YAML in plain words.
namespace hedgehop::sim {

/// A syntax error as the YAML library reports it.
struct SyntaxError {
  SourcePosition position;   ///< at which the library stopped
  std::string message;       ///< the library's
  SourcePosition container;  ///< start of the innermost list or map that is open there; line 0 if there is none
};

/// Adds the likely cause of a syntax error, or the library's message if the cause is unknown.
/// @param text  the document.
void add_syntax_error(std::string_view text, SyntaxError error, ErrorList& errors);

}  // namespace hedgehop::sim
