#include "sim/simulation/simulation.h"

#include <fmt/format.h>

#include <opencv2/core/utility.hpp>
#include <string>
#include <utility>

#include "sim/loop/episode.h"
#include "sim/simulation/map_judge.h"
#include "sim/verdict/assessment.h"

namespace hedgehop::sim {

Flight fly(const Scenario& scenario, FlightParts parts, FlightWatcher* watcher) {
  cv::setNumThreads(1);  // flights are the unit of parallelism
  MapJudge judge;
  Episode episode(scenario, std::move(parts), watcher, &judge);
  Flight flight = episode.fly();
  judge.conclude(flight);
  assess(scenario, *flight.scene, episode.hull(), flight);
  return flight;
}

Flight fly(const Scenario& scenario, FlightWatcher* watcher) { return fly(scenario, build_parts(scenario), watcher); }

cv::Mat image_at(const Scenario& scenario, FlightParts parts, std::string_view role, Channel channel, double t_s) {
  cv::setNumThreads(1);
  if (!scenario.rig.find(role)) {
    std::string roles;
    for (const CameraConfig& camera : scenario.rig.cameras) roles += (roles.empty() ? "" : ", ") + camera.role;
    throw InputError(fmt::format("the rig has no camera '{}'; its cameras: {}", role, roles));
  }
  return Episode(scenario, std::move(parts)).image(role, channel, t_s);
}

cv::Mat image_at(const Scenario& scenario, std::string_view role, Channel channel, double t_s) {
  return image_at(scenario, build_parts(scenario), role, channel, t_s);
}

}  // namespace hedgehop::sim
