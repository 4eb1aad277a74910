#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

namespace raylane::core {

/// Allocates memory for large tables, in huge pages if the system has them: rays that access many
/// megabytes at random then seldom wait for address translation. Throws std::bad_alloc.
void* allocate_big(std::size_t bytes);
void free_big(void* memory, std::size_t bytes) noexcept;
/// Returns the memory behind the first `used` bytes to the system, where that is possible. The
/// contents of that memory are lost, but it may be written again.
void forget_rest(void* memory, std::size_t bytes, std::size_t used) noexcept;

/// Reserves memory that is zero until it is written, and that takes no memory until then: small
/// pages of address space. Throws std::bad_alloc, also where the system cannot do that.
void* reserve_zeros(std::size_t bytes);
void free_zeros(void* memory, std::size_t bytes) noexcept;

/// An array of plain data whose size is set once. The constructor leaves the elements
/// uninitialised, so the code that fills the array is the first to touch its memory, possibly in
/// many threads. Copies share the elements, which must not be changed once a copy exists. The
/// elements may belong to another owner, such as a mapped file. Such elements must not be changed
/// either.
template <class T>
class BigArray {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= 64);

  public:
    BigArray() = default;
    explicit BigArray(std::size_t size) : size_(size) {
        if (size == 0) return;
        const auto give_back = [bytes = bytes()](void* memory) { free_big(memory, bytes); };
        data_ = static_cast<T*>(allocate_big(bytes()));
        keeper_ = std::shared_ptr<void>(static_cast<void*>(data_), give_back);
    }
    /// Refers to elements that exist as long as `keeper` does.
    BigArray(const T* data, std::size_t size, std::shared_ptr<const void> keeper)
        : data_(const_cast<T*>(data)), size_(size), keeper_(std::move(keeper)) {}
    BigArray(const BigArray& other) = default;
    BigArray(BigArray&& other) noexcept
        : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)),
          keeper_(std::move(other.keeper_)) {}
    BigArray& operator=(BigArray other) noexcept {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        std::swap(keeper_, other.keeper_);
        return *this;
    }
    ~BigArray() = default;

    /// Returns an array of zeros, which takes memory only where elements are written.
    static BigArray zeros(std::size_t size) {
        const std::size_t bytes = size * sizeof(T);
        if (size == 0) return {};
        void* const memory = reserve_zeros(bytes);
        return {static_cast<const T*>(memory), size,
                std::shared_ptr<const void>(memory, [bytes](const void* address) {
                    free_zeros(const_cast<void*>(address), bytes);
                })};
    }
    /// Returns the first elements, which this array and the result share.
    BigArray first(std::size_t size) const { return {data_, size, keeper_}; }

    /// Discards all but the first `used` bytes.
    void forget_rest(std::size_t used) { core::forget_rest(data_, bytes(), used); }

    bool empty() const { return size_ == 0; }
    /// Returns true if a copy exists, or if another owner keeps the elements.
    bool is_shared() const { return keeper_.use_count() > 1; }
    std::size_t size() const { return size_; }
    std::size_t bytes() const { return size_ * sizeof(T); }

    T* data() { return data_; }
    const T* data() const { return data_; }
    T& operator[](std::size_t i) { return data_[i]; }
    const T& operator[](std::size_t i) const { return data_[i]; }
    T* begin() { return data_; }
    T* end() { return data_ + size_; }
    const T* begin() const { return data_; }
    const T* end() const { return data_ + size_; }
    const T& front() const { return data_[0]; }

  private:
    T* data_ = nullptr;
    std::size_t size_ = 0;
    std::shared_ptr<const void> keeper_; // owns the elements
};

} // namespace raylane::core
