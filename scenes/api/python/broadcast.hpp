#pragma once

#include "arrays.hpp"

#include <pybind11/stl.h>

/// Arrays of rows with leading axes, which broadcast as in NumPy.
namespace raylane::python {

inline std::size_t count_of(const Axes& axes) {
    std::size_t count = 1;
    for (const py::ssize_t length : axes)
        count *= static_cast<std::size_t>(length);
    return count;
}

inline Axes joined(Axes leading, const Axes& row) {
    leading.insert(leading.end(), row.begin(), row.end());
    return leading;
}

/// Broadcasts `leading` with the axes of an array before its last ones, which must be `row`. Throws
/// InvalidValue if they are not, or if the array does not broadcast.
inline void broadcast(Axes& leading, const py::array& array, const Axes& row, const char* field) {
    const Axes own = axes_of(array);
    if (own.size() < row.size()) return; // refused later, with other objects that are no rows
    const auto refuse = [&](const std::string& expected) {
        throw InvalidValue(field, "must " + expected + ", got " + shape_text(own));
    };
    const std::size_t count = own.size() - row.size();
    if (!std::equal(row.begin(), row.end(), own.end() - static_cast<py::ssize_t>(row.size())))
        refuse("have the shape (..., 3)");
    const Axes before = leading;
    if (count > leading.size()) leading.insert(leading.begin(), count - leading.size(), 1);
    for (std::size_t i = 0; i < count; ++i) {
        py::ssize_t& length = leading[leading.size() - count + i];
        if (length == 1)
            length = own[i];
        else if (own[i] != 1 && own[i] != length)
            refuse("broadcast to the shape " + shape_text(joined(before, row)));
    }
}

/// Returns an array as it broadcasts to the axes `leading`, in the shape (n, row...) and the order
/// of C, or in the shape `row` if one row stands for all. Copies it only if its memory allows no
/// view.
inline py::array flattened(const py::array& array, const Axes& row, const Axes& leading) {
    const Axes own = axes_of(array);
    const std::size_t count = count_of(leading);
    if (own.size() <= row.size()) return array;
    if (own.size() == row.size() + 1 && static_cast<std::size_t>(own[0]) == count) return array;
    py::array owner = array;
    if (count != 1 && static_cast<std::size_t>(array.size()) == count_of(row))
        return owner.reshape(row);
    if (const Axes axes = joined(leading, row); own != axes)
        owner = py::array(py::module_::import("numpy").attr("broadcast_to")(array, axes));
    return owner.reshape(joined({static_cast<py::ssize_t>(count)}, row));
}

} // namespace raylane::python
