#pragma once

#include "arrays.hpp"

#include <optional>

/// Conversions between the values of a scene and Python's dataclasses of the same names
/// (raylane/_values.py).
namespace raylane::python {

/// These functions throw InvalidValue, with the field, if a value has a wrong type.
Material material_from(const py::handle& material);
Light light_from(const py::handle& light);
/// Fields in errors begin with the name of the argument or attribute: "fog/density". So do those of
/// the camera and the settings.
Fog fog_from(const py::handle& fog);
Camera camera_from(const py::handle& camera);
/// Returns nothing if the object is not an AutoCamera.
std::optional<AutoCamera> auto_camera_from(const py::handle& camera);
Settings settings_from(const py::handle& settings);
/// Returns the image of a Texture, a path or an array.
Texture texture_from(const py::handle& image, const std::string& field);
std::vector<double> wavelengths_from(const py::handle& wavelengths);
Color color_from(const py::handle& color, const std::string& field);
Vec3 vector_from(const py::handle& vector, const std::string& field);
float number_from(const py::handle& number, const std::string& field);
int int_from(const py::handle& number, const std::string& field);
bool bool_from(const py::handle& value, const std::string& field);
std::size_t count_from(const py::handle& count, const std::string& field);
int threads_from(const py::handle& threads);
Precision precision_from(const py::handle& precision);
Transfer transfer_from(const py::handle& transfer);
MaterialIndex one_material(const py::object& index, const char* field = "material");

/// Returns the error with the names of the fields in Python.
InvalidValue named_as_in_python(const InvalidValue& error);

py::object to_python(const Material& material);
py::object to_python(const Sellmeier& glass);
py::object to_python(const Light& light);
py::object to_python(const Fog& fog);
py::object to_python(const Camera& camera);
py::object to_python(const Settings& settings);
py::tuple to_python(const Vec3& vector);

} // namespace raylane::python
