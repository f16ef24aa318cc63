#include "sim/cli/live_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "sim/cli/exit_status.h"
#include "sim/config/utf8.h"
#include "sim/flight/json_reader.h"
#include "sim/flight/result_io.h"
#include "sim/pages/replay.h"
#include "sim/pages/replay_images.h"
#include "sim/pages/report_page.h"
#include "sim/record/image_file.h"

namespace hedgehop::sim::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kViewerWaitS = 10.0;  // so that scripts do not hang without a browser
constexpr auto kBetweenImages = std::chrono::milliseconds(100);
constexpr int kViewQuality = 75, kModuleWidthPx = 640;

Json state_json(const Simulation& simulation, const std::string& status) {
  const TrueMotion motion = simulation.truth();
  const Eigen::Quaterniond& q = motion.q_WB;
  const double roll = std::atan2(2.0 * (q.w() * q.x() + q.y() * q.z()), 1.0 - 2.0 * (q.x() * q.x() + q.y() * q.y()));
  const double pitch = std::asin(std::clamp(2.0 * (q.w() * q.y() - q.z() * q.x()), -1.0, 1.0));
  const double yaw = std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()), 1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
  return {milli(simulation.t_s()),
          milli(motion.p_WB.x()),
          milli(motion.p_WB.y()),
          milli(motion.p_WB.z()),
          milli(roll),
          milli(pitch),
          milli(yaw),
          milli(simulation.proximity().obstacle_clearance_m),
          milli(motion.v_WB_W.norm()),
          status};
}

std::string event_json(const Json& json) { return json_text(json); }

std::string jpeg_base64(const cv::Mat& rgb) { return rgb.empty() ? "" : base64(jpeg_of(rgb, kViewQuality)); }

}  // namespace

LiveView::LiveView(const Simulation& simulation) : server_(live_page(simulation.scenario(), simulation.scene())) {
  notice(fmt::format("view: {}   (the flight begins when a browser opens it, after {:.0f} s at the latest)\n",
                     server_.url(), kViewerWaitS));
  if (!server_.wait_for_viewer(kViewerWaitS)) notice("view: no browser; the flight begins\n");
  pace_.begin(simulation.t_s());
}

void LiveView::show(Simulation& simulation, const std::string& status, const cv::Mat& module_image) {
  states_ += (states_.empty() ? "[" : ",") + event_json(state_json(simulation, status));
  keep_pace(simulation.t_s());
  const auto now = Clock::now();
  if (now >= sent_ + kBetweenImages || simulation.over() || server_.is_paused()) {
    sent_ = now;
    server_.send("states", states_ + "]");
    states_.clear();
    if (server_.has_viewer()) {
      cv::Mat smaller = module_image;
      if (module_image.cols > kModuleWidthPx) {
        const double scale = static_cast<double>(kModuleWidthPx) / module_image.cols;
        cv::resize(module_image, smaller, {}, scale, scale, cv::INTER_AREA);
      }
      server_.send_latest("images", event_json({{"sheet", jpeg_base64(camera_sheet(simulation, nullptr))},
                                                {"film", jpeg_base64(smaller)}}));
    }
  }
  server_.wait_while_paused();
}

void LiveView::keep_pace(double t_s) {
  if (server_.has_viewer() && !server_.is_paused()) {
    pace_.keep(t_s);
  } else {
    pace_.begin(t_s);
  }
}

void LiveView::end(const RunInfo& info, const FlightResult& result) {
  server_.send("end", event_json(to_json(info, result)));
}

}  // namespace hedgehop::sim::cli
