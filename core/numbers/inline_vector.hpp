#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

namespace raylane::core {

/// A vector that stores up to `own` elements in itself and allocates memory only for more.
template <class Value, std::size_t own>
class InlineVector {
    static_assert(std::is_trivially_copyable_v<Value>);

  public:
    InlineVector() = default;
    InlineVector(const InlineVector& other) { *this = other; }
    InlineVector(InlineVector&& other) noexcept { *this = std::move(other); }
    InlineVector& operator=(const InlineVector& other) {
        if (this == &other) return *this;
        reserve_room(other.size_);
        size_ = other.size_;
        std::copy_n(other.begin(), size_, begin());
        return *this;
    }
    InlineVector& operator=(InlineVector&& other) noexcept {
        if (this == &other) return *this;
        size_ = std::exchange(other.size_, 0);
        if (other.more_ == nullptr) {
            std::copy_n(other.few_, size_, begin()); // fits in any case
            return *this;
        }
        more_ = std::move(other.more_);
        capacity_ = std::exchange(other.capacity_, own);
        return *this;
    }
    ~InlineVector() = default;

    bool empty() const { return size_ == 0; }
    std::size_t size() const { return size_; }
    Value* begin() { return more_ != nullptr ? more_.get() : few_; }
    Value* end() { return begin() + size_; }
    const Value* begin() const { return more_ != nullptr ? more_.get() : few_; }
    const Value* end() const { return begin() + size_; }
    Value& operator[](std::size_t i) { return begin()[i]; }
    const Value& operator[](std::size_t i) const { return begin()[i]; }

    /// Resizes to `size` elements with unspecified values.
    void reset(std::size_t size) {
        size_ = 0;
        reserve_room(size);
        size_ = size;
    }
    /// Keeps elements `first` to `last`, the latter excluded.
    void keep(std::size_t first, std::size_t last) {
        if (first != 0) std::copy(begin() + first, begin() + last, begin());
        size_ = last - first;
    }

  private:
    void reserve_room(std::size_t size) {
        if (size <= capacity_) return;
        std::unique_ptr<Value[]> more(new Value[size]);
        std::copy_n(begin(), size_, more.get());
        more_ = std::move(more);
        capacity_ = size;
    }

    std::size_t size_ = 0, capacity_ = own;
    std::unique_ptr<Value[]> more_; // null: the elements are in few_
    Value few_[own];                // NOLINT: only elements that were set are read
};

} // namespace raylane::core
