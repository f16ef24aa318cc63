#pragma once

#include <vector>

#include "scenes/movers.h"

namespace hedgehop::scenes {

/// What any scene can have besides what its generator makes.
struct Additions {
  std::vector<MoverConfig> movers;
};

template <class Visitor>
void describe(Visitor& v, Additions& c) {
  v("movers", c.movers, {.meaning = "obstacles that move"});
}

}  // namespace hedgehop::scenes
