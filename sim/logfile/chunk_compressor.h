#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace hedgehop::sim {

/// Compression of the chunks of an MCAP file.
enum class ChunkCompression { none, lz4, zstd };
/// Returns the name in the file: "", "lz4" or "zstd" [MCAP2024] sec. "Compression formats".
std::string_view to_string(ChunkCompression compression);

/// Compresses one chunk after another with equal settings. Equal chunks give equal bytes with equal libraries.
class ChunkCompressor {
 public:
  explicit ChunkCompressor(ChunkCompression kind);
  ChunkCompressor(ChunkCompressor&&) noexcept;
  ChunkCompressor& operator=(ChunkCompressor&&) noexcept;
  ~ChunkCompressor();

  ChunkCompression kind() const { return kind_; }
  /// Returns the compressed chunk, valid until the next call; the chunk itself without compression. Throws
  /// std::runtime_error with the library's message.
  std::string_view compress(std::string_view chunk);

 private:
  struct Contexts;

  ChunkCompression kind_;
  std::unique_ptr<Contexts> contexts_;
  std::string compressed_;
};

}  // namespace hedgehop::sim
