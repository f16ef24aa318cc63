#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/mesh/polyhedron.h"

namespace hedgehop::scenes::mesh {

/// How an image continues outside 0..1.
enum class Wrap { repeat, mirror, clamp };

/// An image of a material, in a file or embedded in another file.
struct ImageSource {
  std::string name = {};                                   ///< as the model names it
  std::vector<std::filesystem::path> folders = {};         ///< to search, in this order
  std::shared_ptr<const std::vector<uint8_t>> bytes = {};  ///< of an embedded image; else null
  bool is_uri = false;                                     ///< `name` is a URI: percent signs encode characters
};

/// The look of a surface.
struct Material {
  std::string name = {};
  std::optional<ImageSource> image = {};
  std::array<Wrap, 2> wrap = {Wrap::repeat, Wrap::repeat};  ///< along u and v
  Eigen::Vector3f color = {0.7f, 0.7f, 0.7f};               ///< without an image, sRGB, 0..1
  Eigen::Vector3f tint = {1.0f, 1.0f, 1.0f};                ///< multiplies the image in linear light, 0..1
  std::optional<ImageSource> opacity = {};                  ///< if the opacity is in an image of its own
  std::optional<float> alpha_cutoff = {};                   ///< points of the image with less alpha are holes
  bool is_single_sided = false;                             ///< visible from the front of its triangles alone
};

/// Triangles of one material.
struct Part {
  Polyhedron body;                       ///< in the model's frame, in its units
  std::vector<Eigen::Vector3d> normals;  ///< one per corner
  std::vector<Eigen::Vector2f> uvs;      ///< one per corner or none; v grows downward from the image's first row
  std::vector<Eigen::Vector3f> colors;   ///< one per corner or none; sRGB, 0..1
  size_t material = 0;
};

/// The contents of a mesh file.
struct Model {
  std::vector<Part> parts;
  std::vector<Material> materials;
  std::set<std::string> unrendered;            ///< features of the file that are not rendered
  std::set<std::filesystem::path> files = {};  ///< that were read, without images
  bool front_is_z = false;                     ///< the front is +z, as in glTF; else -z (if y is up)
  bool winding_is_front = false;               ///< triangles are counter-clockwise seen from their front, as in glTF
};

/// The origin of a model's coordinates, subtracted before they are rounded to floats.
struct ModelOrigin {
  Eigen::Vector3d east_north_up = Eigen::Vector3d::Zero();  ///< in units of the model
  bool z_is_up = false;
};

/// Returns the directions north, east and down in the model's axes, as rows, for a heading of 0.
Eigen::Matrix3d level_axes(bool z_is_up, bool front_is_z);

/// Returns an origin in the model's axes. @param front_is_z  as level_axes() has it.
Eigen::Vector3d origin_in_model(const ModelOrigin& origin, bool front_is_z);

/// Returns the contents of a mesh file. Throws std::invalid_argument with the reason, without the file's name.
Model read_model(const std::filesystem::path& file, const ModelOrigin& origin);

/// Returns a model without parts: its materials and files. Throws as read_model() does, but finds fewer faults.
Model read_materials(const std::filesystem::path& file);

/// Returns the contents of an OBJ file: its polygons as triangles. Faces without normals are flat. Lines, points and
/// faces of one or two corners are reported.
/// @param file  its folder contains its materials. @param text  its contents, in UTF-8 without a mark.
/// Throws as read_obj_file() and ObjMaterials::find() do.
Model read_obj(const std::filesystem::path& file, std::string_view text, const ModelOrigin& origin);
/// The same for read_materials().
Model read_obj_materials(const std::filesystem::path& file, std::string_view text);

/// Returns the library that reads DAE, PLY, STL and glTF 1: "assimp 5.2.5"; empty if this build cannot read meshes.
std::string importer_version();

/// A glTF of version 1.
class OldGltf : public std::invalid_argument {
 public:
  explicit OldGltf(size_t node_count)
      : std::invalid_argument("it is a glTF of version 1 with " + std::to_string(node_count) + " nodes"),
        nodes(node_count) {}
  size_t nodes;
};

/// Returns the contents of a glTF file of version 2 (.gltf, .glb). Throws as read_model() does, or OldGltf.
Model read_gltf(const std::filesystem::path& file, const ModelOrigin& origin);
/// The same for read_materials().
Model read_gltf_materials(const std::filesystem::path& file);

/// Returns the sRGB value of a linear one, and the reverse; both 0..1.
float srgb_of_linear(float linear);
float linear_of_srgb(float srgb);

}  // namespace hedgehop::scenes::mesh
