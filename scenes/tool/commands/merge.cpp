#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/images/exr.hpp"
#include "scenes/images/writer.hpp"
#include "scenes/tool/checkpoint/fingerprint.hpp"
#include "scenes/tool/commands/command.hpp"
#include "scenes/tool/image_texts.hpp"
#include "scenes/tool/options/option.hpp"
#include "scenes/tool/options/render_options.hpp"

#include <optional>
#include <string>
#include <vector>

namespace raylane::scenes {

namespace {

struct MergeArguments : OptionTable {
    ListOption<std::string> parts = {*this, "PARTS", file_argument(),
                                     "All parts of one image, in any order."};
    Option<std::string> output = {*this, "-o,--output", file_name().required(),
                                  "Image, in any format that render writes."};
    EncodingArguments encoding{*this, "8 (PNG), 32 (EXR), same as the parts"};
};

/// Combines the parts of one image, one after the other.
class Merger {
  public:
    explicit Merger(ImageFormat output) : output_(output) {}

    void add(const std::string& name) {
        ExrImage image = read_own_exr(name);
        const ImagePart part = part_of(name, image.texts);
        if (text_in(name, image.texts, "Pixels") != fingerprint_of(image.film))
            throw BadInput(name, "", "has pixels that differ from its Pixels attribute");
        if (!first_) begin(name, image);
        const ExrImage& first = *first_;
        for (const char* key : {"Scene", "Comment", "Software", "Options"})
            if (text_in(name, image.texts, key) != text_in(first_name_, first.texts, key))
                throw BadInput(name, "",
                               std::string("belongs to another image than ") + first_name_ + ": " +
                                   key + " differs");
        if (film_of(image.texts) != film_of(first.texts))
            throw BadInput(name, "", "belongs to another image of a sequence than " + first_name_);
        if (part.count != has_.size() || tile_of(image.texts) != tile_of(first.texts) ||
            image.film.width() != first.film.width() ||
            image.film.height() != first.film.height() ||
            image.film.has_alpha() != first.film.has_alpha())
            throw BadInput(name, "", "belongs to another division into parts than " + first_name_);
        if (image.aovs.has_value() != first.aovs.has_value())
            throw BadInput(name, "",
                           image.aovs ? "has AOVs, but " + first_name_ + " has none"
                                      : "has no AOVs, but " + first_name_ + " has some");
        if (has_[part.number - 1]) throw BadInput(name, "", "repeats part " + part.text());
        has_[part.number - 1] = true;
        const std::optional<RayTiers> rays = ray_tiers_of(text_in(name, image.texts, "Rays"));
        if (!rays) throw BadInput(name, "", "has a malformed \"Rays\" attribute");
        rays_ += *rays;
        // Parts may name the scene differently. Part 1's name is used, whatever the order of the
        // arguments.
        if (part.number == 1) texts_ = image.texts;
        for (std::size_t number = 0; number < grid_->count(); ++number)
            if (part.has(number)) copy(image, grid_->tile(number).within(crop_));
    }

    /// Returns the complete image. Throws BadInput if parts are missing.
    ExrImage take() {
        std::string missing;
        for (std::size_t i = 0; i < has_.size(); ++i)
            if (!has_[i]) missing += (missing.empty() ? "" : ", ") + std::to_string(i + 1);
        if (!missing.empty())
            throw BadInput("PARTS", "",
                           "must be all parts, 1 to " + std::to_string(has_.size()) +
                               "; missing: " + printable(missing, 200));
        // Same order as in the files that render writes.
        ImageTexts texts;
        for (const char* key : {"Title", "Software", "Comment", "Film", "Scene", "Options"})
            if (has_text(texts_, key)) texts.emplace_back(key, text_in(first_name_, texts_, key));
        texts.emplace_back("Pixels", fingerprint_of(first_->film));
        texts.emplace_back("Rays", rays_.text());
        first_->texts = std::move(texts);
        return *std::move(first_);
    }
    core::Transfer transfer() const { return settings_.transfer; }

  private:
    static ImagePart part_of(const std::string& name, const ImageTexts& texts) {
        if (!has_text(texts, "Part")) throw BadInput(name, "", "must be written by render --part");
        const std::string& text = text_in(name, texts, "Part");
        const std::optional<ImagePart> part = image_part_of(text.substr(0, text.find(' ')));
        if (!part || tile_of(texts) == 0)
            throw BadInput(name, "", "has a malformed \"Part\" attribute");
        return *part;
    }
    /// Returns an empty text for parts that are not of a sequence.
    static std::string film_of(const ImageTexts& texts) {
        return has_text(texts, "Film") ? text_in("", texts, "Film") : "";
    }
    /// Returns the side of a tile in pixels, or 0 if the text has no valid one.
    static int tile_of(const ImageTexts& texts) {
        const std::string& text = text_in("", texts, "Part");
        const int side = to_int(text.substr(text.rfind(' ') + 1)).value_or(0);
        return side >= 8 && side <= 64 ? side : 0;
    }

    /// Throws BadInput if the output's format cannot store the AOVs or the alpha that the parts
    /// were rendered with.
    void require_fit(const std::string& name, const ExrImage& image, bool alpha) const {
        const bool is_exr = output_ == ImageFormat::exr;
        if (image.aovs && !is_exr)
            throw BadInput(name, "",
                           "was rendered with --aovs, which goes with an output that ends in .exr");
        if (alpha && !stores_alpha(output_))
            throw BadInput(name, "",
                           "was rendered without a background, which goes with PNG, TIFF or EXR");
    }

    void begin(const std::string& name, const ExrImage& image) {
        const auto arguments = recorded_arguments(name, image.texts, name);
        settings_ = arguments->settings_of({});
        require_fit(name, image, settings_.alpha);
        // Nothing is rendered here, and parts may come from other processors.
        simd::RenderOptions options = arguments->render_options(/*with_isa=*/false);
        arguments->image.apply_to(options, settings_);
        options.tile = tile_of(image.texts);
        options.aovs = image.aovs.has_value();
        crop_ = options.crop.value_or(core::Region{0, 0, settings_.width, settings_.height});
        if (crop_.x1 - crop_.x0 != image.film.width() || crop_.y1 - crop_.y0 != image.film.height())
            throw BadInput(name, "", "has another size than its Comment states");
        grid_.emplace(simd::grid_of(settings_, options));
        has_.assign(part_of(name, image.texts).count, false);
        first_ = image;
        first_name_ = name;
    }

    void copy(const ExrImage& from, const core::Region& tile) {
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x) {
                const int column = x - crop_.x0, row = y - crop_.y0;
                first_->film.at(column, row) = from.film.at(column, row);
                if (from.film.has_alpha())
                    first_->film.alpha_at(column, row) = from.film.alpha_at(column, row);
                if (!from.aovs) continue;
                const std::size_t i = from.aovs->index(column, row);
                core::Aovs& aovs = *first_->aovs;
                aovs.depth[i] = from.aovs->depth[i];
                aovs.normal[i] = from.aovs->normal[i];
                aovs.shape[i] = from.aovs->shape[i];
                aovs.material[i] = from.aovs->material[i];
                aovs.samples[i] = from.aovs->samples[i];
            }
    }

    ImageFormat output_;
    std::optional<ExrImage> first_; // the first part; the others are copied into it
    std::string first_name_;
    ImageTexts texts_; // of part 1
    core::Settings settings_;
    core::Region crop_{};
    std::optional<simd::TileGrid> grid_;
    std::vector<bool> has_;
    RayTiers rays_;
};

int merge(const MergeArguments& arguments) {
    for (const std::string& part : *arguments.parts)
        require_other_file("--output", *arguments.output, "PARTS", part);
    OutputFile output(*arguments.output, more_encoders);
    require_writable("--output", output.format());
    arguments.encoding.require_fit(output.format());
    const int floats = output.format() == ImageFormat::exr ? 32 : 0; // same as the parts
    const int bits = arguments.encoding.bits.value_or(floats);
    Merger merger(output.format());
    for (const std::string& part : *arguments.parts)
        merger.add(part);
    const core::Transfer transfer = merger.transfer();
    const ExrImage image = merger.take();
    output.commit(image.film, {transfer, bits, arguments.encoding.dpi.value(), image.texts},
                  image.aovs ? &*image.aovs : nullptr);
    return 0;
}

} // namespace

Command add_merge_command(CLI::App& app) {
    return add_command<MergeArguments>(
        app,
        {.name = "merge",
         .help = "Merge the parts written by render --part",
         .example = "raylane merge part-*.exr -o out.png",
         .details = "The merged image has the same bits as one rendered at once."},
        merge);
}

} // namespace raylane::scenes
