#pragma once

#include <chrono>
#include <string>

namespace hedgehop::sim::cli {

/// A line on standard error. It is redrawn on a terminal; otherwise each update is a new line.
class StatusLine {
 public:
  StatusLine();
  bool terminal() const { return terminal_; }
  /// Redraws the line, cut to the width of the terminal. Without a terminal, adds it as a new line.
  void show(const std::string& line) const;
  /// Adds a permanent line.
  void keep(const std::string& line) const;
  /// Clears the line on the terminal.
  void close() const;

 private:
  bool terminal_;
};

/// Progress of one flight with the remaining time. On a terminal the line is redrawn; otherwise a line is printed after
/// every tenth of the duration.
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

/// Progress of many flights with the remaining time. On a terminal the line is redrawn and only failures remain
/// visible; otherwise a line is printed for each flight, or for each hundredth part if there are very many.
class CampaignProgress {
 public:
  using Clock = std::chrono::steady_clock;

  explicit CampaignProgress(size_t flights);
  /// Adds an ended flight. @param words  its outcome, one line. @param reused  whether an earlier result was reused.
  void add(const std::string& name, const std::string& words, bool passed, bool reused);
  /// Prints the number of flights that were flown and their wall time.
  void close() const;

 private:
  std::string left_words() const;

  StatusLine line_;
  Clock::time_point start_;
  size_t flights_, ended_ = 0, flown_ = 0, failed_ = 0;
};

/// Returns a duration as text: "40 s", "12 min", "3 h 5 min".
std::string duration_words(double seconds);

}  // namespace hedgehop::sim::cli
