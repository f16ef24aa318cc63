#pragma once

#include <opencv2/core.hpp>

#include "vision/flow_field.h"

namespace hedgehop::vision {

/// Draws each valid vector as a line from its patch centre, with a dot there, and each invalid one as a red dot.
/// @param scale  drawn length per px of flow, > 0.
/// @param rgb  CV_8UC3, RGB, of the size the field was made for.
void draw_flow(const FlowField& field, double scale, cv::Mat& rgb);

}  // namespace hedgehop::vision
