#include "sim/render/tiles/cover.h"
#include "sim/render/tiles/finish.h"
#include "sim/render/tiles/kernels.h"

namespace hedgehop::sim::tiles {

const Kernels kPlainKernels{kLanes, draw, finish};

}  // namespace hedgehop::sim::tiles
