#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

/// Sockets of a link: IPv4, non-blocking.
namespace hedgehop::sim::link {

/// An open file descriptor, closed at its end.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  int number() const { return number_; }

 private:
  int number_;
};

struct Address {
  uint32_t host = 0;  ///< 0x7f000001 for 127.0.0.1
  uint16_t port = 0;
  friend bool operator==(const Address&, const Address&) = default;
};
/// Returns a numeric address such as "127.0.0.1"; nullopt for another text.
std::optional<uint32_t> parse_host(const std::string& text);
/// Returns a numeric address. Throws InputError with the key for another text.
uint32_t required_host(const std::string& text, const char* key);
/// Returns "127.0.0.1".
std::string host_text(uint32_t host);

/// A UDP socket bound to one address.
class DatagramSocket {
 public:
  /// Throws std::system_error if the address cannot be bound.
  explicit DatagramSocket(const Address& local);

  struct Datagram {
    Address from;
    std::span<const uint8_t> bytes;  ///< valid until the next call; cut at 2048 bytes
  };
  /// Returns the next datagram that has arrived; nullopt without one.
  std::optional<Datagram> receive();
  /// Sends a datagram; a lost one is not reported.
  void send(const Address& to, std::string_view bytes) const;
  int descriptor() const { return socket_.number(); }

 private:
  Descriptor socket_;
  std::vector<uint8_t> buffer_;
};

/// One end of a TCP connection.
class StreamConnection {
 public:
  /// Begins with a connected socket, and with the bytes that wait.
  void open(Descriptor socket);
  bool connected() const { return socket_.number() >= 0; }
  /// Appends bytes that have arrived, at most 64 KiB. At the end of the stream, it is not connected any more.
  void receive(std::vector<uint8_t>& bytes);
  /// Sends bytes, as far as the peer accepts them; the rest waits. Without a connection, all wait.
  /// @return false if more than 1 MiB wait.
  bool send(std::span<const uint8_t> bytes);
  /// -1 unless connected.
  int descriptor() const { return socket_.number(); }

 private:
  Descriptor socket_;
  std::vector<uint8_t> waiting_;
};

/// A TCP client that connects as soon as its server listens.
class StreamClient {
 public:
  explicit StreamClient(const Address& server) : server_(server) {}

  /// Tries to connect unless it is connected. @return whether it is connected.
  bool connect();
  StreamConnection& connection() { return connection_; }

 private:
  Address server_;
  Descriptor connecting_;
  StreamConnection connection_;
};

/// A TCP server for one client. After the first connection it does not listen any more, so no second client connects.
class StreamServer {
 public:
  /// Throws std::system_error if the address cannot be bound.
  explicit StreamServer(const Address& local);

  /// Accepts the client if one has connected. @return whether a client has connected.
  bool accept();
  StreamConnection& connection() { return connection_; }
  /// Address of the client; only after accept().
  const Address& peer() const { return peer_; }
  /// Readable when a client connects, then when bytes arrive.
  int descriptor() const { return connection_.connected() ? connection_.descriptor() : listener_.number(); }

 private:
  Descriptor listener_;
  StreamConnection connection_;
  Address peer_;
};

/// A port of a link's config.
struct LinkPort {
  const char* key;             ///< "port"
  int64_t number, first;       ///< of this instance; of instance 0
  const char* instance_steps;  ///< "10 N": distance of instance N from the first port
};
/// Throws InputError with the key of a port that cannot be opened.
[[noreturn]] void refuse_port(const LinkPort& port, uint32_t host, const std::error_code& error);

/// Returns a socket bound to a port. Throws InputError if it cannot be opened.
template <class Socket>
Socket opened(const LinkPort& port, uint32_t host) {
  try {
    return Socket(Address{host, static_cast<uint16_t>(port.number)});
  } catch (const std::system_error& error) {
    refuse_port(port, host, error.code());
  }
}

/// Waits until one of the descriptors is readable, but not longer than a wall time. @param descriptors  negative ones
/// are ignored.
void wait_readable(std::span<const int> descriptors, double max_s);

/// Returns the wall time since an arbitrary instant, s.
double wall_s();

}  // namespace hedgehop::sim::link
