#include "sim/batch/worker_pool.h"

#include <poll.h>

#include <algorithm>
#include <cmath>
#include <list>
#include <system_error>

namespace hedgehop::sim {
namespace {

struct Running {
  size_t job;
  Worker worker;
};

double left_s(const Worker& worker, double limit_s) {
  return limit_s - std::chrono::duration<double>(Worker::Clock::now() - worker.started()).count();
}

/// Waits until something happens to a worker, its time is over, or a signal comes.
void wait(const std::list<Running>& running, double limit_s, const Interruption& interruption) {
  std::vector<pollfd> watched{{.fd = interruption.descriptor(), .events = POLLIN, .revents = 0}};
  double timeout_s = -1.0;
  for (const Running& r : running) {
    watched.push_back({.fd = r.worker.process_descriptor(), .events = POLLIN, .revents = 0});
    watched.push_back({.fd = r.worker.error_descriptor(), .events = POLLIN, .revents = 0});  // poll skips a -1
    if (limit_s <= 0.0 || r.worker.killed()) continue;
    const double left = std::max(0.0, left_s(r.worker, limit_s));
    timeout_s = timeout_s < 0.0 ? left : std::min(timeout_s, left);
  }
  constexpr double kLongestS = 1e6;  // what poll's int holds in ms
  const int timeout_ms = timeout_s < 0.0 ? -1 : static_cast<int>(std::ceil(1e3 * std::min(timeout_s, kLongestS)));
  ::poll(watched.data(), watched.size(), timeout_ms);
}

bool has_ended(const Worker& worker) {
  pollfd watched{.fd = worker.process_descriptor(), .events = POLLIN, .revents = 0};
  return ::poll(&watched, 1, 0) == 1;
}

}  // namespace

bool WorkerPool::run(size_t jobs, const std::function<std::vector<std::string>(size_t)>& command,
                     Interruption& interruption, const std::function<void(size_t, const WorkerEnd&)>& ended) const {
  std::list<Running> running;
  size_t next = 0;
  while (next < jobs || !running.empty()) {
    const bool stop = interruption.came();
    if (stop) {
      for (Running& r : running) r.worker.kill(WorkerEnd::Kind::stopped);
      next = jobs;
    }
    while (next < jobs && running.size() < workers) {
      const size_t job = next++;
      if (wanted && !wanted(job)) continue;
      try {
        running.push_back({job, Worker(command(job), interruption.mask_before())});
      } catch (const std::system_error& error) {
        ended(job, {.kind = WorkerEnd::Kind::unstarted, .last_line = error.what()});
      }
    }
    if (running.empty()) continue;
    if (!stop) wait(running, limit_s, interruption);
    for (auto r = running.begin(); r != running.end();) {
      r->worker.take_errors();
      if (limit_s > 0.0 && left_s(r->worker, limit_s) <= 0.0) r->worker.kill(WorkerEnd::Kind::overdue);
      if (!stop && !has_ended(r->worker)) {
        ++r;
        continue;
      }
      ended(r->job, r->worker.join());
      r = running.erase(r);
    }
    for (Running& r : running) {
      if (wanted && !wanted(r.job)) r.worker.kill(WorkerEnd::Kind::stopped);
    }
  }
  return !interruption.came();
}

}  // namespace hedgehop::sim
