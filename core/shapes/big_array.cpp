#include "core/shapes/big_array.hpp"

#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

namespace raylane::core {

namespace {

constexpr std::size_t huge_page = std::size_t{2} << 20;
constexpr std::size_t cache_line = 64;

/// A smaller table would waste much of its last page.
constexpr std::size_t min_in_huge_pages = 4 * huge_page;

std::align_val_t alignment_of(std::size_t bytes) {
    return std::align_val_t(bytes >= min_in_huge_pages ? huge_page : cache_line);
}

} // namespace

void* allocate_big(std::size_t bytes) {
    void* const memory = ::operator new(bytes, alignment_of(bytes));
#ifdef MADV_HUGEPAGE
    // Only a request: if the system refuses it, small pages work, too.
    if (bytes >= min_in_huge_pages) static_cast<void>(::madvise(memory, bytes, MADV_HUGEPAGE));
#endif
    return memory;
}

void free_big(void* memory, std::size_t bytes) noexcept {
    ::operator delete(memory, alignment_of(bytes));
}

void* reserve_zeros(std::size_t bytes) {
#if defined(MAP_NORESERVE) && defined(MAP_ANONYMOUS)
    void* const memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                                MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory != MAP_FAILED) {
#ifdef MADV_NOHUGEPAGE
        // Elements are written far apart.
        static_cast<void>(::madvise(memory, bytes, MADV_NOHUGEPAGE));
#endif
        return memory;
    }
#else
    static_cast<void>(bytes);
#endif
    throw std::bad_alloc();
}

void free_zeros(void* memory, std::size_t bytes) noexcept {
#if defined(MAP_NORESERVE) && defined(MAP_ANONYMOUS)
    static_cast<void>(::munmap(memory, bytes));
#else
    static_cast<void>(memory), static_cast<void>(bytes);
#endif
}

void forget_rest(void* memory, std::size_t bytes, std::size_t used) noexcept {
#ifdef MADV_DONTNEED
    // Whole huge pages, which are aligned with the start of such memory.
    const std::size_t first = (used + huge_page - 1) / huge_page * huge_page;
    const std::size_t last = bytes / huge_page * huge_page;
    if (bytes >= min_in_huge_pages && first < last)
        static_cast<void>(
            ::madvise(static_cast<std::byte*>(memory) + first, last - first, MADV_DONTNEED));
#else
    static_cast<void>(memory), static_cast<void>(bytes), static_cast<void>(used);
#endif
}

} // namespace raylane::core
