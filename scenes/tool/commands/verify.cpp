#include "core/beams/region_samples.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/images/exr.hpp"
#include "scenes/images/png.hpp"
#include "scenes/images/reader.hpp"
#include "scenes/images/tiff.hpp"
#include "scenes/tool/annotator.hpp"
#include "scenes/tool/checkpoint/fingerprint.hpp"
#include "scenes/tool/commands/command.hpp"
#include "scenes/tool/image_texts.hpp"
#include "scenes/tool/loading.hpp"
#include "scenes/tool/options/render_options.hpp"
#include "scenes/tool/progress_bar.hpp"
#include "scenes/tool/sequence/frame_sequence.hpp"
#include "scenes/tool/system.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <numeric>
#include <random>
#include <set>
#include <unordered_set>

namespace raylane::scenes {

namespace {

struct VerifyArguments : OptionTable {
    Option<std::string> image = {*this, "IMAGE", file_argument(),
                                 "PNG, TIFF or EXR rendered by raylane. It names its options."};
    Option<std::string> scene = {*this, "SCENE", file_argument(),
                                 "Scene that the image was rendered from."};
    Option<int> pixels = {
        *this, "--pixels", scenes::whole(1, 100'000'000).initially(1000),
        "Number of pixels to render again. Images of a quality are rendered again in "
        "squares of 16 x 16 pixels, one for each 64 of these."};
    Option<int> seed = {*this, "--seed", scenes::whole(0, 2'147'483'647).otherwise("random"),
                        "Random seed of the choice of pixels."};
    Flag whole = {*this, "--whole", flag(),
                  "Also render the whole image again, and compare the bits of its unrounded "
                  "pixels."};
    ThreadsOption threads{*this};
    VerbosityArguments verbosity{*this};
};

/// Compares components of an image with the expected ones.
class Tolerance {
  public:
    explicit Tolerance(const Image& image) : is_float_(image.linear_float), bits_(image.bits) {}

    bool is_near(float found, float expected) const {
        return std::abs(found - expected) <= 1.5F * step(expected);
    }

  private:
    /// Returns the distance between two neighbouring components that the file can store.
    float step(float component) const {
        if (!is_float_) return bits_ == 8 ? 1.0F / 255.0F : 1.0F / 65535.0F;
        const float size = std::max(std::abs(component), 0x1p-14F);
        return (bits_ == 16 ? 0x1p-10F : 0x1p-23F) * size;
    }

    bool is_float_;
    int bits_;
};

template <class T>
bool has_same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool has_same_bits(const core::Aovs& a, const core::Aovs& b) {
    return has_same_bits(a.depth, b.depth) && has_same_bits(a.normal, b.normal) &&
           has_same_bits(a.shape, b.shape) && has_same_bits(a.material, b.material) &&
           has_same_bits(a.samples, b.samples);
}

/// Reads the image, and throws BadInput for unsuitable ones before the scene is loaded.
Image whole_image(const std::string& name, const std::string& bytes) {
    InputFile file(name, bytes);
    Image image = read_image(file);
    if (has_text(image.texts, "Part"))
        throw BadInput(image.name, "", "must be a whole image, got a part: merge the parts first");
    if (!has_text(image.texts, "Comment")) return image; // refused later: it has no texts
    if (image.linear_float) {
        InputFile again(name, bytes);
        static_cast<void>(read_own_exr(again));
        return image;
    }
    const bool is_tiff = looks_like_tiff(bytes);
    const std::string foreign = is_tiff ? foreign_tag(bytes) : foreign_chunk(bytes);
    if (!foreign.empty())
        throw BadInput(image.name, "",
                       std::string("must have only ") + (is_tiff ? "tags" : "chunks") +
                           " that raylane writes, because others may change its appearance, got " +
                           printable(foreign));
    return image;
}

struct Verdict {
    std::size_t same = 0, within_a_step = 0;
    std::vector<std::size_t> others;

    std::size_t all() const { return same + within_a_step + others.size(); }
    /// Returns true for more differences than roundings of the engines cause.
    bool has_many_within_a_step() const { return has_many(within_a_step); }
    bool has_many(std::size_t pixels) const { return pixels > 2 && pixels > all() / 50; }
};

class Verifier {
  public:
    explicit Verifier(const VerifyArguments& arguments)
        : verbosity_(arguments.verbosity.verbosity()), count_(*arguments.pixels),
          seed_(arguments.seed ? static_cast<unsigned>(*arguments.seed) : std::random_device()()),
          threads_(arguments.threads.count()), name_(*arguments.image),
          bytes_(InputFile(name_).read_all()), image_(whole_image(shown_name(), bytes_)),
          render_(recorded_arguments(image_.name, image_.texts, *arguments.scene)),
          annotator_(*render_),
          scene_(has_text(image_.texts, "Film") ? seen_scene_of_film() : seen_scene()) {
        // Another instruction set gives the same pixels, but may give other numbers of rays.
        const bool with_isa =
            arguments.whole || (render_->isa && simd::is_available(*render_->isa));
        options_ = render_->render_options(with_isa);
        render_->image.apply_to(options_, settings_);
        options_.threads = threads_;
        part_ = options_.crop.value_or(core::Region{0, 0, settings_.width, settings_.height});
        if (part_.x1 - part_.x0 != image_.width || part_.y1 - part_.y0 != image_.height)
            throw BadInput(image_.name, "", "has another size than its Comment states");
        annotator_.compose(scene_, settings_, {});
    }

    bool scene_is_the_same() const {
        return fingerprint_of(scene_) == text_in(image_.name, image_.texts, "Scene");
    }

    bool options_are_the_same() const {
        simd::RenderOptions options = options_;
        options.isa = render_->isa.value_or(options.isa); // this processor may lack it
        return fingerprint_of_options(settings_, options) ==
               text_in(image_.name, image_.texts, "Options");
    }

    /// Returns true if the reference's exact arithmetic can verify the image; images of other
    /// precisions differ from it.
    bool is_exact() const { return options_.precision == core::Precision::exact; }

    /// Renders some pixels by the reference, or by the image's precision if that is not exact, and
    /// compares.
    Verdict sample() {
        simd::RenderOptions options = options_;
        if (is_exact()) options.engine = simd::Engine::reference;
        options.surveys_by_vector = true;
        return drawn_again(options, choose());
    }

    /// Renders pixels in the way they were rendered, and compares.
    Verdict as_they_were(const std::vector<std::size_t>& pixels) const {
        return drawn_again(options_, pixels);
    }

    std::string place_of(std::size_t pixel) const {
        return std::to_string(x_of(pixel) - part_.x0) + ", " +
               std::to_string(y_of(pixel) - part_.y0);
    }

    struct Whole {
        bool has_its_bits;
        bool has_its_tiers; ///< each tier decided as many rays as the image states
    };
    /// Renders and writes the whole image again in the way it was rendered. `has_its_bits` is true
    /// if the film has the bits that the image states, and if the file holds exactly the components
    /// that are written for it.
    Whole again() {
        std::optional<core::Aovs> aovs;
        if (image_.linear_float) {
            InputFile file(image_.name, bytes_);
            aovs = read_own_exr(file).aovs;
        }
        simd::RenderOptions options = options_;
        options.aovs = aovs.has_value();
        const simd::Rendering rendering = draw(options);
        const Image written = as_written(rendering.film);
        const std::optional<RayTiers> tiers =
            ray_tiers_of(text_in(image_.name, image_.texts, "Rays"));
        return {fingerprint_of(rendering.film) == text_in(image_.name, image_.texts, "Pixels") &&
                    tiers && written.rgb.is_same(image_.rgb) &&
                    written.alpha.is_same(image_.alpha) &&
                    (!aovs || has_same_bits(*aovs, rendering.aovs)),
                tiers && tiers->text() == RayTiers(rendering.counters).text()};
    }

  private:
    Verdict drawn_again(simd::RenderOptions options, const std::vector<std::size_t>& pixels) const {
        options.aovs = false;
        if (is_exact()) options.tile = side_of_tile();
        const simd::TileGrid tiles = simd::grid_of(settings_, options);
        std::unordered_set<std::size_t> wanted;
        for (const std::size_t pixel : pixels) {
            const int x = x_of(pixel), y = y_of(pixel);
            wanted.insert(tiles.number_of({x, y, x + 1, y + 1}));
        }
        options.recall = [&](const simd::TileToFill& other) {
            return !wanted.contains(tiles.number_of(other.region));
        };
        return compared(draw(options).film, pixels);
    }

    /// Returns a film as render would write it and compare would read it.
    Image as_written(core::Film film) const {
        if (annotator_.covers_image()) annotator_.cover(film, part_, settings_.transfer);
        const MemoryFile memory("raylane picture");
        OutputFile output(memory.path(), image_.linear_float ? ImageFormat::exr : ImageFormat::png,
                          more_encoders);
        output.commit(
            film, {.transfer = settings_.transfer, .bits = image_.bits, .dpi = {}, .texts = {}});
        return read_image(memory.path());
    }

    /// Compares some pixels of the image with those of a film.
    Verdict compared(const core::Film& film, const std::vector<std::size_t>& pixels) const {
        Verdict verdict;
        const Image expected = as_written(film);
        const Tolerance tolerance(image_);
        const bool has_lost_alpha = expected.alpha.size() > 0 && image_.alpha.size() == 0;
        for (const std::size_t pixel : pixels) {
            bool is_same = !has_lost_alpha, is_near = !has_lost_alpha;
            const auto compare = [&](float found, float right) {
                is_same = is_same && found == right;
                is_near = is_near && tolerance.is_near(found, right);
            };
            for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i)
                compare(image_.rgb[i], expected.rgb[i]);
            if (image_.alpha.size() > 0)
                compare(image_.alpha[pixel],
                        expected.alpha.size() > 0 ? expected.alpha[pixel] : 1.0F);
            if (is_near) {
                ++(is_same ? verdict.same : verdict.within_a_step);
            } else {
                verdict.others.push_back(pixel);
            }
        }
        return verdict;
    }

    std::string shown_name() const { return name_ == "-" ? "standard input" : name_; }

    core::Scene seen_scene() {
        const SceneArguments& how = render_->scene_arguments;
        LoadOptions options = how.load_options();
        options.legend = annotator_.legend();
        core::Scene scene = load_with_progress(*render_->scene, options, verbosity_, threads_,
                                               render_->isa.value());
        settings_ = render_->settings_of(scene.settings());
        return seen(std::move(scene), how.view.change(), settings_);
    }

    /// Returns the scene of one image of a film.
    core::Scene seen_scene_of_film() {
        const std::optional<int> place = to_int(text_in(image_.name, image_.texts, "Film"));
        std::optional<FrameSequence> sequence =
            requested_sequence(*render_, threads_, Verbosity::quiet);
        if (!sequence || !place || *place < 0)
            throw BadInput(
                image_.name, "",
                "must have the number of an image as Film and options of a sequence as Comment");
        sequence->only = static_cast<std::size_t>(*place);
        sequence->overwrites = true;
        sequence->name = [](std::size_t) { return std::string(); }; // nothing is written
        std::optional<core::Scene> result;
        sequence->wants_legends = annotator_.has_any();
        sequence->draw = [&](const SequenceImage& image, simd::Progress&) {
            result = image.scene;
            if (Legend* const legend = annotator_.legend()) *legend = image.legend;
        };
        scenes::draw(*sequence);
        if (!result)
            throw BadInput(image_.name, "",
                           "is image " + std::to_string(std::size_t{1} + *place) +
                               " of its sequence, but " + printable(*render_->scene, 4096) +
                               " has fewer");
        settings_ = render_->settings_of(result->settings());
        return *std::move(result);
    }

    simd::Rendering draw(simd::RenderOptions options) const {
        simd::Progress progress;
        options.progress = &progress;
        const ProgressBar bar(verbosity_, progress,
                              simd::drawn_part(settings_, options.crop).pixels());
        return simd::render(scene_, settings_, options);
    }

    std::vector<std::size_t> all_pixels() const {
        std::vector<std::size_t> pixels(static_cast<std::size_t>(image_.width) *
                                        static_cast<std::size_t>(image_.height));
        std::iota(pixels.begin(), pixels.end(), std::size_t{0});
        return pixels;
    }
    /// Returns the side of tiles that hold the fewest pixels besides the chosen ones.
    int side_of_tile() const {
        constexpr std::size_t max_tiles = 4'000'000;
        if (settings_.quality != 0.0F) return core::RegionSamples::square_size;
        int side = 1;
        while (all_pixels().size() / (static_cast<std::size_t>(side) * side) > max_tiles)
            side *= 2;
        return side;
    }
    /// Returns distinct random pixels. The samples of a pixel of an image of a quality depend on
    /// the square around it, so these images have random squares.
    std::vector<std::size_t> choose() const {
        if (!is_exact() || settings_.quality == 0.0F) return choose_each();
        constexpr int side = core::RegionSamples::square_size;
        constexpr std::size_t area = std::size_t{side} * side;
        constexpr std::size_t share = 4; // of the pixels of a square
        const std::size_t squares = (share * static_cast<std::size_t>(count_) + area - 1) / area;
        std::vector<std::size_t> pixels = all_pixels();
        const auto square_of = [&](std::size_t pixel) {
            return std::pair(x_of(pixel) / side, y_of(pixel) / side);
        };
        std::set<std::pair<int, int>> chosen;
        std::mt19937_64 random(seed_);
        for (std::size_t i = 0; i < pixels.size() && chosen.size() < squares; ++i) {
            std::swap(pixels[i], pixels[i + random() % (pixels.size() - i)]);
            chosen.insert(square_of(pixels[i]));
        }
        pixels = all_pixels();
        std::erase_if(pixels, [&](std::size_t i) { return !chosen.contains(square_of(i)); });
        return pixels;
    }
    std::vector<std::size_t> choose_each() const {
        std::vector<std::size_t> pixels = all_pixels();
        std::mt19937_64 random(seed_);
        const std::size_t total = pixels.size();
        const std::size_t count = std::min(total, static_cast<std::size_t>(count_));
        for (std::size_t i = 0; i < count; ++i)
            std::swap(pixels[i], pixels[i + random() % (total - i)]);
        pixels.resize(count);
        return pixels;
    }
    int x_of(std::size_t pixel) const {
        return part_.x0 + static_cast<int>(pixel % static_cast<std::size_t>(image_.width));
    }
    int y_of(std::size_t pixel) const {
        return part_.y0 + static_cast<int>(pixel / static_cast<std::size_t>(image_.width));
    }

    Verbosity verbosity_;
    int count_;
    unsigned seed_;
    int threads_;
    std::string name_, bytes_; // of the image
    Image image_;
    std::unique_ptr<RenderArguments> render_; // as the image records them
    Annotator annotator_;
    core::Settings settings_; // before scene_, whose initializer sets it
    core::Scene scene_;
    simd::RenderOptions options_;
    core::Region part_{};
};

int verify(const VerifyArguments& arguments) {
    Verifier verifier(arguments);
    const bool is_same_scene = verifier.scene_is_the_same();
    std::printf("scene      %s\n", is_same_scene ? "same as the image names"
                                                 : "differs from the one that the image names");
    if (!is_same_scene) return 1;
    const bool are_same_options = verifier.options_are_the_same();
    std::printf("options    %s\n", are_same_options ? "same as the image names"
                                                    : "differ from those that the image names");
    std::fflush(stdout); // the rest may take as long as the image
    const Verdict verdict = verifier.sample();
    std::printf(
        "pixels     %zu rendered again by %s: %zu equal, %zu within one step, %zu different\n",
        verdict.all(), verifier.is_exact() ? "the reference" : "the precision of the image",
        verdict.same, verdict.within_a_step, verdict.others.size());
    bool are_only_ties = true;
    if (!verdict.others.empty()) {
        std::printf("first      at pixel %s\n", verifier.place_of(verdict.others.front()).c_str());
        std::fflush(stdout);
        const std::size_t ties =
            verifier.is_exact() ? verifier.as_they_were(verdict.others).same : 0;
        are_only_ties = ties == verdict.others.size() && !verdict.has_many(ties);
        if (ties > 0)
            std::printf("ties       %zu different pixels are equal if rendered by the engine of "
                        "the image: paths meet edges exactly%s\n",
                        ties, verdict.has_many(ties) ? "; too many for ties" : "");
    }
    if (verdict.has_many_within_a_step())
        std::printf(
            "steps      more than 1 pixel in 50 differs by one step, more than rounding causes\n");
    bool has_its_bits = true;
    if (arguments.whole) {
        const Verifier::Whole again = verifier.again();
        has_its_bits = again.has_its_bits;
        std::printf("rays       %s\n", again.has_its_tiers
                                           ? "same counts as the image states"
                                           : "counts differ from those of the image; they may "
                                             "differ between instruction sets");
        std::printf("all bits   %s\n",
                    has_its_bits ? "same as in the image" : "differ from the image");
    }
    return are_same_options && are_only_ties && !verdict.has_many_within_a_step() && has_its_bits
               ? 0
               : 1;
}

} // namespace

Command add_verify_command(CLI::App& app) {
    return add_command<VerifyArguments>(
        app,
        {.name = "verify",
         .help = "Check an image by rendering random pixels again",
         .example = "raylane verify birthday.png scenes/birthday.json",
         .details = "Renders pixels by the scalar reference with exact numbers, or by the "
                    "precision of the image if that is not exact.\nExit code 1: pixels, options "
                    "or scene differ. A different scene ends the command at once."},
        verify);
}

} // namespace raylane::scenes
