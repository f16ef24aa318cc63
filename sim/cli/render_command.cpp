#include <fmt/format.h>

#include <opencv2/core.hpp>
#include <utility>

#include "sim/batch/folders.h"
#include "sim/cli/commands.h"
#include "sim/config/whole_file.h"
#include "sim/record/image_file.h"
#include "sim/record/labels_file.h"
#include "sim/render/image_colors.h"
#include "sim/render/renderer.h"
#include "sim/simulation/simulation.h"

namespace hedgehop::sim::cli {
namespace {

ImageChannel channel_of(const std::string& what) {
  if (what == "grey") return ImageChannel::grey;
  if (what == "flow") return ImageChannel::flow;
  if (what == "labels" || what == "label_colors") return ImageChannel::labels;
  if (what == "semantic") return ImageChannel::semantic;
  return what == "color" ? ImageChannel::color : ImageChannel::depth;
}

/// Prints one line for each renderer: its version, or why this machine cannot use it.
/// @param only  name of the one renderer to print, which must be available; empty: all.
void print_renderers(const std::string& only) {
  for (size_t i = 0; i < kRendererNames.size(); ++i) {
    const auto kind = static_cast<RendererKind>(i);
    if (!only.empty() && only != kRendererNames[i]) continue;
    const std::string_view mark = only.empty() && kind == DrawingConfig().renderer ? "  (the default)" : "";
    try {
      fmt::print("{}{}\n", Renderer(scenes::Scene{}, Culling::none, kind).info(), mark);
    } catch (const InputError& fault) {
      if (!only.empty()) throw;
      fmt::print("{}{}\n", fault.what(), mark);
    }
  }
}

cv::Mat image_at(Simulation& simulation, const RenderOptions& options, ImageChannel channel) {
  simulation.camera(options.camera);  // told before flying
  simulation.fly_to(options.time_s);
  if (channel == ImageChannel::flow) return simulation.flow_to_next_image(options.camera);
  return simulation.image(options.camera, channel);
}

/// Returns an image in the form of its file.
cv::Mat file_image(const std::string& what, const cv::Mat& image) {
  if (what == "depth") return colored_depth(image);
  if (what == "depth_mm") return depth_mm(image);
  if (what == "flow") return colored_flow(image);
  if (what == "label_colors") return colored_labels(image);
  return what == "labels" || what == "semantic" ? labels_16bit(image) : image;
}

}  // namespace

int render(const RenderOptions& options) {
  if (options.info) {
    print_renderers(options.scenario.renderer);
    return 0;
  }
  const bool tiff = options.what == "depth_m";
  const char* const ending = tiff ? ".tiff" : ".png";
  if (options.out.extension() != ending) {
    throw InputError(fmt::format("-o {}: the image is a {}; its name must end in {}", options.out.string(),
                                 tiff ? "TIFF" : "PNG", ending));
  }
  require_writable_file(options.out);
  LoadedScenario loaded = load(options.scenario);
  print_black_pixels(loaded.scenario.rig);
  print_remarks(loaded.parts);
  Simulation simulation(std::move(loaded));
  const cv::Mat image = file_image(options.what, image_at(simulation, options, channel_of(options.what)));
  const std::filesystem::path folder = options.out.parent_path();
  create_folders(folder);
  tiff ? write_tiff(options.out, image) : write_png(options.out, image);
  fmt::print("written: {}\n", options.out.string());
  if (options.what == "labels" || options.what == "semantic") {
    write_file_whole(folder / "labels.json", labels_json(simulation.scene()));
    fmt::print("written: {}\n", (folder / "labels.json").string());
  }
  return 0;
}

}  // namespace hedgehop::sim::cli
