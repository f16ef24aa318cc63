#pragma once

#include <gtest/gtest.h>

#include <filesystem>

namespace hedgehop::vision {

/// Real images with their truth and calibrations of real cameras: beside the source tree, where there are any.
inline const std::filesystem::path kRealData = HEDGEHOP_SOURCE_DIR "/../shared/data/vision";

}  // namespace hedgehop::vision

/// Skips the test where the file or folder is absent. scripts/test lists reasons, so that this one is the same for all.
#define HEDGEHOP_NEEDS_REAL_DATA(path) \
  if (!std::filesystem::exists(path))  \
  GTEST_SKIP() << "real images (../shared/data/vision) are not part of the repository"
