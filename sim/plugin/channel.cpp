#include "sim/plugin/channel.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace hedgehop::sim {
namespace {

/// Returns the time left, ms, rounded up; -1: without a limit.
int left_ms(std::optional<Channel::Clock::time_point> until) {
  if (!until) return -1;
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(*until - Channel::Clock::now()).count();
  return static_cast<int>(std::clamp<decltype(left)>(left, 0, 3'600'000));
}

}  // namespace

void Channel::close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

Channel::Outcome Channel::send(const std::string& message, std::optional<Clock::time_point> until) {
  if (message.size() > kMaxMessageBytes) return Outcome::oversized;
  std::string framed(sizeof(size_t), '\0');
  const size_t count = message.size();
  std::memcpy(framed.data(), &count, sizeof count);
  framed += message;
  return transfer(framed.data(), framed.size(), false, until);
}

Channel::Outcome Channel::receive(std::string& message, std::optional<Clock::time_point> until) {
  std::array<char, sizeof(size_t)> head{};
  if (const Outcome outcome = transfer(head.data(), head.size(), true, until); outcome != Outcome::done) return outcome;
  size_t count = 0;
  std::memcpy(&count, head.data(), sizeof count);
  if (count > kMaxMessageBytes) return Outcome::oversized;
  message.resize(count);
  return transfer(message.data(), count, true, until);
}

Channel::Outcome Channel::transfer(char* bytes, size_t count, bool receives,
                                   std::optional<Clock::time_point> until) const {
  while (count > 0) {
    pollfd ready{.fd = socket_, .events = static_cast<short>(receives ? POLLIN : POLLOUT), .revents = 0};
    const int found = ::poll(&ready, 1, left_ms(until));
    if (found == 0 && until && Clock::now() >= *until) return Outcome::overdue;
    if (found <= 0) {
      if (found < 0 && errno != EINTR) return Outcome::ended;
      continue;
    }
    const ssize_t moved = receives ? ::recv(socket_, bytes, count, MSG_DONTWAIT)
                                   : ::send(socket_, bytes, count, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (moved == 0 || (moved < 0 && errno != EINTR && errno != EAGAIN)) return Outcome::ended;
    if (moved < 0) continue;
    bytes += moved;
    count -= static_cast<size_t>(moved);
  }
  return Outcome::done;
}

}  // namespace hedgehop::sim
