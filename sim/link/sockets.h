#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
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

/// A TCP client that connects as soon as its server listens.
class StreamClient {
 public:
  explicit StreamClient(const Address& server) : server_(server) {}

  /// Tries to connect unless it is connected. @return whether it is connected.
  bool connect();
  bool connected() const { return connected_; }
  /// Appends the bytes that have arrived. At the end of the stream, the client is not connected any more.
  void receive(std::vector<uint8_t>& bytes);
  /// Sends bytes, as far as the server accepts them; the rest waits. Without a connection, all wait.
  /// @return false if more than 1 MiB wait.
  bool send(std::span<const uint8_t> bytes);
  /// -1 unless connected.
  int descriptor() const { return connected_ ? socket_.number() : -1; }

 private:
  Address server_;
  Descriptor socket_;
  bool connected_ = false;
  std::vector<uint8_t> waiting_;
};

/// Waits until one of the descriptors is readable, but not longer than a wall time. @param descriptors  negative ones
/// are ignored.
void wait_readable(std::span<const int> descriptors, double max_s);

}  // namespace hedgehop::sim::link
