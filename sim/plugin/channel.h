#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

namespace hedgehop::sim {

/// One end of a socket that carries whole messages.
class Channel {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param socket  of a stream; closed with this.
  explicit Channel(int socket) : socket_(socket) {}
  ~Channel() { close(); }
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;
  int descriptor() const { return socket_; }
  void close();

  enum class Outcome { done, ended, overdue, oversized };
  /// Sends a message. @param until  when to give up; std::nullopt: never.
  Outcome send(const std::string& message, std::optional<Clock::time_point> until = {});
  /// Receives the next message.
  Outcome receive(std::string& message, std::optional<Clock::time_point> until = {});

 private:
  Outcome after(ssize_t moved, short events, std::optional<Clock::time_point> until) const;

  int socket_;
  std::string received_;  ///< of the next messages
};

/// Maximum size of a message.
inline constexpr size_t kMaxMessageBytes = size_t{256} << 20;

}  // namespace hedgehop::sim
