#include "values.hpp"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <string_view>
#include <thread>

namespace raylane::python {

namespace {

/// A rendering that runs on a separate thread, which it owns. Meanwhile Python's thread checks for
/// signals and calls the progress callback.
class Drawing {
  public:
    Drawing(const Scene& scene, const RenderOptions& options)
        : thread_([this, &scene, options] { draw(scene, options); }) {}
    ~Drawing() {
        cancel();
        thread_.join();
    }
    Drawing(const Drawing&) = delete;
    Drawing& operator=(const Drawing&) = delete;

    void cancel() {
        const std::lock_guard lock(mutex_);
        cancelled_ = true;
    }
    struct State {
        std::int64_t pixels = 0, total_pixels = 0;
        bool is_done = false;
    };
    /// Waits for the end of the rendering, but for at most 50 ms. Returns the state.
    State wait() {
        std::unique_lock lock(mutex_);
        done_.wait_for(lock, std::chrono::milliseconds(50), [&] { return state_.is_done; });
        return state_;
    }
    /// Returns the image, or throws the exception of the rendering. To be called once
    /// State::is_done is true.
    Image take() {
        if (error_) std::rethrow_exception(error_);
        return std::move(*image_);
    }

  private:
    void draw(const Scene& scene, const RenderOptions& options) {
        try {
            image_ = render(scene, options, [this](const Progress& progress) {
                const std::lock_guard lock(mutex_);
                state_.pixels = progress.pixels;
                state_.total_pixels = progress.total_pixels;
                return !cancelled_;
            });
        } catch (...) {
            error_ = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        state_.is_done = true;
        done_.notify_all();
    }

    std::mutex mutex_;
    std::condition_variable done_;
    State state_;
    bool cancelled_ = false;
    std::optional<Image> image_;
    std::exception_ptr error_;
    std::thread thread_; // last, because it uses the other members
};

template <class Value>
py::array shaped(std::vector<Value>&& values, const std::vector<py::ssize_t>& shape) {
    return array_from(std::move(values)).reshape(shape);
}

/// Returns the arrays of an image by name. `alpha` is None if the image has no alpha.
py::dict arrays_of(Image&& image) {
    const py::ssize_t height = image.height, width = image.width;
    const auto plane = [&](auto values) -> py::object {
        if (values.empty()) return py::none();
        return shaped(std::move(values), {height, width});
    };
    py::dict result;
    result["rgb"] = shaped(std::move(image.rgb), {height, width, 3});
    result["alpha"] = plane(std::move(image.alpha));
    if (image.aovs.depth.empty()) return result;
    result["depth"] = plane(std::move(image.aovs.depth));
    result["normal"] = shaped(std::move(image.aovs.normal), {height, width, 3});
    result["shape"] = plane(std::move(image.aovs.shape_id));
    result["material"] = plane(std::move(image.aovs.material));
    result["samples"] = plane(std::move(image.aovs.samples));
    return result;
}

/// Calls `call`. Removes the prefix "settings/" from the field of an InvalidValue, because settings
/// are keywords of render() in Python.
template <class Call>
auto by_keywords(const Call& call) {
    try {
        return call();
    } catch (const InvalidValue& error) {
        constexpr std::string_view prefix = "settings/";
        if (!error.field.starts_with(prefix)) throw;
        throw InvalidValue(error.field.substr(prefix.size()), error.expectation);
    }
}

py::object render_image(const Scene& scene, const py::object& settings, const py::object& threads,
                        const py::object& precision, const py::object& crop, const py::object& aovs,
                        const py::object& progress,
                        const std::optional<std::filesystem::path>& annotations,
                        const py::object& on_remark) {
    std::vector<std::string> remarks; // of the thread that renders
    RenderOptions options{
        .settings = settings_from(settings),
        .threads = threads_from(threads),
        .precision = precision_from(precision),
        .aovs = bool_from(aovs, "aovs"),
        .annotations = annotations.value_or(""),
        .on_remark = [&](const std::string& remark) { remarks.push_back(remark); }};
    if (!crop.is_none()) {
        try {
            const auto [x, y, width, height] = py::cast<std::array<int, 4>>(py::tuple(crop));
            options.crop = PixelRect{x, y, width, height};
        } catch (const std::exception&) {
            throw InvalidValue("crop", "must be four whole numbers: x, y, width, height");
        }
    }
    Image image;
    {
        const py::gil_scoped_release free;
        Drawing drawing(scene, options);
        Drawing::State told;
        for (bool is_done = false; !is_done;) {
            const Drawing::State state = drawing.wait();
            is_done = state.is_done;
            look_for_signals();
            if (progress.is_none() || state.pixels == told.pixels) continue;
            told = state;
            const py::gil_scoped_acquire lock;
            const py::object answer = progress(state.pixels, state.total_pixels);
            if (answer.is_none()) continue;
            const int goes_on = PyObject_IsTrue(answer.ptr());
            if (goes_on < 0) throw py::error_already_set();
            if (goes_on == 0) return py::none();
        }
        image = drawing.take();
    }
    for (const std::string& remark : remarks)
        on_remark(remark);
    return arrays_of(std::move(image));
}

void write_arrays(const std::filesystem::path& path, const py::object& rgb, const py::object& alpha,
                  const py::object& transfer, int bits, float dpi) {
    const ImageEncoding encoding{transfer_from(transfer), bits, dpi};
    const py::array_t<float, py::array::c_style | py::array::forcecast> colors(
        array_of<float>(rgb, "rgb"));
    if (colors.ndim() != 3 || colors.shape(2) != 3)
        throw InvalidValue("rgb",
                           "must have the shape (height, width, 3), got " + shape_text(colors));
    Image image{.width = static_cast<int>(colors.shape(1)),
                .height = static_cast<int>(colors.shape(0)),
                .rgb = {colors.data(), colors.data() + colors.size()}};
    if (!alpha.is_none()) {
        const py::array_t<float, py::array::c_style | py::array::forcecast> shares(
            array_of<float>(alpha, "alpha"));
        if (shares.ndim() != 2 || shares.shape(0) != colors.shape(0) ||
            shares.shape(1) != colors.shape(1))
            throw InvalidValue("alpha", "must have the shape (" + std::to_string(image.height) +
                                            ", " + std::to_string(image.width) + "), got " +
                                            shape_text(shares));
        image.alpha.assign(shares.data(), shares.data() + shares.size());
    }
    const py::gil_scoped_release free;
    write_image(path, image, encoding);
}

} // namespace

void bind_image(py::module_& module) {
    module.def("render",
               [](const Scene& scene, const py::object& settings, const py::object& threads,
                  const py::object& precision, const py::object& crop, const py::object& aovs,
                  const py::object& progress,
                  const std::optional<std::filesystem::path>& annotations,
                  const py::object& on_remark) {
                   return by_keywords([&] {
                       return render_image(scene, settings, threads, precision, crop, aovs,
                                           progress, annotations, on_remark);
                   });
               });
    module.def("write_image", &write_arrays);
}

} // namespace raylane::python
