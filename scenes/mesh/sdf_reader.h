#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace hedgehop::scenes::mesh {

/// A shape of an SDF world or model. E: east, north, up of the file's origin.
struct SdfShape {
  enum class Use { visual, collision };
  enum class Kind { box, cylinder, sphere, plane, mesh };

  std::string name;  ///< "model::link::visual"
  Use use = Use::visual;
  Kind kind = Kind::box;
  Eigen::Isometry3d pose =
      Eigen::Isometry3d::Identity();  ///< of the shape's center; of a plane with its normal along z
  /// Box: sides, m. Cylinder: radius, radius, length, m. Sphere: radius three times, m. Plane: sides, m. Mesh: scale.
  Eigen::Vector3d size = Eigen::Vector3d::Ones();
  std::filesystem::path mesh;
  std::optional<Eigen::Vector3f> color;  ///< diffuse, 0..1
};

/// The shapes of a file, and the number of each kind of element that is left out: {"light", 2}.
struct SdfWorld {
  std::vector<SdfShape> shapes;
  std::map<std::string, int> left_out;
  std::set<std::filesystem::path> files;  ///< that were read
};

/// Reads a world or a model of SDFormat: boxes, cylinders, spheres, planes, meshes, poses, nested models, and includes
/// by path, whose pose and name replace those of the model. `model://name` is the folder `name` next to the file, next
/// to its folder, or in `models` there. Throws std::invalid_argument with the reason, and the file if it is an included
/// one: no SDFormat, a number that is not finite, a size that is not positive, a missing file, or more than 20 levels
/// of includes or models.
SdfWorld read_sdf(const std::filesystem::path& file);

}  // namespace hedgehop::scenes::mesh
