#pragma once

#include <string>

#include "sim/config/config_tree.h"

namespace hedgehop::sim {

/// Parses a calibration file: YAML, also with the header and the tags of OpenCV, or XML of OpenCV's FileStorage.
/// Numbers keep their bits, and lines of YAML their numbers. Throws InputError. @param file  name for messages.
Node parse_calibration_text(const std::string& text, const std::string& file);

/// Returns whether a text is a calibration of OCamCalib: its first line without a comment is a row of numbers.
bool is_ocam_calibration(const std::string& text);

}  // namespace hedgehop::sim
