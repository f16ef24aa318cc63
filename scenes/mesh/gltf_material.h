#pragma once

#include <Eigen/Geometry>
#include <map>
#include <set>
#include <string>

#include "scenes/mesh/gltf_file.h"
#include "scenes/mesh/model.h"

namespace hedgehop::scenes::mesh {

/// A material of a glTF file.
struct GltfMaterial {
  Material look;
  size_t uv_set = 0;  ///< of its image: TEXCOORD_n
  Eigen::Affine2f uv_transform = Eigen::Affine2f::Identity();
};

/// Reads the materials of a glTF file.
class GltfMaterials {
 public:
  /// @param unrendered  receives features that are not rendered.
  GltfMaterials(const GltfFile& file, std::set<std::string>& unrendered) : file_(file), unrendered_(unrendered) {}

  /// Returns a material; the default one past the end of the list.
  GltfMaterial read(size_t index);

 private:
  const ImageSource& image_source(size_t index);
  void read_image(const GltfFile::Json& info, GltfMaterial& material);
  void note_unrendered(const GltfFile::Json& material);

  const GltfFile& file_;
  std::set<std::string>& unrendered_;
  std::map<size_t, ImageSource> images_;  ///< materials share the bytes
};

}  // namespace hedgehop::scenes::mesh
