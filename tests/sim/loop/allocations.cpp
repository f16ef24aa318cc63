#include "tests/sim/loop/allocations.h"

#include <atomic>
#include <cerrno>

namespace {
std::atomic<size_t> allocations = 0;
}

namespace hedgehop {
size_t allocation_count() { return allocations; }
}  // namespace hedgehop

// The address sanitizer replaces the allocator itself, and only one can.
#ifdef __SANITIZE_ADDRESS__
namespace hedgehop {
bool counts_allocations() { return false; }
}  // namespace hedgehop
#else
namespace hedgehop {
bool counts_allocations() { return true; }
}  // namespace hedgehop

// Stand before the C library's own, which they call: `new` and Eigen's matrices of variable size end here alike.
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* memory, size_t size);
void* __libc_memalign(size_t alignment, size_t size);

void* malloc(size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, size_t size) {
  ++allocations;
  return __libc_realloc(memory, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, size_t alignment, size_t size) {
  ++allocations;
  *memory = __libc_memalign(alignment, size);
  return *memory ? 0 : ENOMEM;
}
}

#endif
