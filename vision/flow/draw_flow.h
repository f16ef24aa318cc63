#pragma once

#include <opencv2/core.hpp>

#include "vision/flow/flow_field.h"

namespace hedgehop::vision::flow {

/// Draws each valid vector as a line from its patch center, with a dot there, and each invalid one as a red dot.
/// @param scale  drawn length per px of flow, > 0.
/// @param rgb  CV_8UC3, RGB, of the size the field was made for.
void draw_flow(const FlowField& field, double scale, cv::Mat& rgb);

}  // namespace hedgehop::vision::flow
