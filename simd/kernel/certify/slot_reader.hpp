#pragma once

#include "simd/kernel/certify/slots.hpp"
#include "simd/kernel/lanes/bounded.hpp"
#include "simd/kernel/shapes/crossings.hpp"

#include <cstddef>

namespace raylane::simd {

/// Reads the numbers of one shape per lane, all of one table, as lanes of double or of float.
template <class Number>
struct SlotReader {
    using F = Floats<Number>;
    using Value = typename F::value_type;
    static constexpr std::size_t width = F::size;

    const TableView& table;
    /// For each lane: the offset of its slot's first number, or the slot's number in a packed
    /// table.
    long long place[width];
    int row = 0;

    explicit SlotReader(const TableView& table_) : table(table_) {}

    void set(std::size_t lane, std::uint32_t slot) {
        place[lane] =
            table.is_packed() ? slot - table.first_slot : Slots<Number>::offset(table, slot);
    }

    F next() {
        Value values[width];
        for (std::size_t lane = 0; lane < width; ++lane)
            values[lane] = at(lane);
        ++row;
        return F::load_unaligned(values);
    }
    /// Same for the shape of one lane, in all lanes.
    F next_of(std::size_t lane) {
        const Value value = at(lane);
        ++row;
        return F(value);
    }

  private:
    Value at(std::size_t lane) const {
        if (table.is_packed()) [[unlikely]]
            return static_cast<Value>(PackedSpheres<Number>::value(
                table.packed, static_cast<std::uint32_t>(place[lane]), row));
        const long long record = place[lane] + 16 * row;
        if constexpr (std::is_same_v<Value, double>)
            if (table.doubles != nullptr) return table.doubles[record];
        return static_cast<Value>(table.blocks[record]);
    }
};

/// Same in numbers with bounds.
template <class D, class Number>
struct CertifiedSlotReader {
    SlotReader<D> reader;
    Floats<Certified<Number>> next() { return Floats<Certified<Number>>(reader.next()); }
};

/// Returns rays in numbers with bounds, which are exactly the rays in double.
template <class Number, class D>
Rays<Certified<Number>> certified(const Rays<D>& rays) {
    using C = Certified<Number>;
    const auto vectors = [](const Vectors<D>& v) {
        return Vectors<C>{Floats<C>(v.x), Floats<C>(v.y), Floats<C>(v.z)};
    };
    return {vectors(rays.origin), vectors(rays.direction)};
}

} // namespace raylane::simd
