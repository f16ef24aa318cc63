#pragma once

#include <chrono>
#include <string>

namespace hedgehop::sim::cli {

/// A line on standard error that is redrawn where it is a terminal; elsewhere lines follow each other.
class StatusLine {
 public:
  StatusLine();
  bool terminal() const { return terminal_; }
  /// Redraws the line, as much of it as the terminal is wide, or, where there is no terminal, adds it.
  void show(const std::string& line) const;
  /// Adds a line that stays.
  void keep(const std::string& line) const;
  /// Clears the terminal's line.
  void close() const;

 private:
  bool terminal_;
};

/// Progress of one flight, with the time left: redrawn on a terminal, else a plain line every tenth of its duration.
class FlightProgress {
 public:
  using Clock = std::chrono::steady_clock;

  explicit FlightProgress(std::string name);
  /// @param goal_distance_m  NaN without a goal.
  void show(double t_s, double duration_s, double goal_distance_m);
  void close() const { line_.close(); }

 private:
  std::string name_;
  StatusLine line_;
  Clock::time_point start_;
  int tenths_shown_ = 0;
};

/// Progress of many flights, with the time left: redrawn on a terminal, where only failures stay; else a plain line for
/// each flight, or for each hundredth of very many.
class CampaignProgress {
 public:
  using Clock = std::chrono::steady_clock;

  explicit CampaignProgress(size_t flights);
  /// A flight has ended. @param words  how, one line. @param reused  an earlier result stands, which took no time.
  void add(const std::string& name, const std::string& words, bool passed, bool reused);
  void close() const { line_.close(); }

 private:
  std::string left_words() const;

  StatusLine line_;
  Clock::time_point start_;
  size_t flights_, ended_ = 0, flown_ = 0, failed_ = 0;
};

/// "40 s", "12 min", "3 h 5 min".
std::string duration_words(double seconds);

}  // namespace hedgehop::sim::cli
