// Only this file is compiled for AVX2. All its functions have internal linkage, so that the linker cannot use their
// AVX2 code for other files.
#ifdef __AVX2__

#include "sim/render/tiles/box_views.h"
#include "sim/render/tiles/cover.h"
#include "sim/render/tiles/finish.h"
#include "sim/render/tiles/flow.h"
#include "sim/render/tiles/kernels.h"

namespace hedgehop::sim::tiles {

const Kernels kAvx2Kernels{kLanes, draw, hides_pixels, see, finish, flow};

}  // namespace hedgehop::sim::tiles

#endif
