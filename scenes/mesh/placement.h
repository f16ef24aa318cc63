#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scenes/mesh/cut.h"
#include "scenes/mesh/image_file.h"
#include "scenes/mesh/mesh_builder.h"
#include "scenes/mesh/model.h"
#include "scenes/scene.h"

namespace hedgehop::scenes::mesh {

/// A model with the textures that it has added to a scene so far. It can be placed several times in that scene.
class PlacedModel {
 public:
  explicit PlacedModel(Model model) : model_(std::move(model)), textures_(model_.materials.size()) {}

  const Model& model() const { return model_; }

  /// A place of the model. @param to_W  from the model's coordinates; of positive determinant.
  struct Place {
    std::string name;  ///< of its solids
    Eigen::Affine3d to_W = Eigen::Affine3d::Identity();
    bool is_drawn = true, is_solid = true;
  };

  /// Adds triangles to the builder's current instance, and one solid of shape `surface` per part.
  /// @return the number of triangles.
  /// @throws std::invalid_argument with the reason: an invalid corner, or an image that is missing or invalid.
  size_t add(const Place& place, MeshBuilder& builder, Scene& scene);

  /// The features that are not rendered and the images that are reduced, in one line; empty without them.
  std::string remarks() const;

 private:
  struct Texture {
    uint32_t index;
    MaterialImage image;
  };

  const Texture& texture_of(size_t material, Scene& scene);
  bool cover(const Part& part, Triangles& triangles, Scene& scene);

  Model model_;
  std::vector<std::optional<Texture>> textures_;  ///< of the materials
  std::set<std::string> changes_;                 ///< images that are reduced
};

}  // namespace hedgehop::scenes::mesh
