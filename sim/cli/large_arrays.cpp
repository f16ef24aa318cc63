// Large arrays of this program in large pages of memory. A mesh of a million triangles fills 1.5 GB of arrays one after
// the other. With pages of 4 kB, most of the time of its import is the kernel's work for 400,000 pages.
#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {

constexpr std::size_t kPageBytes = 2 << 20, kLargeBytes = 2 * kPageBytes;

/// Returns null if there is no memory.
void* allocated(std::size_t bytes) {
  if (bytes < kLargeBytes) return std::malloc(bytes > 0 ? bytes : 1);
  if (bytes > PTRDIFF_MAX - kPageBytes) return nullptr;
  void* const memory = std::aligned_alloc(kPageBytes, (bytes + kPageBytes - 1) / kPageBytes * kPageBytes);
  if (memory) ::madvise(memory, bytes / kPageBytes * kPageBytes, MADV_HUGEPAGE);  // a hint; it may fail
  return memory;
}

}  // namespace

void* operator new(std::size_t bytes) {
  for (;;) {
    if (void* const memory = allocated(bytes)) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (!handler) throw std::bad_alloc();
    handler();
  }
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

#endif
