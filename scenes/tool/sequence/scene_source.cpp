#include "scenes/tool/sequence/scene_source.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/frames.hpp"

#include <algorithm>
#include <utility>

namespace raylane::scenes {

namespace {

class Sweep : public SceneSource {
  public:
    Sweep(std::string path, LoadOptions options,
          std::vector<std::map<std::string, double>> parameters)
        : path_(std::move(path)), options_(std::move(options)), parameters_(std::move(parameters)) {
        if (path_ == "-" && parameters_.size() > 1)
            throw BadInput("SCENE", "", "must be a file to render a sequence, got standard input");
    }

    std::optional<std::size_t> next() override {
        if (next_ == parameters_.size()) return std::nullopt;
        options_.parameters = parameters_[next_];
        return next_++;
    }
    core::Scene scene(Legend* legend) override {
        options_.legend = legend;
        return load_scene(path_, options_);
    }
    void rewind() override { next_ = 0; }
    std::size_t count() const override { return parameters_.size(); }

  private:
    std::string path_;
    LoadOptions options_;
    std::vector<std::map<std::string, double>> parameters_;
    std::size_t next_ = 0;
};

class Trajectory : public SceneSource {
  public:
    Trajectory(const std::string& path, LoadOptions options)
        : file_(path), options_(std::move(options)), frames_(file_, format(), options_.reader()) {}

    std::optional<std::size_t> next() override { return frames_.next(); }
    core::Scene scene(Legend* legend) override {
        DrawingScale scale;
        core::Scene scene = draw_structure(
            frames_.structure(), options_.drawing, file_.name(), options_.workers, &scale,
            [this](const std::string& remark) {
                if (!scale_ && options_.on_remark) options_.on_remark(remark); // on the first frame
            },
            legend);
        if (scale_)
            scale_->include(scale);
        else
            scale_ = scale;
        return scene;
    }
    void rewind() override { frames_.rewind(); }
    std::size_t count() const override { return frames_.count(); }
    void keep_scale() override { options_.drawing.scale = scale_; }

  private:
    Format format() {
        const Format format = format_of(file_);
        if (!is_structure(format))
            throw BadInput("--frames", "",
                           "goes with a file of atoms, but " + printable(file_.name(), 4096) +
                               " is a scene");
        return format;
    }

    InputFile file_;
    LoadOptions options_;
    Frames frames_;
    std::optional<DrawingScale> scale_;
};

} // namespace

std::unique_ptr<SceneSource> sweep_of(const std::string& path, const LoadOptions& options,
                                      std::vector<std::map<std::string, double>> parameters) {
    return std::make_unique<Sweep>(path, options, std::move(parameters));
}

std::unique_ptr<SceneSource> trajectory_of(const std::string& path, const LoadOptions& options) {
    return std::make_unique<Trajectory>(path, options);
}

} // namespace raylane::scenes
