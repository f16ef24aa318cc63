#pragma once

#include <string>

#include "scenes/scene.h"

namespace hedgehop::sim {

/// Returns labels.json: `classes`, the value of each class in semantic images, and `instances`, the id, name and class
/// of each label. 0 is the sky in both.
std::string labels_json(const scenes::Scene& scene);

}  // namespace hedgehop::sim
