#pragma once

#include <gtest/gtest.h>

#include <filesystem>

namespace hedgehop::vision {

/// Folder of real images with ground truth and of real calibrations, next to the source tree; may be absent.
inline const std::filesystem::path kRealData = HEDGEHOP_SOURCE_DIR "/../shared/data/vision";

}  // namespace hedgehop::vision

/// Skips the test if the file or folder is absent. The reason is equal for all tests, because scripts/test lists
/// reasons.
#define HEDGEHOP_NEEDS_REAL_DATA(path) \
  if (!std::filesystem::exists(path))  \
  GTEST_SKIP() << "real images (../shared/data/vision) are not part of the repository"
