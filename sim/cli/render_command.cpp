#include <fmt/format.h>

#include <opencv2/core.hpp>
#include <utility>

#include "sim/cli/commands.h"
#include "sim/cli/load.h"
#include "sim/record/image_file.h"
#include "sim/record/whole_file.h"
#include "sim/render/image_colors.h"
#include "sim/render/renderer.h"
#include "sim/simulation/simulation.h"

namespace hedgehop::sim::cli {
namespace {

Channel channel_of(const std::string& what) {
  if (what == "grey") return Channel::grey;
  if (what == "flow") return Channel::flow;
  if (what == "labels") return Channel::labels;
  return what == "color" ? Channel::color : Channel::depth;
}

/// Who would draw, and who else can: one line each.
void print_contexts(const std::string& asked) {
  struct Kind {
    const char* name;
    DrawingConfig::Context context;
    ContextKind drawn_by;
  };
  using Context = DrawingConfig::Context;
  for (const Kind& kind :
       {Kind{"osmesa", Context::osmesa, ContextKind::osmesa}, Kind{"egl", Context::egl, ContextKind::egl},
        Kind{"tiles", Context::tiles, ContextKind::tiles}}) {
    const bool chosen = asked.empty() ? kind.context == DrawingConfig::usual_context() : asked == kind.name;
    if (!asked.empty() && !chosen) continue;
    const char* const mark = asked.empty() && chosen ? "  (used unless a scenario or --gl says otherwise)" : "";
    try {
      fmt::print("{}: {}{}\n", kind.name, Renderer(scenes::Scene{}, Culling::none, kind.drawn_by).info(), mark);
    } catch (const std::runtime_error& fault) {
      if (chosen) throw;
      fmt::print("{}: no: {}\n", kind.name, fault.what());
    }
  }
}

cv::Mat image_at(Simulation& simulation, const RenderOptions& options, Channel channel) {
  simulation.camera(options.camera);  // told before flying
  simulation.fly_to(options.time_s);
  if (channel == Channel::flow) return simulation.flow_to_next_image(options.camera);
  return simulation.image(options.camera, channel);
}

}  // namespace

int render(const RenderOptions& options) {
  if (options.info) {
    print_contexts(options.scenario.gl);
    return 0;
  }
  if (options.out.extension() != ".png") {
    throw InputError(fmt::format("-o {}: the image is a PNG; its name must end in .png", options.out.string()));
  }
  require_writable_file(options.out);
  const Channel channel = channel_of(options.what);
  Simulation simulation(load(options.scenario));
  cv::Mat image = image_at(simulation, options, channel);
  if (options.what == "depth_mm") {
    image = depth_mm(image);
  } else if (channel == Channel::depth) {
    image = colored_depth(image);
  } else if (channel == Channel::flow) {
    image = colored_flow(image);
  } else if (channel == Channel::labels) {
    image = colored_labels(image);
  }
  if (options.out.has_parent_path()) std::filesystem::create_directories(options.out.parent_path());
  write_png(options.out, image);
  fmt::print("written: {}\n", options.out.string());
  return 0;
}

}  // namespace hedgehop::sim::cli
