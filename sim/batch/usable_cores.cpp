#include "sim/batch/usable_cores.h"

#include <sched.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

namespace hedgehop::sim {
namespace {

namespace fs = std::filesystem;

std::string first_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

/// Returns the cores of "QUOTA PERIOD", both in microseconds; none for "max" and -1.
std::optional<double> cores_of(const std::string& text) {
  std::istringstream words(text);
  double quota_us = 0.0, period_us = 0.0;
  if (!(words >> quota_us >> period_us) || quota_us <= 0.0 || period_us <= 0.0) return {};
  return quota_us / period_us;
}

std::optional<double> quota_of(const fs::path& group, bool first_version) {
  if (!first_version) return cores_of(first_line(group / "cpu.max"));
  return cores_of(first_line(group / "cpu.cfs_quota_us") + " " + first_line(group / "cpu.cfs_period_us"));
}

bool lists(const std::string& controllers, const std::string& name) {
  return ("," + controllers + ",").find("," + name + ",") != std::string::npos;
}

}  // namespace

std::optional<double> cpu_quota(const fs::path& root) {
  std::optional<double> smallest;
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool first_version = !controllers.empty();
    if (first_version && !lists(controllers, "cpu")) continue;
    const fs::path top = root / "sys/fs/cgroup" / (first_version ? "cpu" : "");
    // In a container the path may be that of the host; then only the top has files.
    fs::path path = fs::path(line.substr(second + 1)).relative_path();
    for (bool more = true; more; path = path.parent_path()) {
      more = !path.empty();
      if (const auto quota = quota_of(top / path, first_version))
        smallest = std::min(smallest.value_or(*quota), *quota);
    }
  }
  return smallest;
}

size_t usable_cores() {
  size_t cores = std::max(1u, std::thread::hardware_concurrency());
  std::array<cpu_set_t, 16> set{};  // 16384 cores
  if (::sched_getaffinity(0, sizeof(set), set.data()) == 0) {
    cores = std::max<size_t>(1, static_cast<size_t>(CPU_COUNT_S(sizeof(set), set.data())));
  }
  if (const auto quota = cpu_quota()) cores = std::min(cores, static_cast<size_t>(std::max(1.0, std::ceil(*quota))));
  return cores;
}

}  // namespace hedgehop::sim
