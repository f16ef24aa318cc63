#include "sim/cli/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>

namespace hedgehop::sim::cli {
namespace {

/// Writes to standard error and ignores write errors (a full disk), which must not stop the command.
void write(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

/// Returns the number of characters that fit on a line of the terminal; unlimited if the width is unknown.
size_t columns() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 2) return std::string::npos;
  return size.ws_col - 1u;
}

}  // namespace

StatusLine::StatusLine() : terminal_(isatty(STDERR_FILENO) == 1) {}

void StatusLine::show(const std::string& line) const {
  if (terminal_) {
    write("\r\033[K" + line.substr(0, columns()));
  } else {
    write(line + "\n");
  }
}

void StatusLine::keep(const std::string& line) const {
  close();
  write(line + "\n");
}

void StatusLine::close() const {
  if (terminal_) write("\r\033[K");
}

FlightProgress::FlightProgress(std::string name) : name_(std::move(name)), start_(Clock::now()) {}

void FlightProgress::show(double t_s, double duration_s, double goal_distance_m) {
  const int tenths = static_cast<int>(10.0 * t_s / duration_s);
  if (!line_.terminal() && tenths <= tenths_shown_) return;
  tenths_shown_ = tenths;
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
  const std::string left =
      t_s > 0.0 ? fmt::format(", at most {} left", duration_words(elapsed_s / t_s * (duration_s - t_s))) : "";
  const std::string goal = std::isnan(goal_distance_m) ? "" : fmt::format(", {:.0f} m to go", goal_distance_m);
  line_.show(fmt::format("{}: {:.0f} of {:.0f} s{}{}", name_, t_s, duration_s, left, goal));
}

CampaignProgress::CampaignProgress(size_t flights) : start_(Clock::now()), flights_(flights) {}

void CampaignProgress::add(const std::string& name, const std::string& words, bool passed, bool reused) {
  ++ended_;
  flown_ += reused ? 0 : 1;
  failed_ += passed ? 0 : 1;
  const std::string counts =
      fmt::format("{}/{}{}", ended_, flights_, failed_ > 0 ? fmt::format(", {} failed", failed_) : std::string());
  if (line_.terminal()) {
    if (!passed) line_.keep(fmt::format("{}: {}", name, words));
    line_.show(fmt::format("{} flights{}", counts, left_words()));
    return;
  }
  constexpr size_t kMaxLines = 100;
  const size_t every = std::max<size_t>(1, flights_ / kMaxLines);
  if (passed && (reused || ended_ % every != 0) && ended_ != flights_) return;
  line_.show(fmt::format("{}: {} {}{}{}", counts, name, words, reused ? " (earlier)" : "", left_words()));
}

void CampaignProgress::close() const {
  line_.close();
  if (flown_ == 0) return;
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
  line_.keep(fmt::format("{}/{}, {} flown in {}", ended_, flights_, flown_, duration_words(elapsed_s)));
}

std::string CampaignProgress::left_words() const {
  if (flown_ == 0 || ended_ == flights_) return "";
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
  const double left_s = elapsed_s / static_cast<double>(flown_) * static_cast<double>(flights_ - ended_);
  return fmt::format("; about {} left", duration_words(left_s));
}

std::string duration_words(double seconds) {
  if (seconds < 59.5) return fmt::format("{:.0f} s", seconds);
  const auto minutes = static_cast<int64_t>(std::llround(seconds / 60.0));
  if (minutes < 60) return fmt::format("{} min", minutes);
  return fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

}  // namespace hedgehop::sim::cli
