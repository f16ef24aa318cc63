#include "sim/render/raster.h"

#include <opencv2/core.hpp>
#include <stdexcept>

namespace hedgehop::sim {

int type_of(Raster raster) {
  switch (raster) {
    case Raster::grey:
      return CV_8UC1;
    case Raster::color:
      return CV_8UC3;
    case Raster::depth:
      return CV_32FC1;
    case Raster::planes:
      return CV_32FC4;
    case Raster::labels:
      return CV_32SC1;
  }
  throw std::invalid_argument("unknown raster");
}

}  // namespace hedgehop::sim
