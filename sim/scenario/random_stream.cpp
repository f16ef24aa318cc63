#include "sim/scenario/random_stream.h"

namespace hedgehop::sim {

uint64_t stream_seed(uint64_t run_seed, std::string_view stream_name) {
  uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : stream_name) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3u;
  }
  uint64_t z = run_seed + 0x9e3779b97f4a7c15u * (hash | 1u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace hedgehop::sim
