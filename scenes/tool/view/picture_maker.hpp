#pragma once

#include "core/scene/scene.hpp"
#include "simd/render.hpp"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

namespace raylane::scenes {

/// Draws a scene on a thread of its own, coarse to fine, and anew whenever it is seen otherwise.
class PictureMaker {
  public:
    struct Picture {
        core::Film film; ///< at first of fewer pixels than the settings say
        bool is_last;    ///< as good as the settings say
    };

    /// `on_picture` is called by that thread whenever there is one to be taken.
    PictureMaker(core::Scene scene, simd::RenderOptions options, std::function<void()> on_picture);
    ~PictureMaker();
    PictureMaker(const PictureMaker&) = delete;
    PictureMaker& operator=(const PictureMaker&) = delete;

    /// Begins anew with this view, and these settings for the last picture.
    void show(core::View view, const core::Settings& settings);
    /// In place of the scene; the view is for show() to say.
    void replace(core::Scene scene);
    /// The newest picture since the last call, if there is one.
    std::optional<Picture> take();
    /// Calls it with the scene as it is seen now; drawing waits.
    void with_scene(const std::function<void(const core::Scene&)>& use);
    /// What ended the drawing, if anything did: thrown again.
    void rethrow();

  private:
    struct Wish {
        core::View view;
        core::Settings settings;
    };
    /// One picture of several that become finer.
    struct Level {
        int step; ///< pixels of the window along a side of one of the picture's
        int grid; ///< 0: as the settings say
    };

    void run(const std::stop_token& stop);
    void draw(const std::stop_token& stop, const core::Settings& settings);
    void interrupt();

    simd::RenderOptions options_;
    std::function<void()> on_picture_;

    std::mutex scene_mutex_; // held while it is drawn, or changed
    core::Scene scene_;

    std::mutex mutex_; // of what follows
    std::condition_variable_any wake_;
    std::optional<Wish> wish_;
    std::optional<Picture> picture_;
    std::exception_ptr failure_;
    bool is_interrupted_ = false;

    simd::Progress progress_;
    double seconds_per_sample_ = 0.0; // of the last one; by the thread alone
    std::jthread thread_;             // the last: it uses the others
};

} // namespace raylane::scenes
