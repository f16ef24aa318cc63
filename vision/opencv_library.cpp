#include "vision/opencv_library.h"

#include "sim/fields/own_library.h"

namespace hedgehop::vision {

const OpenCvLibrary& opencv_library() {
  static const OpenCvLibrary& loaded =
      own_library_function<GetOpenCvLibrary>(kOpenCvLibrary, kGetOpenCvLibrary, "incomplete installation: ")();
  return loaded;
}

}  // namespace hedgehop::vision
