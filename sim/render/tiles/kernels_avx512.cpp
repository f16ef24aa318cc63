// Only this file is compiled for AVX-512. All its functions have internal linkage, so that the linker cannot use their
// AVX-512 code for other files.
#ifdef __AVX512VL__

#include "sim/render/tiles/box_views.h"
#include "sim/render/tiles/cover.h"
#include "sim/render/tiles/finish.h"
#include "sim/render/tiles/flow.h"
#include "sim/render/tiles/kernels.h"

namespace hedgehop::sim::tiles {

const Kernels kAvx512Kernels{kLanes, draw, hides_pixels, see, finish, flow};

}  // namespace hedgehop::sim::tiles

#endif
