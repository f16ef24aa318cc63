#include <fmt/format.h>

#include <opencv2/core.hpp>
#include <utility>

#include "sim/cli/commands.h"
#include "sim/config/whole_file.h"
#include "sim/record/image_file.h"
#include "sim/render/image_colors.h"
#include "sim/render/renderer.h"
#include "sim/simulation/simulation.h"

namespace hedgehop::sim::cli {
namespace {

ImageChannel channel_of(const std::string& what) {
  if (what == "grey") return ImageChannel::grey;
  if (what == "flow") return ImageChannel::flow;
  if (what == "labels") return ImageChannel::labels;
  return what == "color" ? ImageChannel::color : ImageChannel::depth;
}

/// Prints one line for each renderer: its version, or why this machine cannot use it.
/// @param only  name of the one renderer to print; empty: all.
void print_renderers(const std::string& only) {
  for (size_t i = 0; i < kRendererNames.size(); ++i) {
    const auto kind = static_cast<RendererKind>(i);
    if (!only.empty() && only != kRendererNames[i]) continue;
    const bool is_default = kind == DrawingConfig().renderer;
    try {
      fmt::print("{}: {}{}\n", kRendererNames[i], Renderer(scenes::Scene{}, Culling::none, kind).info(),
                 only.empty() && is_default ? "  (the default)" : "");
    } catch (const std::runtime_error& fault) {
      if (!only.empty() || is_default) throw;
      fmt::print("{}: not available: {}\n", kRendererNames[i], fault.what());
    }
  }
}

cv::Mat image_at(Simulation& simulation, const RenderOptions& options, ImageChannel channel) {
  simulation.camera(options.camera);  // told before flying
  simulation.fly_to(options.time_s);
  if (channel == ImageChannel::flow) return simulation.flow_to_next_image(options.camera);
  return simulation.image(options.camera, channel);
}

}  // namespace

int render(const RenderOptions& options) {
  if (options.info) {
    print_renderers(options.scenario.renderer);
    return 0;
  }
  if (options.out.extension() != ".png") {
    throw InputError(fmt::format("-o {}: the image is a PNG; its name must end in .png", options.out.string()));
  }
  require_writable_file(options.out);
  const ImageChannel channel = channel_of(options.what);
  Simulation simulation(load(options.scenario));
  print_black_pixels(simulation.scenario().rig);
  cv::Mat image = image_at(simulation, options, channel);
  if (options.what == "depth_mm") {
    image = depth_mm(image);
  } else if (channel == ImageChannel::depth) {
    image = colored_depth(image);
  } else if (channel == ImageChannel::flow) {
    image = colored_flow(image);
  } else if (channel == ImageChannel::labels) {
    image = colored_labels(image);
  }
  if (options.out.has_parent_path()) std::filesystem::create_directories(options.out.parent_path());
  write_png(options.out, image);
  fmt::print("written: {}\n", options.out.string());
  return 0;
}

}  // namespace hedgehop::sim::cli
