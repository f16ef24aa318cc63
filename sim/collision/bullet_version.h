#pragma once

#include <string>

namespace hedgehop::sim {

/// "Bullet 3.24".
std::string bullet_version();

}  // namespace hedgehop::sim
