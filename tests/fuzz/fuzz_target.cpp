// One libFuzzer program for all readers; HEDGEHOP_READER names the one.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/readers.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const hedgehop::fuzz::Reader* const reader = [] {
    const char* const name = std::getenv("HEDGEHOP_READER");
    const auto* const found = hedgehop::fuzz::find(name ? name : "");
    if (!found) {
      std::fprintf(stderr, "HEDGEHOP_READER must name a reader of tests/fuzz/readers.cpp\n");
      std::exit(2);
    }
    return found;
  }();
  hedgehop::fuzz::feed(*reader, {reinterpret_cast<const char*>(data), size});
  return 0;
}
