// Flies scenarios again and again in one process, for scripts/soak:
//   hedgehop_soak MINUTES RENDERER SCENARIO...
// RENDERER: as of `--renderer`. Each flight must have the hash of its first round, memory and open files those of the
// third round. Prints a line a round; exit status 1 if something differs.
#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "sim/simulation/simulation.h"

namespace {

using namespace hedgehop::sim;

/// Returns the resident memory without the free memory of the allocator, MB.
double memory_mb() {
  malloc_trim(0);
  std::ifstream statm("/proc/self/statm");
  double size = 0.0, resident = 0.0;
  statm >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

long open_files() {
  const std::filesystem::directory_iterator files("/proc/self/fd");
  return std::distance(begin(files), end(files));
}

std::string fly(const std::string& file, const std::string& renderer) {
  const std::vector<std::string> overrides = {"duration=0.3", "checks=[]", "failures=[]", "film.enabled=false",
                                              "drawing.renderer=" + renderer};
  return Simulation(load_flight(file, overrides, 1101)).run().result.trajectory_hash;
}

}  // namespace

int main(int argc, char** argv) {
  const auto begun = std::chrono::steady_clock::now();
  const double minutes = argc > 1 ? std::atof(argv[1]) : 0.0;
  const std::string renderer = argc > 2 ? argv[2] : "tiles";
  const auto is_over = [&] { return std::chrono::steady_clock::now() - begun > minutes * std::chrono::minutes(1); };
  constexpr int kSettled = 3;  // rounds until all caches are filled
  constexpr double kFlat = 0.01;
  std::map<std::string, std::string> first;
  double settled_mb = 0.0;
  long settled_files = 0, flights = 0;
  int faults = 0;
  for (int round = 1; round <= kSettled || !is_over(); ++round) {
    for (int i = 3; i < argc; ++i) {
      const std::string hash = fly(argv[i], renderer), &expected = first.try_emplace(argv[i], hash).first->second;
      ++flights;
      if (hash == expected) continue;
      ++faults;
      fmt::print("round {}: {}: {} instead of {}\n", round, argv[i], hash, expected);
    }
    const double now_mb = memory_mb();
    const long files = open_files();
    if (round == kSettled) settled_mb = now_mb, settled_files = files;
    fmt::print("round {}: {} flights, {:.2f} MB, {} open files\n", round, flights, now_mb, files);
    std::fflush(stdout);
    if (round > kSettled && (now_mb > (1.0 + kFlat) * settled_mb || files > settled_files)) {
      ++faults;
      fmt::print("round {}: more than the {:.1f} MB and {} open files of round {}\n", round, settled_mb, settled_files,
                 kSettled);
    }
  }
  fmt::print("{} flights, {} faults\n", flights, faults);
  return faults == 0 ? 0 : 1;
}
