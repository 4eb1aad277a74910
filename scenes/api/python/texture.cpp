#include "values.hpp"

#include <limits>
#include <pybind11/stl/filesystem.h>
#include <span>
#include <string>

namespace raylane::python {

namespace {

template <class Component>
Texture texture_of(const py::array& pixels) {
    const py::array_t<Component, py::array::c_style | py::array::forcecast> rows(pixels);
    return {static_cast<int>(rows.shape(1)), static_cast<int>(rows.shape(0)),
            std::span(rows.data(), static_cast<std::size_t>(rows.size()))};
}

py::array_t<float> pixels_of(const Texture& texture) {
    py::array_t<float> pixels(Axes{texture.height(), texture.width(), 3});
    float* to = pixels.mutable_data();
    for (int y = 0; y < texture.height(); ++y)
        for (int x = 0; x < texture.width(); ++x) {
            const Color color = texture.pixel(x, y);
            for (const float component : {color.x, color.y, color.z})
                *to++ = component;
        }
    return pixels;
}

} // namespace

Texture texture_from(const py::handle& image, const std::string& field) {
    if (py::isinstance<Texture>(image)) return py::cast<Texture>(image);
    if (PyUnicode_Check(image.ptr()) != 0 || py::hasattr(image, "__fspath__"))
        return read_texture(py::cast<std::filesystem::path>(image));
    const py::array pixels = any_array(image, field.c_str());
    constexpr int most = std::numeric_limits<int>::max();
    if (pixels.ndim() != 3 || pixels.shape(2) != 3 || pixels.shape(0) > most ||
        pixels.shape(1) > most)
        throw InvalidValue(field, "must be a path, or an array of shape (height, width, 3), got " +
                                      shape_text(pixels));
    const char kind = pixels.dtype().kind();
    const bool are_codes = kind == 'u' && pixels.itemsize() == 1;
    if (!are_codes && kind != 'f')
        throw InvalidValue(field, "must be an array of uint8 or of floats, got one of " +
                                      py::cast<std::string>(py::str(pixels.dtype())));
    try {
        return are_codes ? texture_of<std::uint8_t>(pixels) : texture_of<float>(pixels);
    } catch (const InvalidValue& error) {
        throw InvalidValue(field, error.expectation);
    }
}

void bind_texture(py::module_& module) {
    py::class_<Texture>(
        module, "Texture",
        "An image as the colour of surfaces, for :attr:`Pattern.image`.\n\n"
        "``image``: the path of a PNG, or an array (height, width, 3), rows from the top down: "
        "uint8, codes of the sRGB curve, or floats, linear, from 0 to 1e10. Patterns with one "
        "texture share its pixels. Raises InvalidValue, BadInput and SystemRefused.")
        .def(py::init([](const py::object& image) { return texture_from(image, "image"); }),
             py::arg("image"))
        .def_property_readonly(
            "shape",
            [](const Texture& texture) {
                return py::make_tuple(texture.height(), texture.width(), 3);
            },
            "Height, width and 3.")
        .def("pixels", &pixels_of, "Returns the linear colours, float32 (height, width, 3).")
        .def("__eq__", [](const Texture& a, const Texture& b) { return a == b; })
        .def("__repr__", [](const Texture& texture) {
            return "<raylane.Texture: " + std::to_string(texture.width()) + " x " +
                   std::to_string(texture.height()) + ">";
        });
}

} // namespace raylane::python
