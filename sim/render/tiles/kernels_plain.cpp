#include "sim/render/tiles/cover.h"
#include "sim/render/tiles/finish.h"
#include "sim/render/tiles/flow.h"
#include "sim/render/tiles/kernels.h"

namespace hedgehop::sim::tiles {

const Kernels kPlainKernels{kLanes, draw, finish, flow};

}  // namespace hedgehop::sim::tiles
