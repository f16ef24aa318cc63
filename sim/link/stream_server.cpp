#include "sim/link/stream_server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace hedgehop::sim::link {
namespace {

constexpr size_t kMaxUnsentBytes = 1 << 20;

[[noreturn]] void fail_server(const char* call) { throw std::system_error(errno, std::generic_category(), call); }

}  // namespace

StreamServer::StreamServer(const Address& local)
    : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  if (listener_.number() < 0) fail_server("socket");
  const int on = 1;
  ::setsockopt(listener_.number(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);  // after an earlier flight at once
  sockaddr_in name{};
  name.sin_family = AF_INET;
  name.sin_addr.s_addr = htonl(local.host);
  name.sin_port = htons(local.port);
  if (::bind(listener_.number(), reinterpret_cast<const sockaddr*>(&name), sizeof name) != 0) fail_server("bind");
  if (::listen(listener_.number(), 1) != 0) fail_server("listen");
}

bool StreamServer::accept() {
  if (connected()) return true;
  sockaddr_in from{};
  socklen_t size = sizeof from;
  client_ = Descriptor(
      ::accept4(listener_.number(), reinterpret_cast<sockaddr*>(&from), &size, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (!connected()) return false;
  const int on = 1;
  ::setsockopt(client_.number(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  peer_ = {ntohl(from.sin_addr.s_addr), ntohs(from.sin_port)};
  listener_ = Descriptor();
  return true;
}

void StreamServer::receive(std::vector<uint8_t>& bytes) {
  std::array<uint8_t, 4096> buffer;
  // One flooding client must not keep this loop busy for ever.
  for (int i = 0; i < 16 && connected(); ++i) {
    const ssize_t got = ::recv(client_.number(), buffer.data(), buffer.size(), 0);
    if (got > 0) {
      bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + got);
      continue;
    }
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return;
    client_ = Descriptor();
  }
}

bool StreamServer::send(std::span<const uint8_t> bytes) {
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
  while (connected() && !waiting_.empty()) {
    const ssize_t sent = ::send(client_.number(), waiting_.data(), waiting_.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) break;
    waiting_.erase(waiting_.begin(), waiting_.begin() + sent);
  }
  return waiting_.size() <= kMaxUnsentBytes;
}

}  // namespace hedgehop::sim::link
