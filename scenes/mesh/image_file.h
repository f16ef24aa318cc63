#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scenes/mesh/model.h"

namespace hedgehop::scenes::mesh {

/// Returns the path of a file that another file names: as it is, with backslashes as slashes or with percent signs
/// decoded (a URI is decoded first), in each of the folders; else its base name there. Empty if there is none.
std::optional<std::filesystem::path> file_named(const std::string& name,
                                                const std::vector<std::filesystem::path>& folders, bool is_uri);

/// The texture of a material.
struct MaterialImage {
  cv::Mat rgb;      ///< CV_8UC3, square
  cv::Mat opacity;  ///< CV_8UC1, the same size; empty if it is opaque everywhere or has no meaning
  Eigen::Vector2f repeat = Eigen::Vector2f::Ones();  ///< images per texture along u and v: 2 if it is mirrored
};

/// Returns the image of a material with its tint, or its color. @param size_px  of the texture.
/// @param unrendered  receives a line if the image is reduced.
/// Throws std::invalid_argument with the reason if the image is missing, cannot be decoded or is too large.
MaterialImage material_image(const Material& material, int size_px, std::set<std::string>& unrendered);

}  // namespace hedgehop::scenes::mesh
