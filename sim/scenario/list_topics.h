#pragma once

#include <string>
#include <vector>

namespace hedgehop::sim {

/// Topics of `hedgehop list`: "modules", "vehicles", "scenes", "cameras", "checks", "scenario".
const std::vector<std::string>& document_topics();
/// Text of a topic. Throws InputError, naming the topics, for any other.
std::string document(const std::string& topic);

}  // namespace hedgehop::sim
