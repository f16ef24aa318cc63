#include "sim/render/tiles/box_views.h"
#include "sim/render/tiles/cover.h"
#include "sim/render/tiles/finish.h"
#include "sim/render/tiles/flow.h"
#include "sim/render/tiles/kernels.h"

namespace hedgehop::sim::tiles {

const Kernels kPlainKernels{kLanes, draw, hides_pixels, see, finish, flow};

}  // namespace hedgehop::sim::tiles
