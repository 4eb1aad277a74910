#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

/// Replaces operator new and operator delete in a program of one source, which defines has_taken()
/// and will_release().
namespace raylane::tests {

/// Called for each allocation and before each release.
void has_taken(void* memory);
void will_release(void* memory);

inline void* taken(std::size_t bytes, std::size_t alignment) {
    void* memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    if (memory == nullptr) throw std::bad_alloc();
    has_taken(memory);
    return memory;
}

/// Not inlined, as g++ would take free() for a mismatch with operator new.
[[gnu::noinline]] inline void release(void* memory) {
    if (memory != nullptr) will_release(memory);
    std::free(memory);
}

} // namespace raylane::tests

void* operator new(std::size_t bytes) {
    return raylane::tests::taken(bytes, alignof(std::max_align_t));
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
    return raylane::tests::taken(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
    raylane::tests::release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    raylane::tests::release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    raylane::tests::release(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    raylane::tests::release(memory);
}
