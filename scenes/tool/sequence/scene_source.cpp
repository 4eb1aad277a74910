#include "scenes/tool/sequence/scene_source.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/structure_file.hpp"

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

/// Reads a file of atoms only as far as necessary.
class Trajectory : public SceneSource {
  public:
    Trajectory(const std::string& path, LoadOptions options, const FrameRange& range)
        : file_(path), options_(std::move(options)), format_(format_of(file_)), range_(range) {
        if (!is_structure(format_))
            throw BadInput("--frames", "",
                           "goes with a file of atoms, but " + printable(file_.name(), 4096) +
                               " is a scene");
        reader_ = open_reader();
        if (!range_.counts_from_end()) return;
        long frames = 0;
        while (reader_->next(structure_))
            ++frames;
        range_ = range_.of(frames);
        rewind();
    }

    std::optional<std::size_t> next() override {
        const auto first = static_cast<std::size_t>(range_.start.value_or(0));
        const std::size_t wanted = at_ ? *at_ + static_cast<std::size_t>(range_.step) : first;
        if (range_.is_one ? at_.has_value() : range_.stop && wanted >= stop()) return std::nullopt;
        for (; read_ <= wanted; ++read_)
            if (!reader_->next(structure_)) return end();
        at_ = wanted;
        return at_;
    }
    core::Scene scene(Legend* legend) override {
        DrawingScale scale;
        core::Scene scene = draw_structure(
            structure_, options_.drawing, file_.name(), options_.workers, &scale,
            [this](const std::string& remark) {
                // Only once for all frames.
                if (!std::exchange(has_remarked_, true) && options_.on_remark)
                    options_.on_remark(remark);
            },
            legend);
        if (scale_)
            scale_->include(scale);
        else
            scale_ = scale;
        return scene;
    }
    void rewind() override {
        reader_.reset();
        if (!file_.rewind())
            throw BadInput(file_.name(), "",
                           "must be a file, not a stream, for negative frame numbers and for "
                           "--camera-from all");
        reader_ = open_reader();
        read_ = 0;
        at_.reset();
    }
    std::size_t count() const override {
        if (range_.is_one) return 1;
        if (!range_.stop) return 0;
        const auto first = static_cast<std::size_t>(range_.start.value_or(0));
        const auto step = static_cast<std::size_t>(range_.step);
        return stop() > first ? (stop() - first + step - 1) / step : 0;
    }
    void keep_scale() override { options_.drawing.scale = scale_; }

  private:
    std::unique_ptr<FrameReader> open_reader() {
        return open_structure(file_, format_, {options_.atom_style, options_.on_remark});
    }

    std::size_t stop() const { return static_cast<std::size_t>(*range_.stop); }

    std::optional<std::size_t> end() const {
        if (at_) return std::nullopt;
        throw BadInput("--frames", "",
                       "must select some of the " + std::to_string(read_) + " frames that " +
                           printable(file_.name(), 4096) + " has, numbered from 0, got none");
    }

    InputFile file_;
    LoadOptions options_;
    Format format_;
    FrameRange range_;
    std::unique_ptr<FrameReader> reader_;
    Structure structure_;
    std::size_t read_ = 0; // frames
    std::optional<std::size_t> at_;
    std::optional<DrawingScale> scale_;
    bool has_remarked_ = false;
};

} // namespace

std::unique_ptr<SceneSource> sweep_of(const std::string& path, const LoadOptions& options,
                                      std::vector<std::map<std::string, double>> parameters) {
    return std::make_unique<Sweep>(path, options, std::move(parameters));
}

std::unique_ptr<SceneSource> trajectory_of(const std::string& path, const LoadOptions& options,
                                           const FrameRange& range) {
    return std::make_unique<Trajectory>(path, options, range);
}

} // namespace raylane::scenes
