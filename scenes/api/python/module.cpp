#include "values.hpp"

#include <pybind11/stl.h>

namespace raylane::python {

namespace {

/// Sets the Python exception of raylane/_errors.py that corresponds to a C++ exception.
void set_error(std::exception_ptr error) {
    const auto errors = [] { return py::module_::import("raylane._errors"); };
    const auto set = [](const py::object& type, const py::tuple& arguments) {
        PyErr_SetObject(type.ptr(), type(*arguments).ptr());
    };
    try {
        if (error) std::rethrow_exception(error);
    } catch (const InvalidValue& invalid) {
        const InvalidValue value = named_as_in_python(invalid);
        set(errors().attr("InvalidValue"), py::make_tuple(value.field, value.expectation));
    } catch (const BadInput& input) {
        py::list mistakes;
        for (const InputError& each : input.errors())
            mistakes.append(errors().attr("InputError")(each.file, each.line, each.column,
                                                        each.place, each.message));
        set(errors().attr("BadInput"), py::make_tuple(input.what(), mistakes));
    } catch (const SystemRefused& refused) {
        set(errors().attr("SystemRefused"), py::make_tuple(refused.what()));
    }
}

} // namespace

} // namespace raylane::python

PYBIND11_MODULE(_raylane, module) {
    using namespace raylane::python;
#if PYBIND11_VERSION_HEX < 0x020C0000
    if (std::stoi(py::module_::import("numpy").attr("__version__").cast<std::string>()) > 1)
        throw py::import_error("this raylane was built with a pybind11 before 2.12, which reads "
                               "arrays of NumPy 1 only: install numpy<2, or build raylane with a "
                               "newer pybind11");
#endif
    py::register_exception_translator(&set_error);
    module.attr("version") = raylane::version();
    module.attr("NO_SHAPE") = raylane::no_shape;
    bind_texture(module);
    bind_solids(module);
    bind_builder(module);
    bind_scene(module);
    bind_tracer(module);
    bind_image(module);
}
