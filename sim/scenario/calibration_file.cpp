#include "sim/scenario/calibration_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>

#include "sim/config/config_tree.h"
#include "sim/config/input_error.h"
#include "sim/config/numbers.h"
#include "sim/scenario/calibration_text.h"

namespace hedgehop::sim {
namespace {

using Model = CameraConfig::Model;

constexpr std::string_view kFormats =
    "Kalibr's camera chain, sensor.yaml of EuRoC, camera_info of ROS, OpenCV's FileStorage with camera_matrix (or "
    "cameraMatrix, K) and distortion_coefficients (or distCoeffs, dist_coeffs, distortion, D), or of a pair with M1, "
    "D1, M2 "
    "and D2, or OCamCalib";

[[noreturn]] void refuse(const Node& node, const std::string& message) {
  throw InputError(fmt::format("{}: {}", node.position.text(), message));
}

/// Returns the value of the first of the keys that a map has, or null.
const Node* find(const Node& map, std::initializer_list<std::string_view> keys) {
  for (const std::string_view key : keys) {
    if (const Node* const value = map.find(key)) return value;
  }
  return nullptr;
}

const Node& get(const Node& map, std::initializer_list<std::string_view> keys) {
  if (const Node* const value = find(map, keys)) return *value;
  refuse(map, fmt::format("the camera has no '{}'", *keys.begin()));
}

double number(const Node& node) {
  const ParsedNumber parsed = parse_number(node.text, false);
  if (node.kind != Node::Kind::scalar || parsed.kind != ParsedNumber::Kind::number) {
    refuse(node, fmt::format("expected a number, got {}", node.description()));
  }
  return parsed.member;
}

/// Returns the numbers of a list, of a list of rows, or of a matrix with the key `data`; row by row.
std::vector<double> numbers(const Node& node) {
  if (const Node* const data = node.kind == Node::Kind::map ? node.find("data") : nullptr) return numbers(*data);
  if (node.kind == Node::Kind::null) return {};
  if (node.kind != Node::Kind::list) refuse(node, fmt::format("expected numbers, got {}", node.description()));
  std::vector<double> all;
  for (const Node& item : node.items) {
    if (item.kind == Node::Kind::list) {
      std::ranges::copy(numbers(item), std::back_inserter(all));
    } else {
      all.push_back(number(item));
    }
  }
  return all;
}

std::vector<double> numbers(const Node& node, size_t count, std::string_view what) {
  std::vector<double> all = numbers(node);
  if (all.size() != count) refuse(node, fmt::format("{} must have {} numbers, got {}", what, count, all.size()));
  return all;
}

void set_intrinsics(CameraConfig& config, double focal_x_px, double focal_y_px, double center_u_px,
                    double center_v_px) {
  config.focal_x_px = focal_x_px;
  config.focal_y_px = focal_y_px;
  config.center_u_px = center_u_px;
  config.center_v_px = center_v_px;
}

void set_matrix(CameraConfig& config, const Node& node) {
  const std::vector<double> K = numbers(node, 9, "the camera matrix");
  if (K[1] != 0.0) refuse(node, "a camera matrix with skew is not implemented");
  set_intrinsics(config, K[0], K[4], K[2], K[5]);
}

void set_size(CameraConfig& config, const Node& map) {
  config.width_px = config.height_px = 0;
  const auto whole = [](const Node& node, double value) {
    if (!(value >= 1.0 && value <= 65536.0 && value == std::floor(value))) {
      refuse(node, "the image size must be whole numbers of pixels");
    }
    return static_cast<int>(value);
  };
  if (const Node* const size = find(map, {"resolution", "image_size", "imageSize", "image_Size"})) {
    const std::vector<double> both = numbers(*size, 2, "the image size");
    config.width_px = whole(*size, both[0]);
    config.height_px = whole(*size, both[1]);
    return;
  }
  const Node* const width = find(map, {"image_width", "width"});
  const Node* const height = find(map, {"image_height", "height"});
  if (!width || !height) return;
  config.width_px = whole(*width, number(*width));
  config.height_px = whole(*height, number(*height));
}

/// Sets the distortion of a pinhole: up to 14 coefficients of OpenCV.
void set_pinhole(CameraConfig& config, const Node& node, std::vector<double> k) {
  config.model_kind = Model::pinhole;
  constexpr std::array<size_t, 6> kCounts = {0, 4, 5, 8, 12, 14};
  if (std::ranges::find(kCounts, k.size()) == kCounts.end()) {
    refuse(node, fmt::format("a pinhole has {} coefficients, got {}", fmt::join(kCounts, ", "), k.size()));
  }
  const auto is_used = [&](size_t from, size_t to) {
    return k.size() >= to && std::any_of(k.begin() + static_cast<ptrdiff_t>(from),
                                         k.begin() + static_cast<ptrdiff_t>(to), [](double c) { return c != 0.0; });
  };
  if (is_used(8, 12)) refuse(node, "the thin prism model (s1 to s4) is not implemented");
  if (is_used(12, 14)) refuse(node, "the tilted model (tau_x, tau_y) is not implemented");
  k.resize(std::min<size_t>(k.size(), 8));
  config.distortion = std::move(k);
}

void set_fisheye(CameraConfig& config, const Node& node, std::vector<double> k) {
  if (k.size() != 4) refuse(node, fmt::format("a fisheye has 4 coefficients, got {}", k.size()));
  config.model_kind = Model::fisheye;
  config.distortion = std::move(k);
}

/// Sets the lens by the names of a camera model and a distortion model. @param node  of the distortion model.
void set_lens(CameraConfig& config, std::string_view camera_model, std::string_view distortion_model, const Node& node,
              const std::vector<double>& k) {
  const bool none = distortion_model.empty() || distortion_model == "none";
  const bool radtan =
      distortion_model == "radtan" || distortion_model == "radial-tangential" || distortion_model == "plumb_bob";
  if (distortion_model == "fov" || distortion_model == "thin_prism" || distortion_model == "tilted") {
    refuse(node, fmt::format("the distortion model '{}' is not implemented", distortion_model));
  }
  if (camera_model == "eucm") refuse(node, "the extended unified model (eucm) is not implemented");
  if (camera_model == "pinhole") {
    if (none && k.empty()) return set_pinhole(config, node, {});
    if (radtan || distortion_model == "rational_polynomial") return set_pinhole(config, node, k);
    if (distortion_model == "equidistant" || distortion_model == "fisheye") return set_fisheye(config, node, k);
    refuse(node, fmt::format("unknown distortion model '{}'; valid: radtan, radial-tangential, plumb_bob, "
                             "rational_polynomial, equidistant, none",
                             distortion_model));
  }
  if (camera_model == "omni") {
    if (!radtan && !none) refuse(node, "the model omni needs the distortion model radtan or none");
    if (k.size() != 4 && !k.empty()) refuse(node, fmt::format("radtan has 4 coefficients, got {}", k.size()));
    config.model_kind = Model::unified;
    config.distortion = k;
    return;
  }
  if (camera_model == "ds") {
    if (!none) refuse(node, "the model ds needs the distortion model none");
    config.model_kind = Model::double_sphere;
    return;
  }
  refuse(node, fmt::format("unknown camera model '{}'; valid: pinhole, omni, ds", camera_model));
}

std::string_view text_of(const Node* node) {
  return node && node->kind == Node::Kind::scalar ? std::string_view(node->text) : "";
}

/// Reads the intrinsics of Kalibr and EuRoC: those of the model, then focal lengths and center.
void read_named_model(const Node& map, CameraConfig& config) {
  const Node& model = get(map, {"camera_model"});
  const Node* const distortion = find(map, {"distortion_model"});
  const Node* const k = find(map, {"distortion_coeffs", "distortion_coefficients"});
  set_lens(config, text_of(&model), text_of(distortion), distortion ? *distortion : model,
           k ? numbers(*k) : std::vector<double>{});
  const size_t own = config.model_kind == Model::unified ? 1 : config.model_kind == Model::double_sphere ? 2 : 0;
  const std::vector<double> all = numbers(get(map, {"intrinsics"}), own + 4, "intrinsics");
  if (own > 0) config.xi = all[0];
  if (own > 1) config.alpha = all[1];
  set_intrinsics(config, all[own], all[own + 1], all[own + 2], all[own + 3]);
  set_size(config, map);
}

std::vector<CalibratedCamera> read_chain(const Node& root) {
  std::vector<CalibratedCamera> cameras;
  for (const auto& [key, position, map] : root.entries) {
    if (map.kind != Node::Kind::map || !map.find("camera_model") || !map.find("intrinsics")) continue;
    CalibratedCamera camera{.name = key, .role = key, .config = {}, .rate_hz = {}};
    // "/left/image_raw" is the camera left.
    const std::filesystem::path topic(text_of(map.find("rostopic")));
    if (topic.has_filename() && topic.parent_path().has_filename())
      camera.role = topic.parent_path().filename().string();
    read_named_model(map, camera.config);
    if (const Node* const pose = map.find("T_cam_imu")) {
      camera.config.camera_from_imu = numbers(*pose, 16, "T_cam_imu");
    } else if (const Node* const inverse = map.find("T_imu_cam")) {  // of OpenVINS
      camera.config.imu_from_camera = numbers(*inverse, 16, "T_imu_cam");
    } else if (const Node* const relative = map.find("T_cn_cnm1"); relative && !cameras.empty()) {
      camera.config.camera_from_previous = numbers(*relative, 16, "T_cn_cnm1");
    }
    const bool is_taken = std::ranges::find(cameras, camera.role, &CalibratedCamera::role) != cameras.end();
    if (is_taken) camera.role = key;
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

CalibratedCamera read_sensor(const Node& map) {
  CalibratedCamera camera;
  read_named_model(map, camera.config);
  if (const Node* const pose = map.find("T_BS")) camera.config.imu_from_camera = numbers(*pose, 16, "T_BS");
  if (const Node* const rate = map.find("rate_hz")) camera.rate_hz = number(*rate);
  return camera;
}

/// Reads a camera with a camera matrix: of OpenCV's FileStorage or of ROS.
CalibratedCamera read_matrix_camera(const Node& map, std::string name) {
  CalibratedCamera camera{.name = name, .role = std::move(name), .config = {}, .rate_hz = {}};
  if (camera.name.empty()) camera.name = camera.role = text_of(map.find("camera_name"));
  CameraConfig& config = camera.config;
  const Node* const coefficients =
      find(map, {"distortion_coefficients", "distCoeffs", "dist_coeffs", "distortion", "D", "d"});
  const std::vector<double> k = coefficients ? numbers(*coefficients) : std::vector<double>{};
  const Node& place = coefficients ? *coefficients : map;
  constexpr std::array<std::string_view, 3> kKinds = {"pinhole", "fisheye", "omnidir"};
  const Node* const model = map.find("camera_model");
  const std::string_view kind = text_of(model);
  if (!kind.empty() && std::ranges::find(kKinds, kind) == kKinds.end()) {
    refuse(*model, fmt::format("unknown camera model '{}'; valid: {}", kind, fmt::join(kKinds, ", ")));
  }
  const std::string_view named = text_of(map.find("distortion_model")), flag = text_of(map.find("fisheye_model"));
  if (!named.empty()) {
    set_lens(config, "pinhole", named, *map.find("distortion_model"), k);
  } else if (kind == "omnidir") {
    set_lens(config, "omni", "radtan", place, k);
    const Node& xi = get(map, {"xi"});
    config.xi = xi.kind == Node::Kind::scalar ? number(xi) : numbers(xi, 1, "xi")[0];
  } else if (kind == "fisheye" || flag == "1") {
    set_fisheye(config, place, k);
  } else {
    set_pinhole(config, place, k);
  }
  set_matrix(config, get(map, {"camera_matrix", "cameraMatrix", "K", "k"}));
  set_size(config, map);
  if (const Node* const pose = map.find("body_from_camera")) {
    config.body_from_camera = numbers(*pose, 16, "body_from_camera");
  } else if (const Node* const from_imu = map.find("imu_from_camera")) {
    config.imu_from_camera = numbers(*from_imu, 16, "imu_from_camera");
  }
  return camera;
}

/// Reads a pair of OpenCV's sample stereo_calib: M1 and D1 of the left camera, M2 and D2 of the right one. R and T, in
/// m, map points of the left camera to the right one.
std::vector<CalibratedCamera> read_pair(const Node& root) {
  const auto camera_of = [&](const std::string& number, const std::string& role) {
    Node map = root;
    for (auto& entry : map.entries) {
      if (entry.key == "M" + number) entry.key = "camera_matrix";
      if (entry.key == "D" + number) entry.key = "distortion_coefficients";
    }
    return read_matrix_camera(map, role);
  };
  std::vector<CalibratedCamera> pair = {camera_of("1", "left"), camera_of("2", "right")};
  const Node *const R = root.find("R"), *const T = root.find("T");
  if (R && T) {
    constexpr double kMaxBaselineM = 10.0;
    const std::vector<double> rows = numbers(*R, 9, "R"), t = numbers(*T, 3, "T");
    const double baseline_m = std::hypot(t[0], t[1], t[2]);
    if (baseline_m > kMaxBaselineM) refuse(*T, fmt::format("T has a length of {} m; state it in meters", baseline_m));
    pair[1].config.camera_from_previous = {rows[0], rows[1], rows[2], t[0], rows[3], rows[4], rows[5], t[1],
                                           rows[6], rows[7], rows[8], t[2], 0.0,     0.0,     0.0,     1.0};
  }
  return pair;
}

bool has_matrix(const Node& map) {
  return map.kind == Node::Kind::map && find(map, {"camera_matrix", "cameraMatrix", "K", "k"});
}

}  // namespace

std::vector<CalibratedCamera> parse_calibration(const std::string& text, const std::string& file) {
  const Node root = parse_calibration_text(text, file);
  if (root.kind == Node::Kind::map) {
    if (root.find("M1") && root.find("M2")) return read_pair(root);
    if (has_matrix(root)) return {read_matrix_camera(root, "")};
    if (root.find("camera_model")) return {read_sensor(root)};
    if (std::vector<CalibratedCamera> chain = read_chain(root); !chain.empty()) return chain;
    std::vector<CalibratedCamera> cameras;
    for (const auto& [key, position, map] : root.entries) {
      if (has_matrix(map)) cameras.push_back(read_matrix_camera(map, key));
    }
    if (!cameras.empty()) return cameras;
  }
  throw InputError(fmt::format("{}: is no calibration; valid: {}", file, kFormats));
}

}  // namespace hedgehop::sim
