// Compiled for AVX-512, and nothing else is: what the linker could take from here for other files would not run
// anywhere.
#ifdef __AVX512VL__

#include "sim/render/tiles/cover.h"
#include "sim/render/tiles/finish.h"
#include "sim/render/tiles/flow.h"
#include "sim/render/tiles/kernels.h"
#include "sim/render/tiles/occlusion.h"

namespace hedgehop::sim::tiles {

const Kernels kAvx512Kernels{kLanes, draw, hides, finish, flow};

}  // namespace hedgehop::sim::tiles

#endif
