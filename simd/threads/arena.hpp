#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace raylane::simd {

/// Hands out arrays from one block of memory, which is allocated once. An arena without memory only
/// counts the bytes that the arrays would take; see arena_for.
class Arena {
  public:
    Arena() = default;
    explicit Arena(std::size_t bytes)
        : memory_(static_cast<std::byte*>(::operator new(bytes, alignment))) {}

    /// Returns an array of `count` values, aligned for the widest registers. Whole packets can be
    /// read and written at any of the values. Returns null if the arena has no memory.
    template <class Value>
    Value* take(std::size_t count) {
        constexpr std::size_t packet = 16;
        const std::size_t start = used_;
        const auto line = static_cast<std::size_t>(alignment);
        used_ += ((count + packet) * sizeof(Value) + line - 1) / line * line;
        return memory_ == nullptr ? nullptr : reinterpret_cast<Value*>(memory_.get() + start);
    }

    template <class Value, std::size_t n>
    void take(Value* (&columns)[n], std::size_t count) {
        for (Value*& column : columns)
            column = take<Value>(count);
    }

    std::size_t used() const { return used_; }

  private:
    static constexpr std::align_val_t alignment{64};
    struct Free {
        void operator()(std::byte* memory) const { ::operator delete(memory, alignment); }
    };

    std::unique_ptr<std::byte, Free> memory_;
    std::size_t used_ = 0;
};

/// Returns an arena with memory for the arrays that `take(arena)` takes. Calls `take` twice: to
/// count the bytes, then to take the arrays.
template <class Take>
Arena arena_for(const Take& take) {
    Arena measure;
    take(measure);
    Arena arena(measure.used());
    take(arena);
    return arena;
}

} // namespace raylane::simd
