#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

namespace hedgehop::sim {

/// Returns the number of cores that this process may use, >= 1: those of its affinity (taskset, Slurm), but no more
/// than its CPU quota (docker --cpus, Kubernetes), rounded up.
size_t usable_cores();

/// Returns the smallest CPU quota, in cores, of the control group of this process and of the groups around it; none
/// without a quota. Reads versions 1 and 2. @param root  folder that holds `proc` and `sys`; another one in tests.
std::optional<double> cpu_quota(const std::filesystem::path& root = "/");

}  // namespace hedgehop::sim
