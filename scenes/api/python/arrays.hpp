#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <raylane/raylane.hpp>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// Conversions from NumPy arrays to the library's spans. Contiguous columns are used in place,
/// other ones are copied.
namespace raylane::python {

namespace py = pybind11;

/// The lengths of an array's axes, or of some of them.
using Axes = std::vector<py::ssize_t>;

inline Axes axes_of(const py::array& array) {
    return {array.shape(), array.shape() + array.ndim()};
}

inline std::string shape_text(const Axes& axes) {
    std::string text = "(";
    for (std::size_t i = 0; i < axes.size(); ++i)
        text += (i == 0 ? "" : ", ") + std::to_string(axes[i]);
    return text + (axes.size() == 1 ? ",)" : ")");
}
inline std::string shape_text(const py::array& array) {
    return shape_text(axes_of(array));
}

/// Throws InvalidValue for an array with masked values (numpy.ma), or a list that contains one.
/// NumPy's C interface would return masked values as if they were valid.
inline void refuse_masked(const py::handle& values, const std::string& field) {
    const auto refuse = [&](const py::handle& array) {
        if (Py_TYPE(array.ptr()) == py::detail::npy_api::get().PyArray_Type_) return; // saves time
        if (!py::hasattr(array, "_mask")) return;
        const py::object is_masked = py::module_::import("numpy").attr("ma").attr("is_masked");
        if (is_masked(array).cast<bool>())
            throw InvalidValue(
                field, "must have no masked values: omit them, or fill them by numpy.ma.filled()");
    };
    if (!py::isinstance<py::list>(values) && !py::isinstance<py::tuple>(values))
        return refuse(values);
    for (const py::handle& each : values)
        if (py::isinstance<py::array>(each)) refuse(each);
}

/// Returns true for an object that NumPy can read only by DLPack.
inline bool is_dlpack(const py::handle& values) {
    return py::hasattr(values, "__dlpack__") && !py::hasattr(values, "__array__");
}

/// Converts any object to an array by numpy.asarray or numpy.from_dlpack, including masked values.
/// Throws InvalidValue if NumPy refuses the object.
inline py::array converted(const py::handle& values, const char* field) {
    if (py::isinstance<py::array>(values)) return py::reinterpret_borrow<py::array>(values);
    try {
        const char* const by = is_dlpack(values) ? "from_dlpack" : "asarray"; // from NumPy 1.23 on
        return py::array(py::module_::import("numpy").attr(by)(values));
    } catch (const py::error_already_set& error) {
        if (!error.matches(PyExc_TypeError) && !error.matches(PyExc_ValueError)) throw;
        throw InvalidValue(field, "must be an array of numbers");
    }
}

/// Converts any object to an array. Throws InvalidValue if NumPy refuses the object or if it has
/// masked values.
inline py::array any_array(const py::handle& values, const char* field) {
    refuse_masked(values, field);
    return converted(values, field);
}

/// Returns true for a plain number and for a list: an object without a type of its numbers.
inline bool is_plain(const py::object& values) {
    return !py::hasattr(values, "dtype") && !is_dlpack(values);
}

/// Returns true for arrays and scalars of float32, in either byte order, and for None.
inline bool is_float(const py::object& values) {
    if (values.is_none()) return true;
    if (is_plain(values)) return false;
    const py::dtype type = converted(values, "").dtype();
    return type.kind() == 'f' && type.itemsize() == sizeof(float);
}

/// Returns the values as an array of type Value, converted if necessary. Throws InvalidValue if
/// they are not numbers, or are floating-point numbers of more than 64 bits.
template <class Value>
py::array_t<Value, py::array::forcecast> array_of(const py::handle& values, const char* field) {
    const py::array array = any_array(values, field);
    const char kind = array.dtype().kind();
    if (kind != 'b' && kind != 'i' && kind != 'u' && !(kind == 'f' && array.itemsize() <= 8))
        throw InvalidValue(field, "must be an array of numbers, of 64 bits at most");
    return py::array_t<Value, py::array::forcecast>(array);
}

/// Returns true also for plain objects, as a plain number takes the type of the other arrays, and
/// for arrays of another type whose values are all float32 values: limits that are hits' t,
/// converted to float64.
inline bool are_floats_or_plain(const py::object& values, const char* field) {
    if (is_float(values) || is_plain(values)) return true;
    const py::array_t<double, py::array::c_style | py::array::forcecast> numbers(
        array_of<double>(values, field));
    return std::all_of(numbers.data(), numbers.data() + numbers.size(), [](double value) {
        return std::isnan(value) || static_cast<double>(static_cast<float>(value)) == value;
    });
}

/// Returns whole numbers from 0 to `most` as an array of type Value. Throws InvalidValue for other
/// numbers; its field ends in the index of the number, in the order of C, unless there is only one.
template <class Value>
py::object whole_numbers(const py::handle& values, const char* field, Value most) {
    py::array array = any_array(values, field);
    if (py::isinstance<py::array_t<Value>>(array) && most == std::numeric_limits<Value>::max())
        return array;
    const char kind = array.dtype().kind();
    if (kind != 'b' && kind != 'i' && kind != 'u' && array.size() > 0)
        throw InvalidValue(field, "must be a whole number, or an array of them");
    const auto all_in = [&]<class Wide>(std::type_identity<Wide>) {
        const py::array_t<Wide, py::array::c_style | py::array::forcecast> numbers(array);
        py::array_t<Value> result(axes_of(numbers));
        Value* to = result.mutable_data();
        for (py::ssize_t i = 0; i < numbers.size(); ++i) {
            const Wide number = numbers.data()[i];
            if (std::cmp_less(number, 0) || std::cmp_greater(number, most))
                throw InvalidValue(std::string(field) +
                                       (numbers.ndim() == 0 ? "" : '/' + std::to_string(i)),
                                   "must be from 0 to " + std::to_string(most) + ", got " +
                                       std::to_string(number));
            to[i] = static_cast<Value>(number);
        }
        return result;
    };
    return kind == 'u' ? all_in(std::type_identity<std::uint64_t>())
                       : all_in(std::type_identity<std::int64_t>());
}

/// A reusable buffer for copies. It owns its memory.
template <class Value>
class Room {
  public:
    /// Returns memory for `count` uninitialized values.
    Value* of(std::size_t count) {
        if (count > size_) values_ = std::make_unique_for_overwrite<Value[]>(size_ = count);
        return values_.get();
    }

  private:
    std::unique_ptr<Value[]> values_;
    std::size_t size_ = 0;
};

/// One column of an array: `count` values, `stride` bytes apart.
template <class Value>
struct Column {
    const char* data = nullptr;
    py::ssize_t stride = 0;
    std::size_t count = 0;

    bool is_span() const {
        return count == 0 || (stride == sizeof(Value) &&
                              reinterpret_cast<std::uintptr_t>(data) % alignof(Value) == 0);
    }
    Value operator[](std::size_t i) const {
        Value value;
        std::memcpy(&value, data + static_cast<py::ssize_t>(i) * stride, sizeof value);
        return value;
    }
    std::span<const Value> span() const { return {reinterpret_cast<const Value*>(data), count}; }
    /// Returns the values from index `from` to `to` - 1. Copies them into `room` if the column is
    /// not contiguous.
    std::span<const Value> part(std::size_t from, std::size_t to, Room<Value>& room) const {
        if (count == 0) return {};
        if (is_span()) return span().subspan(from, to - from);
        Value* const copy = room.of(to - from);
        for (std::size_t i = from; i < to; ++i)
            copy[i - from] = (*this)[i];
        return {copy, to - from};
    }
};

/// Rows of numbers: an array of shape (n, row...), or a single row that stands for all n. Keeps a
/// reference to the array.
template <class Value>
class Rows {
  public:
    static constexpr std::size_t any = static_cast<std::size_t>(-1);

    /// Takes an array of shape (n, row...), or of shape `row` for a single row. Throws InvalidValue
    /// for another shape. Also throws if there are n rows and n differs from `wanted`, unless
    /// `wanted` is `any`.
    Rows(const py::handle& values, const std::vector<py::ssize_t>& row, const char* field,
         std::size_t wanted = any)
        : array_(array_of<Value>(values, field)), row_(row) {
        const auto axes = static_cast<py::ssize_t>(row.size());
        is_one_ = array_.ndim() == axes;
        bool fits = is_one_ || array_.ndim() == axes + 1;
        for (py::ssize_t axis = 0; fits && axis < axes; ++axis)
            fits = array_.shape(axis + (is_one_ ? 0 : 1)) == row[static_cast<std::size_t>(axis)];
        count_ = !fits ? 0 : is_one_ ? 1 : static_cast<std::size_t>(array_.shape(0));
        if (fits && wanted != any) {
            fits = is_one_ || count_ == wanted;
            count_ = wanted;
        }
        if (fits) return;
        std::string shape = wanted == any ? "n" : std::to_string(wanted);
        for (const py::ssize_t size : row)
            shape += ", " + std::to_string(size);
        throw InvalidValue(field, "must have the shape (" + shape + "), got " + shape_text(array_));
    }
    std::size_t count() const { return count_; }
    /// Returns the number with index `number` of each row, as a column.
    Column<Value> column(std::size_t number) const {
        py::ssize_t offset = 0;
        for (std::size_t axis = row_.size(); axis-- > 0;) {
            const auto size = static_cast<std::size_t>(row_[axis]);
            offset += static_cast<py::ssize_t>(number % size) *
                      array_.strides(static_cast<py::ssize_t>(axis) + (is_one_ ? 0 : 1));
            number /= size;
        }
        return {static_cast<const char*>(static_cast<const py::array&>(array_).data()) + offset,
                is_one_ ? 0 : array_.strides(0), count_};
    }
    /// Returns the first three columns of the rows from `from` to `to` - 1. Copies them into `room`
    /// if they are not contiguous.
    std::array<std::span<const Value>, 3> parts(std::size_t from, std::size_t to,
                                                Room<Value> (&room)[3]) const {
        const Column<Value> x = column(0), y = column(1), z = column(2);
        const bool in_rows = y.data - x.data == sizeof(Value) && z.data - y.data == sizeof(Value);
        if (x.is_span() || !in_rows)
            return {x.part(from, to, room[0]), y.part(from, to, room[1]),
                    z.part(from, to, room[2])};
        // One pass for all three columns: a pass for each would read the whole rows three times.
        const std::size_t count = to - from;
        Value *const to_x = room[0].of(count), *const to_y = room[1].of(count),
                     *const to_z = room[2].of(count);
        const char* row = x.data + static_cast<py::ssize_t>(from) * x.stride;
        for (std::size_t i = 0; i < count; ++i, row += x.stride) {
            std::array<Value, 3> values;
            std::memcpy(&values, row, sizeof values);
            to_x[i] = values[0];
            to_y[i] = values[1];
            to_z[i] = values[2];
        }
        return {std::span(to_x, count), std::span(to_y, count), std::span(to_z, count)};
    }
    /// Returns three consecutive numbers of a row, starting with number `from`, as a vector.
    Vec3Of<Value> vector(std::size_t row, std::size_t from = 0) const {
        return {column(from)[row], column(from + 1)[row], column(from + 2)[row]};
    }

  private:
    py::array_t<Value, py::array::forcecast> array_;
    std::vector<py::ssize_t> row_;
    bool is_one_ = false;
    std::size_t count_ = 0;
};

/// n numbers: an array of shape (n,), or a single number for all, with stride 0.
template <class Value>
class Values {
  public:
    Values() = default;
    Values(const py::handle& values, std::size_t count, const char* field)
        : array_(array_of<Value>(values, field)) {
        if (array_.ndim() > 1 ||
            (array_.ndim() == 1 && static_cast<std::size_t>(array_.shape(0)) != count))
            throw InvalidValue(field, "must be a number or have the shape (" +
                                          std::to_string(count) + ",), got " + shape_text(array_));
        column_ = {static_cast<const char*>(static_cast<const py::array&>(array_).data()),
                   array_.ndim() == 0 ? 0 : array_.strides(0), count};
    }
    const Column<Value>& column() const { return column_; }
    Value operator[](std::size_t i) const { return column_[i]; }

  private:
    py::array_t<Value, py::array::forcecast> array_;
    Column<Value> column_;
};

/// Returns an array that takes over the vector's memory.
template <class Value>
py::array_t<Value> array_from(std::vector<Value>&& values) {
    auto* const kept = new std::vector<Value>(std::move(values));
    const py::capsule owner(kept,
                            [](void* vector) { delete static_cast<std::vector<Value>*>(vector); });
    return py::array_t<Value>(static_cast<py::ssize_t>(kept->size()), kept->data(), owner);
}

/// Returns an array of bool that takes over a vector of bytes, each 0 or 1.
inline py::array bools_from(std::vector<std::uint8_t>&& values) {
    return array_from(std::move(values)).attr("view")(py::dtype::of<bool>());
}

/// Runs Python's handlers of pending signals, such as Ctrl-C. Throws the Python exception that a
/// handler raises.
inline void look_for_signals() {
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

void bind_builder(py::module_& module);
void bind_scene(py::module_& module);
void bind_solids(py::module_& module);
void bind_texture(py::module_& module);
void bind_tracer(py::module_& module);
void bind_image(py::module_& module);

} // namespace raylane::python
