#include "sim/link/sockets.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <utility>

#include "sim/config/input_error.h"

namespace hedgehop::sim::link {
namespace {

constexpr size_t kMaxDatagramBytes = 2048, kMaxWaitingBytes = 1 << 20;

sockaddr_in to_sockaddr(const Address& address) {
  sockaddr_in name{};
  name.sin_family = AF_INET;
  name.sin_addr.s_addr = htonl(address.host);
  name.sin_port = htons(address.port);
  return name;
}

Address from_sockaddr(const sockaddr_in& name) { return {ntohl(name.sin_addr.s_addr), ntohs(name.sin_port)}; }

const sockaddr* general(const sockaddr_in& name) { return reinterpret_cast<const sockaddr*>(&name); }

bool is_writable(int descriptor) {
  pollfd watched{.fd = descriptor, .events = POLLOUT, .revents = 0};
  return ::poll(&watched, 1, 0) == 1 && watched.revents == POLLOUT;
}

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

}  // namespace

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}
Descriptor::Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

std::optional<uint32_t> parse_host(const std::string& text) {
  in_addr address{};
  if (::inet_pton(AF_INET, text.c_str(), &address) != 1) return std::nullopt;
  return ntohl(address.s_addr);
}

uint32_t required_host(const std::string& text, const char* key) {
  const std::optional<uint32_t> host = parse_host(text);
  if (!host) throw InputError(fmt::format("{}: '{}' is no numeric IPv4 address such as 127.0.0.1", key, text));
  return *host;
}

std::string host_text(uint32_t host) {
  std::array<char, INET_ADDRSTRLEN> text{};
  const in_addr address{.s_addr = htonl(host)};
  return ::inet_ntop(AF_INET, &address, text.data(), text.size());
}

DatagramSocket::DatagramSocket(const Address& local)
    : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)), buffer_(kMaxDatagramBytes) {
  if (socket_.number() < 0) fail("socket");
  const sockaddr_in name = to_sockaddr(local);
  if (::bind(socket_.number(), general(name), sizeof name) != 0) fail("bind");
}

std::optional<DatagramSocket::Datagram> DatagramSocket::receive() {
  sockaddr_in from{};
  socklen_t size = sizeof from;
  for (;;) {
    const ssize_t got =
        ::recvfrom(socket_.number(), buffer_.data(), buffer_.size(), 0, reinterpret_cast<sockaddr*>(&from), &size);
    if (got >= 0) {
      return Datagram{from_sockaddr(from), std::span(buffer_).first(static_cast<size_t>(got))};
    }
    if (errno != EINTR && errno != ECONNREFUSED) return std::nullopt;
  }
}

void DatagramSocket::send(const Address& to, std::string_view bytes) const {
  const sockaddr_in name = to_sockaddr(to);
  while (::sendto(socket_.number(), bytes.data(), bytes.size(), 0, general(name), sizeof name) < 0 && errno == EINTR) {
  }
}

void StreamConnection::open(Descriptor socket) {
  socket_ = std::move(socket);
  const int on = 1;
  ::setsockopt(socket_.number(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

void StreamConnection::receive(std::vector<uint8_t>& bytes) {
  std::array<uint8_t, 4096> buffer;
  // One flooding peer must not keep this loop busy for ever.
  for (int i = 0; i < 16 && connected(); ++i) {
    const ssize_t got = ::recv(socket_.number(), buffer.data(), buffer.size(), 0);
    if (got > 0) {
      bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + got);
      continue;
    }
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return;
    socket_ = Descriptor();
    waiting_.clear();
  }
}

bool StreamConnection::send(std::span<const uint8_t> bytes) {
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
  while (connected() && !waiting_.empty()) {
    const ssize_t sent = ::send(socket_.number(), waiting_.data(), waiting_.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) break;
    waiting_.erase(waiting_.begin(), waiting_.begin() + sent);
  }
  return waiting_.size() <= kMaxWaitingBytes;
}

bool StreamClient::connect() {
  if (connection_.connected()) return true;
  // A connection on loopback succeeds or is refused at once; another host answers later, in a further call.
  if (connecting_.number() < 0) {
    connecting_ = Descriptor(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    if (connecting_.number() < 0) return false;
  }
  const sockaddr_in name = to_sockaddr(server_);
  const int status = ::connect(connecting_.number(), general(name), sizeof name);
  if (status == 0 || errno == EISCONN || (errno == EINPROGRESS && is_writable(connecting_.number()))) {
    connection_.open(std::move(connecting_));
  } else if (errno != EINPROGRESS && errno != EALREADY) {
    connecting_ = Descriptor();
  }
  return connection_.connected();
}

StreamServer::StreamServer(const Address& local)
    : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  if (listener_.number() < 0) fail("socket");
  const int on = 1;
  ::setsockopt(listener_.number(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);  // after an earlier flight at once
  const sockaddr_in name = to_sockaddr(local);
  if (::bind(listener_.number(), general(name), sizeof name) != 0) fail("bind");
  if (::listen(listener_.number(), 1) != 0) fail("listen");
}

bool StreamServer::accept() {
  if (connection_.connected()) return true;
  sockaddr_in from{};
  socklen_t size = sizeof from;
  Descriptor client(
      ::accept4(listener_.number(), reinterpret_cast<sockaddr*>(&from), &size, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (client.number() < 0) return false;
  connection_.open(std::move(client));
  peer_ = from_sockaddr(from);
  listener_ = Descriptor();
  return true;
}

void refuse_port(const LinkPort& port, uint32_t host, const std::error_code& error) {
  if (error.value() == EADDRINUSE) {
    throw InputError(fmt::format("link.{}: {} is in use (instance N uses {} + {})", port.key, port.number, port.first,
                                 port.instance_steps));
  }
  throw InputError(
      fmt::format("link.{}: {} of {} cannot be opened: {}", port.key, port.number, host_text(host), error.message()));
}

void wait_readable(std::span<const int> descriptors, double max_s) {
  std::array<pollfd, 4> watched{};
  size_t count = 0;
  for (const int descriptor : descriptors) {
    if (descriptor >= 0 && count < watched.size())
      watched[count++] = {.fd = descriptor, .events = POLLIN, .revents = 0};
  }
  constexpr double kMaxPollS = 1e6;  // within poll's int in ms
  ::poll(watched.data(), count, static_cast<int>(std::ceil(1e3 * std::clamp(max_s, 0.0, kMaxPollS))));
}

double wall_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace hedgehop::sim::link
