#include "scenes/images/exr.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/images/float_images.hpp"

namespace raylane::scenes {

ExrImage read_own_exr(const std::filesystem::path& path) {
    InputFile file(path);
    return read_own_exr(file);
}

} // namespace raylane::scenes

#ifndef RAYLANE_WITH_OPENEXR

namespace raylane::scenes {

bool has_exr() {
    return false;
}

std::string exr_of(const core::Film&, const core::Aovs*, const ImageOptions&) {
    throw BadInput("OpenEXR", "", "is not supported: raylane was built without libopenexr-dev");
}

ExrImage read_own_exr(InputFile& file) {
    throw BadInput(file.name(), "", "cannot be read: raylane was built without libopenexr-dev");
}

void read_exr(ByteSource&, Image&) {
    throw MalformedImage(
        "must be a PNG, HDR or PFM image, got an EXR: raylane was built without libopenexr-dev");
}

} // namespace raylane::scenes

#else

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVersion.h>
#include <algorithm>
#include <cstring>
#include <string_view>

namespace raylane::scenes {

namespace {

/// A file in memory. OpenEXR writes the table of row offsets last, near the beginning of the file.
class MemoryOut : public Imf::OStream {
  public:
    MemoryOut() : OStream("memory") {}

    void write(const char* bytes, int count) override {
        const std::size_t end = at_ + static_cast<std::size_t>(count);
        if (bytes_.size() < end) bytes_.resize(end);
        std::copy_n(bytes, count, bytes_.begin() + static_cast<std::ptrdiff_t>(at_));
        at_ = end;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t at) override { at_ = at; }

    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
    std::size_t at_ = 0;
};

/// Throws MalformedImage if an attribute claims to be larger than the rest of the file. OpenEXR
/// allocates the claimed size before it reads.
void check_attributes(std::string_view bytes) {
    constexpr std::size_t head = 8; // magic number and version
    const bool has_parts = bytes.size() > 5 && (static_cast<unsigned char>(bytes[5]) & 0x10U) != 0;
    const auto is_end = [&](std::size_t at) { return at >= bytes.size() || bytes[at] == '\0'; };
    for (std::size_t at = head;;) {
        if (is_end(at)) { // end of a header; in a multi-part file, another header may follow
            if (!has_parts || is_end(++at)) return;
        }
        at = bytes.find('\0', at);                           // end of the name
        if (at != bytes.npos) at = bytes.find('\0', at + 1); // end of the type
        if (at == bytes.npos || bytes.size() - at < 5) throw damaged("EXR");
        std::uint32_t size = 0;
        for (int byte = 4; byte > 0; --byte)
            size = size << 8 | static_cast<unsigned char>(bytes[at + static_cast<unsigned>(byte)]);
        at += 5;
        if (size > bytes.size() - at) throw damaged("EXR");
        at += size;
    }
}

class MemoryIn : public Imf::IStream {
  public:
    explicit MemoryIn(std::string bytes) : IStream("memory"), bytes_(std::move(bytes)) {
        check_attributes(bytes_);
    }

    bool read(char* bytes, int count) override {
        if (count < 0 || at_ > bytes_.size() || bytes_.size() - at_ < std::size_t(count))
            throw MalformedImage("");
        std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(at_), count, bytes);
        at_ += static_cast<std::size_t>(count);
        return at_ < bytes_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t at) override { at_ = at; }

  private:
    std::string bytes_;
    std::size_t at_ = 0;
};

struct Channels {
    Imf::Header& header;
    Imf::FrameBuffer buffer{};

    /// Adds a channel whose values are `step` bytes apart.
    template <class Value>
    void add(const char* name, Imf::PixelType type, const Value* values,
             std::size_t step = sizeof(Value)) {
        header.channels().insert(name, Imf::Channel(type));
        char* const base =
            const_cast<char*>(reinterpret_cast<const char*>(values)); // NOLINT: only read
        const int width = header.dataWindow().max.x - header.dataWindow().min.x + 1;
        buffer.insert(name, {type, base, step, step * static_cast<unsigned>(width)});
    }
};

constexpr const char* color_names[] = {"R", "G", "B"};

void add_floats(const core::Film& film, Channels& channels) {
    for (int channel = 0; channel < 3; ++channel)
        channels.add(color_names[channel], Imf::FLOAT, &film.pixels().front()[channel],
                     sizeof(core::Color));
    if (film.has_alpha()) channels.add("A", Imf::FLOAT, film.alphas().data());
}

/// The components of a film as halves, while they are written.
struct Halves {
    std::vector<Imath::half> rgb, alpha;
};

/// Clamps components to the largest half before OpenEXR rounds them, because larger ones are to be
/// white rather than infinite.
void add_halves(const core::Film& film, Halves& halves, Channels& channels) {
    constexpr float most = 65504.0F;
    halves.rgb.reserve(3 * film.pixels().size());
    for (const core::Color& pixel : film.pixels())
        for (int channel = 0; channel < 3; ++channel)
            halves.rgb.emplace_back(std::clamp(pixel[channel], -most, most));
    for (std::size_t channel = 0; channel < 3; ++channel)
        channels.add(color_names[channel], Imf::HALF, &halves.rgb[channel],
                     3 * sizeof(Imath::half));
    if (!film.has_alpha()) return;
    halves.alpha.assign(film.alphas().begin(), film.alphas().end());
    channels.add("A", Imf::HALF, halves.alpha.data());
}

void add_aovs(const core::Aovs& aovs, Channels& channels) {
    channels.add("Z", Imf::FLOAT, aovs.depth.data());
    const char* const axes[] = {"N.X", "N.Y", "N.Z"};
    for (int axis = 0; axis < 3; ++axis)
        channels.add(axes[axis], Imf::FLOAT, &aovs.normal.front()[axis], sizeof(core::Vec3f));
    channels.add("id.shape", Imf::UINT, aovs.shape.data());
    channels.add("id.material", Imf::UINT, aovs.material.data());
    channels.add("samples", Imf::UINT, aovs.samples.data());
}

void add_attributes(const ImageOptions& options, Imf::Header& header) {
    if (options.dpi) Imf::addXDensity(header, *options.dpi);
    for (const auto& [name, content] : options.texts) {
        // OpenEXR's standard name
        const std::string key = name == "Comment" ? "comments" : in_lower_case(name);
        header.insert(key, Imf::StringAttribute(content));
    }
}

std::string all_of(ByteSource& source) {
    std::string bytes;
    char buffer[1 << 14];
    for (std::size_t count = sizeof buffer; count == sizeof buffer;) {
        count = source.read(buffer);
        bytes.append(buffer, count);
    }
    return bytes;
}

/// Returns the texts that add_attributes() wrote, with a capital first letter.
std::vector<std::pair<std::string, std::string>> texts_of(const Imf::Header& header) {
    std::vector<std::pair<std::string, std::string>> texts;
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
        std::string name = attribute.name();
        if (text == nullptr || name.empty()) continue;
        if (name == "comments") name = "comment";
        if (name[0] >= 'a' && name[0] <= 'z') name[0] = static_cast<char>(name[0] - 'a' + 'A');
        texts.emplace_back(name, text->value());
    }
    return texts;
}

/// Throws MalformedImage if a channel is missing or subsampled. Call it before memory for pixels
/// is allocated. OpenEXR fills a missing channel with black, and a small file with a subsampled
/// channel may claim a large window.
void require_channels(const Imf::Header& header, const std::vector<const char*>& names) {
    for (const char* name : names)
        if (header.channels().findChannel(name) == nullptr)
            throw MalformedImage("must be an EXR with channels R, G and B, or Y, got none \"" +
                                 std::string(name) + "\"");
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
        if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
            throw MalformedImage("must be an EXR whose channels have a sample for each pixel");
}

/// Reads the pixels of the display window. The file's data window may be larger or smaller.
void read_pixels(Imf::InputFile& file, Image& image) {
    const Imath::Box2i shown = file.header().displayWindow(), there = file.header().dataWindow();
    const std::int64_t across = std::int64_t{there.max.x} - there.min.x + 1;
    const std::int64_t down = std::int64_t{there.max.y} - there.min.y + 1;
    check_size(across, down);
    if (!file.isComplete()) throw damaged("EXR"); // before memory is allocated for the claimed size
    const auto columns = static_cast<std::size_t>(across), rows = static_cast<std::size_t>(down);
    const auto has = [&](const char* name) {
        return file.header().channels().findChannel(name) != nullptr;
    };
    const bool is_grey = has("Y") && !has("G"), has_alpha = has("A");
    std::vector<const char*> names = {"R", "G", "B"};
    if (is_grey) names = {"Y"};
    if (has_alpha) names.push_back("A");
    require_channels(file.header(), names);
    const Imf::Channel* const first = file.header().channels().findChannel(names.front());
    image.bits = first != nullptr && first->type == Imf::HALF ? 16 : 32;

    const std::size_t step = names.size();
    std::vector<float> held(step * columns * rows);
    Imf::FrameBuffer buffer;
    for (std::size_t channel = 0; channel < step; ++channel)
        buffer.insert(names[channel],
                      Imf::Slice::Make(Imf::FLOAT, held.data() + channel, there,
                                       step * sizeof(float), step * columns * sizeof(float)));
    file.setFrameBuffer(buffer);
    file.readPixels(there.min.y, there.max.y);

    const std::size_t pixels =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    std::vector<float> rgb(3 * pixels), alpha(has_alpha ? pixels : 0);
    std::size_t pixel = 0;
    for (int y = shown.min.y; y <= shown.max.y; ++y)
        for (int x = shown.min.x; x <= shown.max.x; ++x, ++pixel) {
            if (x < there.min.x || x > there.max.x || y < there.min.y || y > there.max.y) continue;
            const float* const from =
                &held[step * (static_cast<std::size_t>(y - there.min.y) * columns +
                              static_cast<std::size_t>(x - there.min.x))];
            for (std::size_t channel = 0; channel < 3; ++channel)
                rgb[3 * pixel + channel] = from[is_grey ? 0 : channel];
            if (has_alpha) alpha[pixel] = from[step - 1];
        }
    image.rgb = Components(std::move(rgb));
    image.alpha = Components(std::move(alpha));
}

/// Reads channels into arrays of the image's size.
class ChannelReader {
  public:
    ChannelReader(Imf::InputFile& file, int width) : file_(file), width_(width) {}

    bool has(const char* name) const {
        return file_.header().channels().findChannel(name) != nullptr;
    }
    void add(const char* name, Imf::PixelType type, void* first, std::size_t step) {
        buffer_.insert(name, Imf::Slice(type, static_cast<char*>(first), step,
                                        step * static_cast<std::size_t>(width_)));
    }
    void read(int height) {
        file_.setFrameBuffer(buffer_);
        file_.readPixels(0, height - 1);
    }

  private:
    Imf::InputFile& file_;
    int width_;
    Imf::FrameBuffer buffer_;
};

/// Returns true if the attribute is a text with a name that add_attributes() may write.
bool is_text(const Imf::Attribute& attribute, std::string_view name) {
    return dynamic_cast<const Imf::StringAttribute*>(&attribute) != nullptr &&
           std::all_of(name.begin(), name.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

/// Throws MalformedImage with an empty text for a file that exr_of() cannot have written.
void require_own_header(const Imf::InputFile& file) {
    constexpr std::string_view written[] = {
        "channels",         "compression",        "dataWindow",        "displayWindow", "lineOrder",
        "pixelAspectRatio", "screenWindowCenter", "screenWindowWidth", "xDensity"};
    constexpr std::string_view written_channels[] = {
        "R", "G", "B", "A", "Z", "N.X", "N.Y", "N.Z", "id.shape", "id.material", "samples"};
    const auto has = [](const auto& names, std::string_view name) {
        return std::find(std::begin(names), std::end(names), name) != std::end(names);
    };
    const Imf::Header& header = file.header();
    bool is_own = !Imf::isMultiPart(file.version()) && header.pixelAspectRatio() == 1.0F;
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute)
        is_own = is_own && (has(written, attribute.name()) ||
                            is_text(attribute.attribute(), attribute.name()));
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
        is_own = is_own && has(written_channels, channel.name());
    if (!is_own) throw MalformedImage("");
}

ExrImage read_own(Imf::InputFile& file) {
    require_own_header(file);
    const Imath::Box2i shown = file.header().displayWindow();
    if (file.header().dataWindow() != shown || shown.min != Imath::V2i(0, 0) || !file.isComplete())
        throw damaged("EXR");
    const int width = shown.max.x + 1, height = shown.max.y + 1;
    check_size(width, height);
    require_channels(file.header(), {"R", "G", "B"});
    ChannelReader reader(file, width);
    ExrImage image;
    image.film = core::Film(width, height, reader.has("A"));
    const char* const colors[] = {"R", "G", "B"};
    for (int channel = 0; channel < 3; ++channel)
        reader.add(colors[channel], Imf::FLOAT, &image.film.at(0, 0)[channel], sizeof(core::Color));
    if (image.film.has_alpha())
        reader.add("A", Imf::FLOAT, &image.film.alpha_at(0, 0), sizeof(float));
    if (reader.has("id.shape")) {
        core::Aovs& aovs = image.aovs.emplace(width, height);
        reader.add("Z", Imf::FLOAT, aovs.depth.data(), sizeof(float));
        const char* const axes[] = {"N.X", "N.Y", "N.Z"};
        for (int axis = 0; axis < 3; ++axis)
            reader.add(axes[axis], Imf::FLOAT, &aovs.normal.front()[axis], sizeof(core::Vec3f));
        reader.add("id.shape", Imf::UINT, aovs.shape.data(), sizeof(core::ShapeId));
        reader.add("id.material", Imf::UINT, aovs.material.data(), sizeof(core::MaterialIndex));
        reader.add("samples", Imf::UINT, aovs.samples.data(), sizeof(std::uint32_t));
    }
    reader.read(height);
    image.texts = texts_of(file.header());
    return image;
}

} // namespace

bool has_exr() {
    return true;
}

ExrImage read_own_exr(InputFile& input) {
    try {
        ByteSource source(input);
        MemoryIn in(all_of(source));
        constexpr int no_threads = 0, most = core::Settings::max_size;
        Imf::Header::setMaxImageSize(most, most); // before memory is allocated for so many rows
        Imf::InputFile file(in, no_threads);
        return read_own(file);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const BadInput&) {
        throw;
    } catch (const SystemRefused&) {
        throw;
    } catch (const std::exception&) {
        throw BadInput(input.name(), "", "must be an EXR rendered by raylane");
    }
}

std::string exr_of(const core::Film& film, const core::Aovs* aovs, const ImageOptions& options) {
    Imf::Header header(film.width(), film.height());
    header.compression() = Imf::ZIP_COMPRESSION;
    add_attributes(options, header);
    Channels channels{header};
    Halves halves;
    if (options.bits == 32)
        add_floats(film, channels);
    else
        add_halves(film, halves, channels);
    if (aovs != nullptr) add_aovs(*aovs, channels);

    MemoryOut out;
    {
        constexpr int no_threads = 0;
        Imf::OutputFile file(out, header, no_threads);
        file.setFrameBuffer(channels.buffer);
        file.writePixels(film.height());
    } // the destructor writes the rest
    return out.take();
}

void read_exr(ByteSource& source, Image& image) {
    try {
        MemoryIn in(all_of(source));
        constexpr int no_threads = 0, most = core::Settings::max_size;
        Imf::Header::setMaxImageSize(most, most); // before memory is allocated for so many rows
        Imf::InputFile file(in, no_threads);
        const Imath::Box2i shown = file.header().displayWindow();
        const std::int64_t width = std::int64_t{shown.max.x} - shown.min.x + 1;
        const std::int64_t height = std::int64_t{shown.max.y} - shown.min.y + 1;
        check_size(width, height);
        image.width = static_cast<int>(width);
        image.height = static_cast<int>(height);
        read_pixels(file, image);
        image.texts = texts_of(file.header());
    } catch (const MalformedImage& malformed) {
        if (*malformed.what() != '\0') throw;
        throw damaged("EXR");
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) { // of several types, including those of Iex
        throw damaged("EXR");
    }
}

} // namespace raylane::scenes

#endif
