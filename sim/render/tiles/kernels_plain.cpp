#include "sim/render/tiles/cover.h"
#include "sim/render/tiles/finish.h"
#include "sim/render/tiles/flow.h"
#include "sim/render/tiles/kernels.h"
#include "sim/render/tiles/occlusion.h"

namespace hedgehop::sim::tiles {

const Kernels kPlainKernels{kLanes, draw, hides, finish, flow};

}  // namespace hedgehop::sim::tiles
