#include "sim/plugin/channel.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

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
  std::string_view rest = framed;
  while (!rest.empty()) {
    const ssize_t sent = ::send(socket_, rest.data(), rest.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent > 0) rest.remove_prefix(static_cast<size_t>(sent));
    if (const Outcome outcome = after(sent, POLLOUT, until); outcome != Outcome::done) return outcome;
  }
  return Outcome::done;
}

Channel::Outcome Channel::receive(std::string& message, std::optional<Clock::time_point> until) {
  size_t count = 0;
  constexpr size_t kHead = sizeof count;
  for (;;) {
    if (received_.size() >= kHead) {
      std::memcpy(&count, received_.data(), kHead);
      if (count > kMaxMessageBytes) return Outcome::oversized;
      if (received_.size() - kHead >= count) break;
    }
    std::array<char, 1 << 16> piece;
    const ssize_t got = ::recv(socket_, piece.data(), piece.size(), MSG_DONTWAIT);
    if (got > 0) received_.append(piece.data(), static_cast<size_t>(got));
    if (const Outcome outcome = after(got, POLLIN, until); outcome != Outcome::done) return outcome;
  }
  message.assign(received_, kHead, count);
  received_.erase(0, kHead + count);
  return Outcome::done;
}

/// Judges a call of send(2) or recv(2), and waits if it moved no bytes.
Channel::Outcome Channel::after(ssize_t moved, short events, std::optional<Clock::time_point> until) const {
  if (moved > 0) return until && Clock::now() > *until ? Outcome::overdue : Outcome::done;  // bytes may drip in forever
  if (moved == 0 || (errno != EINTR && errno != EAGAIN)) return Outcome::ended;
  pollfd ready{.fd = socket_, .events = events, .revents = 0};
  const int found = ::poll(&ready, 1, left_ms(until));
  if (found == 0 && until && Clock::now() >= *until) return Outcome::overdue;
  return found < 0 && errno != EINTR ? Outcome::ended : Outcome::done;
}

}  // namespace hedgehop::sim
