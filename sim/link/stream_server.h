#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/link/sockets.h"

namespace hedgehop::sim::link {

/// A TCP server for one client. After the first connection it does not listen any more, so no second client connects.
class StreamServer {
 public:
  /// Throws std::system_error if the address cannot be bound.
  explicit StreamServer(const Address& local);

  /// Accepts the client if one has connected. @return whether a client has connected.
  bool accept();
  bool connected() const { return client_.number() >= 0; }
  /// Address of the client; only after accept().
  const Address& peer() const { return peer_; }
  /// Appends the bytes that have arrived. At the end of the stream, the client is not connected any more.
  void receive(std::vector<uint8_t>& bytes);
  /// Sends bytes, as far as the client accepts them; the rest waits. @return false if more than 1 MiB wait.
  bool send(std::span<const uint8_t> bytes);
  /// Readable when a client connects, then when bytes arrive.
  int descriptor() const { return connected() ? client_.number() : listener_.number(); }

 private:
  Descriptor listener_, client_;
  Address peer_;
  std::vector<uint8_t> waiting_;
};

}  // namespace hedgehop::sim::link
