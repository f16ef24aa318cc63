#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace hedgehop::sim::cli {

/// Serves one page and its server-sent events on the loopback interface, in a thread of its own. Browsers send the
/// orders `pause`, `play` and `step`. The flight waits for orders only in wait_while_paused().
class ViewServer {
 public:
  /// Listens on a free port of 127.0.0.1. Throws std::runtime_error with the cause.
  explicit ViewServer(std::string page);
  /// Ends after the viewers have received all events, 2 s later at the latest.
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  std::string url() const;
  /// Returns whether a browser has requested the events within `limit_s`.
  bool wait_for_viewer(double limit_s);
  bool has_viewer();
  bool is_paused();

  /// Sends an event to all viewers; later viewers receive it, too. @param data_json  one line.
  void send(const std::string& name, const std::string& data_json);
  /// Sends an event that replaces the last one of this kind.
  void send_latest(const std::string& name, const std::string& data_json);
  /// Returns at once unless a viewer has paused; then waits for `play` or `step`.
  void wait_while_paused();

 private:
  struct Client {
    int socket = -1;
    std::string input, output;
    bool streams = false, closes = false;
    size_t sent_events = 0;
    uint64_t sent_latest = 0;
  };
  void serve();
  void read_from(Client& client);
  void answer(Client& client);
  /// Appends the events that the client lacks to its output. The caller holds the mutex.
  void feed(Client& client);
  void order(const std::string& word);
  void wake() const;
  bool all_sent() const;

  const std::string page_;
  int listener_ = -1, wake_ = -1, port_ = 0;
  std::vector<Client> clients_;  ///< of the thread

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> events_;
  std::string latest_;
  uint64_t latest_number_ = 0;
  int viewers_ = 0;
  bool paused_ = false, ends_ = false;
  int steps_ = 0;  ///< allowed while paused
  std::thread thread_;
};

}  // namespace hedgehop::sim::cli
