#pragma once

#include "core/scene/scene.hpp"
#include "simd/wavefront/render.hpp"

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace raylane::scenes {

/// Pixels over an image: width * height premultiplied sRGB codes 0xAARRGGBB, row by row.
struct ImageOverlay {
    int width, height;
    std::vector<std::uint32_t> pixels;
};
/// Returns the overlay of an image of a scene, or null.
using MakeOverlay =
    std::function<std::shared_ptr<const ImageOverlay>(const core::Scene&, const core::Settings&)>;

/// Renders a scene on a separate thread, coarse to fine, and starts again whenever the view
/// changes.
class ImageMaker {
  public:
    struct Image {
        core::Film film; ///< at first with fewer pixels than the settings request
        bool is_last;    ///< with the quality that the settings request
        std::shared_ptr<const ImageOverlay> overlay = {}; ///< of the settings' size, or null
    };

    /// The thread calls `make_overlay`, unless empty, for each view, and `on_image` whenever an
    /// image can be taken.
    ImageMaker(core::Scene scene, MakeOverlay make_overlay, simd::RenderOptions options,
               std::function<void()> on_image);
    ~ImageMaker();
    ImageMaker(const ImageMaker&) = delete;
    ImageMaker& operator=(const ImageMaker&) = delete;

    /// Starts again with this view. The last image has these settings.
    void show(core::View view, const core::Settings& settings);
    /// Stops rendering and replaces the scene and its overlays. Call show() afterwards with the
    /// view.
    void replace(core::Scene scene, MakeOverlay make_overlay);
    /// Returns the newest image since the last call, if any.
    std::optional<Image> take();
    /// Stops rendering and calls `use` with the scene in its current view. Call show() to render
    /// again.
    void with_scene(const std::function<void(const core::Scene&)>& use);
    /// Rethrows the exception that ended the rendering, if any.
    void rethrow();

  private:
    struct Wish {
        core::View view;
        core::Settings settings;
    };
    /// One of several images of increasing resolution.
    struct Level {
        int step; ///< pixels of the window per pixel of the image, along a side
        int grid; ///< 0: as in the settings
    };

    void run(const std::stop_token& stop);
    void draw(const std::stop_token& stop, const core::Settings& settings);
    void interrupt();

    simd::RenderOptions options_;
    std::function<void()> on_image_;

    std::mutex scene_mutex_; // held while the scene is rendered or changed
    core::Scene scene_;
    MakeOverlay make_overlay_;

    std::mutex mutex_; // protects the next five members
    std::condition_variable_any wake_;
    std::optional<Wish> wish_;
    std::optional<Image> image_;
    std::exception_ptr failure_;
    bool is_interrupted_ = false;

    simd::Progress progress_;
    double seconds_per_sample_ = 0.0; // of the last image; used by the thread only
    std::jthread thread_;             // last, because it uses the other members
};

} // namespace raylane::scenes
