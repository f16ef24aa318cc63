#include "scenes/mesh/sdf_reader.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>

namespace hedgehop::scenes::mesh {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kMaxSdfDepth = 20;  // of includes and nested models
constexpr size_t kMaxShapes = 100'000;
constexpr std::uintmax_t kMaxSdfBytes = 64'000'000;

// Elements without an effect on shapes.
const std::set<std::string> kSilent = {
    "static",    "pose",    "uri",   "name",        "self_collide",   "allow_auto_disable", "inertial",
    "kinematic", "gravity", "frame", "enable_wind", "velocity_decay", "must_be_base_link"};

[[noreturn]] void refuse(const std::string& why) { throw std::invalid_argument(why); }

std::vector<double> numbers(const pugi::xml_node& node) {
  std::istringstream words(node.text().get());
  std::vector<double> all;
  for (double number = 0.0; words >> number;) all.push_back(number);
  for (const double number : all) {
    if (!std::isfinite(number)) refuse(std::string("<") + node.name() + "> has a number that is not finite");
  }
  if (!words.eof()) refuse(std::string("<") + node.name() + "> expects numbers, got '" + node.text().get() + "'");
  return all;
}

std::vector<double> numbers(const pugi::xml_node& node, size_t count) {
  std::vector<double> all = numbers(node);
  if (all.size() != count) {
    refuse(std::string("<") + node.name() + "> expects " + std::to_string(count) + " numbers, got " +
           std::to_string(all.size()));
  }
  return all;
}

double positive(const pugi::xml_node& node) {
  const double number = numbers(node, 1)[0];
  if (!(number > 0.0)) refuse(std::string("<") + node.name() + "> must be above 0");
  return number;
}

/// The place of a file's models.
struct Placement {
  Isometry3d parent = Isometry3d::Identity();  ///< of the world or model that includes the file
  std::string prefix;                          ///< of names
  std::optional<Isometry3d> pose = {};         ///< in the parent, instead of the model's own
  std::string name = {};                       ///< instead of the model's own; empty: its own
};

class Reader {
 public:
  SdfWorld take() { return std::move(world_); }

  /// Reads the worlds and models of a file.
  void read_file(const std::filesystem::path& file, const Placement& at, int depth) {
    if (depth > kMaxSdfDepth) refuse("its includes are nested deeper than 20 levels");
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) refuse("there is no such file");
    if (std::filesystem::file_size(file, error) > kMaxSdfBytes) refuse("it is larger than 64 MB");
    world_.files.insert(file.lexically_normal());
    pugi::xml_document document;
    if (const pugi::xml_parse_result parsed = document.load_file(file.c_str()); !parsed) {
      refuse(std::string("it is not XML: ") + parsed.description());
    }
    const pugi::xml_node sdf = document.child("sdf");
    if (!sdf) refuse("it has no element <sdf>");
    folder_.push_back(file.parent_path());
    for (const pugi::xml_node& child : sdf.children()) {
      const std::string kind = child.name();
      if (kind == "world") {
        read_children(child, at.parent * at.pose.value_or(Isometry3d::Identity()), at.prefix, depth);
      } else if (kind == "model") {
        const std::string name = at.name.empty() ? child.attribute("name").value() : at.name;
        read_model(child, at.parent * at.pose.value_or(pose_in(sdf, child)), at.prefix + name, depth);
      } else {
        leave_out(child);
      }
    }
    folder_.pop_back();
  }

 private:
  /// Returns the numbers of an element's pose.
  static Isometry3d written_pose(const pugi::xml_node& element) {
    Isometry3d X = Isometry3d::Identity();
    const pugi::xml_node pose = element.child("pose");
    if (!pose || numbers(pose).empty()) return X;
    const bool quaternion = std::string(pose.attribute("rotation_format").value()) == "quat_xyzw";
    const std::vector<double> p = numbers(pose, quaternion ? 7 : 6);
    const double per_unit = pose.attribute("degrees").as_bool() ? std::numbers::pi / 180.0 : 1.0;
    X.translation() = Vector3d(p[0], p[1], p[2]);
    X.linear() = quaternion ? Eigen::Quaterniond(p[6], p[3], p[4], p[5]).normalized().toRotationMatrix()
                            : (Eigen::AngleAxisd(per_unit * p[5], Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(per_unit * p[4], Vector3d::UnitY()) *
                               Eigen::AngleAxisd(per_unit * p[3], Vector3d::UnitX()))
                                  .toRotationMatrix();
    return X;
  }

  /// Returns the name of the frame to which an element's pose is relative; empty for its parent.
  static std::string frame_of(const pugi::xml_node& element) {
    const pugi::xml_node pose = element.child("pose");
    for (const char* attribute : {"relative_to", "frame"}) {
      const std::string name = pose.attribute(attribute).value();
      if (!name.empty()) return name == "__model__" || name == "world" ? "" : name;
    }
    if (std::string(element.name()) == "frame") return element.attribute("attached_to").value();
    return std::string(element.name()) == "joint" ? element.child("child").text().get() : "";
  }

  /// Returns the pose of a link, frame, joint or model in the world or model that contains it.
  static Isometry3d pose_in(const pugi::xml_node& scope, const pugi::xml_node& element, int depth = 0) {
    if (element.attribute("placement_frame") || element.child("placement_frame")) {
      refuse("placement_frame is not read");
    }
    return pose_of_frame(scope, frame_of(element), depth) * written_pose(element);
  }

  static Isometry3d pose_of_frame(const pugi::xml_node& scope, const std::string& name, int depth = 0) {
    if (name.empty()) return Isometry3d::Identity();
    if (depth > kMaxSdfDepth) refuse("the poses of its frames are relative to each other");
    for (const pugi::xml_node& child : scope.children()) {
      if (child.attribute("name").value() == name) return pose_in(scope, child, depth + 1);
    }
    refuse("<pose> is relative to '" + name + "', which is no link, frame, joint or model in the same model");
  }

  void leave_out(const pugi::xml_node& element) {
    if (element.type() == pugi::node_element && !kSilent.contains(element.name())) ++world_.left_out[element.name()];
  }

  void read_children(const pugi::xml_node& parent, const Isometry3d& placed, const std::string& prefix, int depth) {
    if (depth > kMaxSdfDepth) refuse("its models are nested deeper than 20 levels");
    for (const pugi::xml_node& child : parent.children()) {
      const std::string kind = child.name();
      if (kind == "model") {
        read_model(child, placed * pose_in(parent, child), prefix + child.attribute("name").value(), depth + 1);
      } else if (kind == "include") {
        Placement at{.parent = placed, .prefix = prefix, .name = child.child("name").text().get()};
        const Isometry3d pose = pose_in(parent, child);
        if (child.child("pose")) at.pose = pose;
        read_include(child, at, depth);
      } else if (kind == "link") {
        read_link(child, placed, prefix + child.attribute("name").value());
      } else {
        leave_out(child);
      }
    }
  }

  void read_model(const pugi::xml_node& model, const Isometry3d& model_pose, const std::string& name, int depth) {
    read_children(model, model_pose, name + "::", depth);
  }

  /// Returns the file of a URI: of an SDF or a mesh.
  std::filesystem::path resolve(const std::string& uri) const {
    std::filesystem::path path = uri;
    std::vector<std::filesystem::path> places = {folder_.back()};
    for (const char* scheme : {"model://", "file://"}) {
      if (!uri.starts_with(scheme)) continue;
      path = uri.substr(std::string(scheme).size());
      places.push_back(folder_.back().parent_path());
      places.push_back(folder_.back() / "models");
      places.push_back(folder_.back().parent_path() / "models");
      places.push_back(folder_.back().parent_path().parent_path());
    }
    std::error_code error;
    for (const std::filesystem::path& place : places) {
      std::filesystem::path file = path.is_absolute() ? path : place / path;
      if (std::filesystem::is_directory(file, error)) file = file / "model.sdf";
      if (std::filesystem::exists(file, error)) return file.lexically_normal();
    }
    refuse("<uri> '" + uri + "': there is no such file");
  }

  void read_include(const pugi::xml_node& include, const Placement& at, int depth) {
    const std::filesystem::path file = resolve(include.child("uri").text().get());
    try {
      read_file(file, at, depth + 1);
    } catch (const std::invalid_argument& fault) {
      refuse("included '" + file.string() + "': " + fault.what());
    }
  }

  void read_link(const pugi::xml_node& link, const Isometry3d& model_pose, const std::string& prefix) {
    const pugi::xml_node model = link.parent();
    for (const pugi::xml_node& child : link.children()) {
      const std::string kind = child.name();
      if (kind == "visual" || kind == "collision") {
        const std::string frame = frame_of(child);
        const Isometry3d in_model = frame.empty() ? pose_in(model, link) : pose_of_frame(model, frame);
        read_shape(child, model_pose * in_model * written_pose(child), prefix + "::" + child.attribute("name").value());
      } else {
        leave_out(child);
      }
    }
  }

  void read_shape(const pugi::xml_node& element, const Isometry3d& pose, const std::string& name) {
    SdfShape shape{.name = name,
                   .use = std::string(element.name()) == "visual" ? SdfShape::Use::visual : SdfShape::Use::collision,
                   .pose = pose};
    if (const pugi::xml_node diffuse = element.child("material").child("diffuse")) {
      const std::vector<double> color = numbers(diffuse);
      if (color.size() < 3) refuse("<diffuse> expects 3 or 4 numbers");
      shape.color = Eigen::Vector3d(color[0], color[1], color[2]).cwiseMax(0.0).cwiseMin(1.0).cast<float>();
    }
    if (element.child("material").child("script") && !element.child("material").child("diffuse")) {
      ++world_.left_out["material script"];
    }
    const pugi::xml_node geometry = element.child("geometry");
    for (const pugi::xml_node& form : geometry.children()) {
      if (form.type() != pugi::node_element) continue;
      if (!read_form(form, shape)) {
        ++world_.left_out[std::string("geometry ") + form.name()];
        continue;
      }
      if (world_.shapes.size() == kMaxShapes) refuse("it has more than 100,000 shapes");
      world_.shapes.push_back(shape);
    }
  }

  /// Reads a geometry; returns whether it is supported.
  bool read_form(const pugi::xml_node& form, SdfShape& shape) {
    const std::string kind = form.name();
    if (kind == "box") {
      const std::vector<double> size = numbers(form.child("size"), 3);
      shape.kind = SdfShape::Kind::box;
      shape.size = Vector3d(size[0], size[1], size[2]);
    } else if (kind == "cylinder") {
      const double radius_m = positive(form.child("radius"));
      shape.kind = SdfShape::Kind::cylinder;
      shape.size = Vector3d(radius_m, radius_m, positive(form.child("length")));
    } else if (kind == "sphere") {
      shape.kind = SdfShape::Kind::sphere;
      shape.size = Vector3d::Constant(positive(form.child("radius")));
    } else if (kind == "plane") {
      shape.kind = SdfShape::Kind::plane;
      Vector3d normal = Vector3d::UnitZ();
      if (const pugi::xml_node given = form.child("normal")) {
        const std::vector<double> n = numbers(given, 3);
        normal = Vector3d(n[0], n[1], n[2]);
      }
      if (!(normal.norm() > 0.0)) refuse("<normal> must not be 0");
      shape.pose.rotate(Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal));
      const std::vector<double> size = form.child("size") ? numbers(form.child("size"), 2) : std::vector{1.0, 1.0};
      shape.size = Vector3d(size[0], size[1], 1.0);
    } else if (kind == "mesh") {
      shape.kind = SdfShape::Kind::mesh;
      shape.mesh = resolve(form.child("uri").text().get());
      if (const pugi::xml_node scale = form.child("scale")) {
        const std::vector<double> s = numbers(scale, 3);
        shape.size = Vector3d(s[0], s[1], s[2]);
      }
      if (form.child("submesh")) ++world_.left_out["submesh"];
    } else {
      return false;
    }
    if (!(shape.size.minCoeff() > 0.0)) refuse("the size of <" + kind + "> must be above 0");
    return true;
  }

  SdfWorld world_;
  std::vector<std::filesystem::path> folder_;  ///< of the files that are open
};

}  // namespace

SdfWorld read_sdf(const std::filesystem::path& file) {
  Reader reader;
  reader.read_file(file, {}, 0);
  return reader.take();
}

}  // namespace hedgehop::scenes::mesh
