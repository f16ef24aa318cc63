#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scripts/bench.d/drawn_scenes.h"
#include "sim/fields/order_statistics.h"
#include "sim/fields/quantities.h"
#include "sim/loop/shutter.h"
#include "sim/render/renderer.h"

// Rendering time of all renderers: CPU time of one thread, medians over interleaved rounds. The floor of a row is
// OSMesa's full-screen trilinear quad with the row's size and channel, no lens distortion and one sample per pixel.
// Prints one JSON object per row as soon as it is measured; scripts/bench formats the table.
//
// usage: render_bench [--quick]
//        render_bench --memory osmesa|tiles    resident memory of the city with a renderer and its first image, MiB
namespace hedgehop::sim {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  // null in JSON
constexpr int kRounds = 9, kQuickRounds = 3;

/// Required bound of the ratio of the renderers' times, or of the tiles renderer's figure.
struct Goal {
  std::string of;     ///< "ratio", "tiles", or empty without a bound
  std::string bound;  ///< "at_least", "at_most"
  double value = kNone;
};

Goal ratio_at_least(double value) { return {"ratio", "at_least", value}; }
Goal tiles_at_least(double value) { return {"tiles", "at_least", value}; }
Goal tiles_at_most(double value) { return {"tiles", "at_most", value}; }

struct Row {
  std::string scene, unit;
  double floor = kNone, osmesa = kNone, tiles = kNone;
  double ratio = kNone;  ///< of the contexts' times, OSMesa / tiles
  Goal goal;
};

void print(const Row& row) {
  nlohmann::ordered_json json = {{"scene", row.scene},   {"unit", row.unit},   {"floor", row.floor},
                                 {"osmesa", row.osmesa}, {"tiles", row.tiles}, {"ratio", row.ratio},
                                 {"goal", nullptr},      {"met", nullptr}};
  if (!row.goal.of.empty()) {
    const double figure = row.goal.of == "ratio" ? row.ratio : row.tiles;
    json["goal"] = {{"of", row.goal.of}, {row.goal.bound, row.goal.value}};
    json["met"] = row.goal.bound == "at_least" ? figure >= row.goal.value : figure <= row.goal.value;
  }
  std::cout << json.dump() << std::endl;
}

double cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + seconds(time.tv_nsec);
}

/// Images of a case, equal for each renderer.
struct Case {
  std::string name;
  Poses poses;
  Goal goal = {};
  vision::camera::Camera camera = right_angle_pinhole(400, 400);
  ImageChannel channel = ImageChannel::grey;
  int samples = 1;
  bool rolling = false;  ///< in flight, row by row
};

CameraView view_from(const Eigen::Isometry3d& X_WC, const Case& images) {
  CameraView view{.camera = images.camera, .X_WC = X_WC, .channel = images.channel, .samples = images.samples};
  view.next.X_WC = Eigen::Translation3d(0.2, 0.0, 0.0) * X_WC;
  return view;
}

/// A renderer and the images that it draws.
struct Subject {
  Renderer& renderer;
  Case images;
};

void draw(Renderer& renderer, const Eigen::Isometry3d& X_WC, const Case& images, cv::Mat& out) {
  if (!images.rolling) return renderer.draw(view_from(X_WC, images), out);
  const BodyMotion body{X_WC, {5.0, 0.0, 0.0}, {0.0, 0.2, 0.1}};
  const auto draw_rows = [&](const Eigen::Isometry3d& X_WB, double, const cv::Range& rows, cv::Mat& part) {
    renderer.draw({.camera = cut(images.camera, rows), .X_WC = X_WB}, part);
  };
  static Shutter shutter({.readout_s = 0.02});  // static: a flight keeps its buffers, too
  shutter.expose(body, 0.0, images.camera.height_px, draw_rows, out);
}

/// CPU time of one image of each subject, s, its mean over the poses.
std::vector<double> times_s(const std::vector<Subject>& subjects, int rounds) {
  std::vector<std::vector<double>> times(subjects.size());
  cv::Mat image;
  for (int round = -1; round < rounds; ++round) {  // the first round plans the lens faces
    for (size_t i = 0; i < subjects.size(); ++i) {
      const Case& images = subjects[i].images;
      const double start_s = cpu_s();
      for (const Eigen::Isometry3d& X_WC : images.poses) draw(subjects[i].renderer, X_WC, images, image);
      if (round >= 0) times[i].push_back((cpu_s() - start_s) / static_cast<double>(images.poses.size()));
    }
  }
  std::vector<double> medians_s;
  for (std::vector<double>& of_subject : times) medians_s.push_back(upper_median(of_subject));
  return medians_s;
}

Renderer make(const scenes::Scene& scene, RendererKind kind, Shadows shadows = Shadows::none) {
  return Renderer(scene, Culling::frustum_and_horizon, kind, shadows);
}

class Bench {
 public:
  explicit Bench(int rounds) : rounds_(rounds) {}

  /// Times of an image in each case.
  void compare(const scenes::Scene& scene, const std::vector<Case>& cases) {
    Renderer osmesa = make(scene, RendererKind::osmesa), tiles = make(scene, RendererKind::tiles);
    for (const Case& images : cases) {
      const auto s = times_s({{quad_, floor_of(images)}, {osmesa, images}, {tiles, images}}, rounds_);
      if (images.goal.of == "tiles") {
        print({images.name, "1/s", 1.0 / s[0], 1.0 / s[1], 1.0 / s[2], s[1] / s[2], images.goal});
      } else {
        print({images.name, "ms", 1e3 * s[0], 1e3 * s[1], 1e3 * s[2], s[1] / s[2], images.goal});
      }
    }
  }

  void shadows_over_without(const scenes::Scene& scene, const Case& images) {
    Renderer plain = make(scene, RendererKind::tiles), shaded = make(scene, RendererKind::tiles, Shadows::sun);
    const auto s = times_s({{plain, images}, {shaded, images}}, rounds_);
    print({.scene = images.name, .unit = "x", .tiles = s[1] / s[0], .goal = images.goal});
  }

  /// Times from the start to a constructed renderer, and to its first image.
  void start(const scenes::Scene& scene, const Case& images) {
    std::vector<double> made_ms[2], drawn_ms[2];
    for (int round = 0; round < rounds_; ++round) {
      for (const RendererKind kind : {RendererKind::osmesa, RendererKind::tiles}) {
        const double start_s = cpu_s();
        Renderer renderer = make(scene, kind);
        const double made_s = cpu_s();
        cv::Mat image;
        renderer.draw(view_from(images.poses.front(), images), image);
        made_ms[kind == RendererKind::tiles].push_back(1e3 * (made_s - start_s));
        drawn_ms[kind == RendererKind::tiles].push_back(1e3 * (cpu_s() - start_s));
      }
    }
    const auto row = [&](const std::string& name, auto& ms, const Goal& goal) {
      const double osmesa_ms = upper_median(ms[0]), tiles_ms = upper_median(ms[1]);
      print({name, "ms", kNone, osmesa_ms, tiles_ms, osmesa_ms / tiles_ms, goal});
    };
    row(images.name + ", renderer made", made_ms, {});
    row(images.name + ", renderer made and first image", drawn_ms, images.goal);
  }

 private:
  /// The quad with the same number of images.
  static Case floor_of(const Case& images) {
    return {.name = "quad",
            .poses = Poses(images.poses.size(), quad_view()),
            .goal = {},
            .camera = floor_camera(images.camera.width_px, images.camera.height_px),
            .channel = images.channel};
  }

  int rounds_;
  Renderer quad_ = make(full_screen_quad(), RendererKind::osmesa);
};

/// Differences between the images of the tiles renderer and OSMesa.
void differences(const scenes::Scene& scene, const Poses& poses) {
  constexpr double kFarOffLevels = 8.0;
  constexpr float kFarOffDepth = 1e-3f;
  Renderer osmesa = make(scene, RendererKind::osmesa), tiles = make(scene, RendererKind::tiles);
  double levels = 0.0, off_levels = 0.0, off_depths = 0.0, pixels = 0.0;
  cv::Mat expected, drawn, difference;
  const auto draw_both = [&](const Eigen::Isometry3d& X_WC, ImageChannel channel) {
    const CameraView view{.camera = right_angle_pinhole(400, 400), .X_WC = X_WC, .channel = channel};
    osmesa.draw(view, expected);
    tiles.draw(view, drawn);
  };
  for (const Eigen::Isometry3d& X_WC : poses) {
    draw_both(X_WC, ImageChannel::grey);
    cv::absdiff(expected, drawn, difference);
    pixels += static_cast<double>(difference.total());
    levels += cv::sum(difference)[0];
    off_levels += cv::countNonZero(difference > kFarOffLevels);
    draw_both(X_WC, ImageChannel::depth);
    for (int i = 0; i < static_cast<int>(expected.total()); ++i) {
      const float a = expected.ptr<float>()[i], b = drawn.ptr<float>()[i];
      off_depths += a == b || std::abs(a - b) <= kFarOffDepth * a ? 0.0 : 1.0;  // a == b: both infinite
    }
  }
  const std::string name = "city, street: off OSMesa, ";
  print({.scene = name + "mean", .unit = "levels", .tiles = levels / pixels, .goal = tiles_at_most(0.3)});
  print(
      {.scene = name + "over 8 levels", .unit = "share", .tiles = off_levels / pixels, .goal = tiles_at_most(0.0005)});
  print(
      {.scene = name + "depth over 1e-3", .unit = "share", .tiles = off_depths / pixels, .goal = tiles_at_most(2e-4)});
}

/// Resident memory of this process, MiB.
double resident_mib() {
  double all_pages = kNone, pages = kNone;
  std::ifstream("/proc/self/statm") >> all_pages >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576.0;
}

/// Resident memory added by a renderer to a process that has built its scene, MiB.
double renderer_mib(RendererKind kind) {
  const scenes::Scene scene = city(300.0);
  const double before_mib = resident_mib();
  Renderer renderer = make(scene, kind);
  cv::Mat image;
  renderer.draw(view_from(street_views(kFlightHeightM).front(), {}), image);
  return resident_mib() - before_mib;
}

/// The same for each renderer in a separate process.
void memory() {
  const auto mib = [](const char* renderer) {
    const std::string command = std::filesystem::read_symlink("/proc/self/exe").string() + " --memory " + renderer;
    std::FILE* const pipe = popen(command.c_str(), "r");
    double value = kNone;
    return pipe != nullptr && std::fscanf(pipe, "%lf", &value) == 1 && pclose(pipe) == 0 ? value : kNone;
  };
  const double gl_mib = mib("osmesa"), tiles_mib = mib("tiles"), ratio = gl_mib / tiles_mib;
  print({"city: memory, renderer and first image", "MiB", kNone, gl_mib, tiles_mib, ratio, ratio_at_least(1.0)});
}

void run(int rounds) {
  const vision::camera::Camera tiny = right_angle_pinhole(64, 48);
  const Poses streets = street_views(kFlightHeightM);
  const std::vector<Case> in_city = {
      {"city, street", streets, ratio_at_least(4.5)},
      {"city, five cameras in flight", five_cameras_in_flight(), ratio_at_least(4.5)},
      {.name = "city, street: color", .poses = streets, .goal = ratio_at_least(4.0), .channel = ImageChannel::color},
      {.name = "city, street: depth", .poses = streets, .goal = ratio_at_least(4.5), .channel = ImageChannel::depth},
      {.name = "city, street: labels", .poses = streets, .goal = ratio_at_least(6.0), .channel = ImageChannel::labels},
      {.name = "city, street: flow", .poses = streets, .goal = ratio_at_least(4.0), .channel = ImageChannel::flow},
      {.name = "city, street: 4 samples", .poses = streets, .goal = ratio_at_least(6.0), .samples = 4},
      {"city, street: distorted pinhole", streets, ratio_at_least(2.5), distorted_pinhole()},
      {"city, street: fisheye, 190 degrees, 752 x 480", streets, ratio_at_least(2.5), wide_fisheye()},
      {.name = "city, street: rolling shutter", .poses = streets, .goal = ratio_at_least(3.0), .rolling = true},
      {"city, street: 64 x 48", streets, tiles_at_least(20'000.0), tiny},
  };
  const std::vector<Case> in_room = {{"room", room_views(), ratio_at_least(4.5)}};
  const std::vector<Case> in_large_city = {
      {"3 km city, street", streets, ratio_at_least(4.5)},
      {"3 km city, from 60 m", street_views(60.0), ratio_at_least(3.5)},
      {"3 km city, street: 64 x 48", streets, tiles_at_least(5'000.0), tiny},
  };
  const std::vector<Case> in_forest = {{"forest of 100, from 5 m", forest_views(5.0)}};
  const std::vector<Case> in_large_forest = {
      {"forest of 10,000, from 5 m", forest_views(5.0), ratio_at_least(4.0)},
      {"forest of 10,000, from 1.8 m", forest_views(1.8), ratio_at_least(4.0)},
      {"forest of 10,000, from 25 m", forest_views(25.0), ratio_at_least(4.0)},
  };

  const scenes::Scene small_city = city(300.0);
  Bench bench(rounds);
  memory();
  bench.start(small_city, {"city: start", streets, tiles_at_most(200.0)});
  bench.compare(small_city, in_city);
  bench.shadows_over_without(small_city, {"city, street: shadows over without", streets, tiles_at_most(1.4)});
  differences(small_city, streets);
  bench.compare(room(), in_room);
  bench.compare(city(3000.0), in_large_city);
  bench.compare(forest(100), in_forest);
  bench.compare(forest(10'000), in_large_forest);
}

}  // namespace
}  // namespace hedgehop::sim

int main(int argc, char** argv) {
  using namespace hedgehop::sim;
  cv::setNumThreads(1);
  if (argc > 2 && std::string_view(argv[1]) == "--memory") {
    std::cout << renderer_mib(std::string_view(argv[2]) == "tiles" ? RendererKind::tiles : RendererKind::osmesa);
    return 0;
  }
  run(argc > 1 && std::string_view(argv[1]) == "--quick" ? kQuickRounds : kRounds);
}
