#include "scenes/mesh/mesh_import.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <utility>

#include "scenes/mesh/image_file.h"
#include "scenes/mesh/mesh_builder.h"
#include "scenes/mesh/mesh_reader.h"
#include "scenes/mesh/placement.h"
#include "scenes/mesh/sdf_import.h"
#include "scenes/mesh/sdf_reader.h"
#include "sim/fields/bounds.h"
#include "sim/fields/invalid_field.h"

namespace hedgehop::scenes::mesh {

namespace {

// Returns the map from the model's frame to W. It turns the model's front to the heading and its up axis upward.
Eigen::Affine3d model_to_world(const ImportConfig& c, bool z_is_up, bool front_is_z) {
  return Eigen::Translation3d(c.north_m, c.east_m, -c.altitude_m) *
         Eigen::AngleAxisd(c.heading_rad, Eigen::Vector3d::UnitZ()) *
         Eigen::Affine3d(c.scale * level_axes(z_is_up, front_is_z));
}

// Adds the meshes of a file. Returns the features that are not rendered and the images that are reduced.
std::string add_mesh(const ImportConfig& c, const Eigen::Vector3d& origin_ENU, Scene& scene) {
  const bool z_is_up = c.up == ImportConfig::Up::z, is_solid = c.collide == ImportConfig::Collide::surface;
  if (is_sdf(c.file)) {
    return add_sdf(c, model_to_world(c, true, false) * Eigen::Translation3d(-origin_ENU), scene);
  }
  if (z_is_up && suffix_of(c.file) == ".dae") {
    throw std::invalid_argument("a DAE file states its own up axis (<up_axis>); leave out 'up: z'");
  }
  PlacedModel placed(read_model(c.file, {origin_ENU, z_is_up}));
  const Eigen::Affine3d to_W = model_to_world(c, z_is_up, placed.model().front_is_z);
  MeshBuilder builder("opaque");
  builder.begin_instance(c.name, c.kind);
  if (placed.add({c.name, to_W, true, is_solid}, builder, scene) == 0) {
    const bool any =
        std::ranges::any_of(placed.model().parts, [](const Part& part) { return !part.body.faces.empty(); });
    throw std::invalid_argument(any ? "its triangles have no area" : "it has no triangles");
  }
  scene.meshes.push_back(builder.finish());
  return placed.remarks();
}

// Adds the files that a mesh reads to `files`, with its images.
void list_files(const std::filesystem::path& mesh, std::set<std::filesystem::path>& files) {
  Model model = read_materials(mesh);
  for (const Material& material : model.materials) {
    for (const std::optional<ImageSource>& image : {material.image, material.opacity}) {
      if (!image || image->bytes) continue;
      const auto file = file_named(image->name, image->folders, image->is_uri);
      if (file) files.insert(file->lexically_normal());
    }
  }
  files.merge(model.files);
}

// Returns the size of a scene's meshes from the one with the index `first` on; "" without such meshes.
std::string size_words(const Scene& scene, size_t first) {
  constexpr double kMinM = 0.01, kMaxM = 1000.0;
  Eigen::AlignedBox3f box_W;
  for (size_t i = first; i < scene.meshes.size(); ++i) {
    for (const Vertex& vertex : scene.meshes[i].vertices) box_W.extend(vertex.p_W);
  }
  if (box_W.isEmpty()) return "";
  const Eigen::Vector3d size_m = (1e3 * box_W.sizes().cast<double>()).array().round() / 1e3;
  char text[120];
  std::snprintf(text, sizeof text, "%.7g x %.7g x %.7g m (north, east, up)", size_m.x(), size_m.y(), size_m.z());
  const double longest_m = size_m.maxCoeff();
  if (longest_m >= kMinM && longest_m <= kMaxM) return text;
  return std::string(text) + (longest_m > kMaxM ? ", over 1 km" : ", below 1 cm") + "; check its 'scale'";
}

}  // namespace

std::vector<std::string> add_imports(const std::vector<ImportConfig>& imports, const Eigen::Vector3d& origin_ENU,
                                     Scene& scene) {
  std::vector<std::string> lines;
  for (size_t k = 0; k < imports.size(); ++k) {
    const ImportConfig& import = imports[k];
    fields::require_bounds(import, "imports." + std::to_string(k));
    const size_t first = scene.meshes.size();
    std::string remarks;
    try {
      remarks = add_mesh(import, import.origin_ENU.value_or(origin_ENU / import.scale), scene);
    } catch (const std::exception& fault) {
      throw fields::InvalidField("imports." + std::to_string(k) + ".file", "'" + import.file + "': " + fault.what());
    }
    for (const std::string& words : {size_words(scene, first), remarks}) {
      std::string line = "'" + import.file + "': " + words;
      if (!words.empty() && std::ranges::find(lines, line) == lines.end()) lines.push_back(std::move(line));
    }
  }
  return lines;
}

std::set<std::filesystem::path> mesh_files(const std::filesystem::path& mesh) {
  try {
    std::set<std::filesystem::path> files;
    if (is_sdf(mesh)) {
      SdfWorld world = read_sdf(mesh);
      for (const SdfShape& shape : world.shapes) {
        if (shape.kind == SdfShape::Kind::mesh && !files.contains(shape.mesh)) list_files(shape.mesh, files);
      }
      files.merge(world.files);
    } else {
      list_files(mesh, files);
    }
    return files;
  } catch (const std::invalid_argument& fault) {
    throw std::invalid_argument("'" + mesh.string() + "': " + fault.what());
  }
}

}  // namespace hedgehop::scenes::mesh
