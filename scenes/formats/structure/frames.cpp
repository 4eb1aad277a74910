#include "scenes/formats/structure/frames.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/files/words.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace raylane::scenes {

FrameRange FrameRange::of(long count) const {
    const auto place = [&](std::optional<long> at) -> std::optional<long> {
        if (!at || *at >= 0) return at;
        return std::max(0L, *at + count);
    };
    FrameRange range{place(start), place(stop), step, is_one};
    // A single frame before the first one does not exist.
    if (is_one && *start < -count) range.start = std::numeric_limits<long>::max();
    return range;
}

namespace {

std::optional<FrameRange> range_in(const std::string& text) {
    const std::vector<std::string_view> parts = parts_of(text, ':');
    std::optional<long> numbers[3];
    if (parts.size() > 3) return std::nullopt;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].empty()) continue;
        const std::optional<int> number = to_int(parts[i]);
        if (!number) return std::nullopt;
        numbers[i] = *number;
    }
    const FrameRange range{numbers[0], numbers[1], numbers[2].value_or(1), parts.size() == 1};
    if (range.step < 1 || (range.is_one && !range.start)) return std::nullopt;
    return range;
}

} // namespace

FrameRange frame_range_of(const std::string& option, const std::string& text) {
    const std::optional<FrameRange> range = range_in(text);
    if (!range)
        refuse(option, "a number or START:STOP:STEP, such as 0:100:2, with a step from 1", text);
    return *range;
}

Frames::Frames(InputFile& file, Format format, ReaderOptions options)
    : file_(file), format_(format), options_(std::move(options)), range_(options_.frames) {
    if (range_.counts_from_end()) {
        ReaderOptions silent = options_; // the frames are read again
        silent.on_remark = {};
        const std::unique_ptr<FrameReader> reader = open_structure(file_, format_, silent);
        long count = 0;
        while (reader->next(structure_))
            ++count;
        range_ = range_.of(count);
        rewind();
    } else {
        reader_ = open_structure(file_, format_, options_);
    }
}

std::optional<std::size_t> Frames::next() {
    const auto first = static_cast<std::size_t>(range_.start.value_or(0));
    const std::size_t wanted = at_ ? *at_ + static_cast<std::size_t>(range_.step) : first;
    const bool is_past = range_.stop && wanted >= static_cast<std::size_t>(*range_.stop);
    if (range_.is_one ? at_.has_value() : is_past) return std::nullopt;
    for (; read_ <= wanted; ++read_)
        if (!reader_->next(structure_)) return end();
    if (structure_.size() == 0)
        throw BadInput(file_.name(), "",
                       "has no atoms in frame " + std::to_string(wanted) + "; \"--frames " +
                           std::to_string(wanted + 1) + "\" selects the next one, if any");
    at_ = wanted;
    return at_;
}

std::optional<std::size_t> Frames::end() const {
    if (at_) return std::nullopt;
    if (read_ == 0) throw BadInput(file_.name(), "", "has no atoms");
    const std::string frames =
        read_ == 1 ? "the only frame" : "some of the " + std::to_string(read_) + " frames";
    throw BadInput("--frames", "",
                   "must select " + frames + " that " + printable(file_.name(), 4096) +
                       " has, numbered from 0, got none");
}

void Frames::rewind() {
    reader_.reset();
    if (!file_.rewind())
        throw BadInput(file_.name(), "",
                       "must be a file, not a stream, for negative frame numbers and for "
                       "--camera-from all");
    reader_ = open_structure(file_, format_, options_);
    read_ = 0;
    at_.reset();
}

std::size_t Frames::count() const {
    if (range_.is_one) return 1;
    if (!range_.stop) return 0;
    const auto first = static_cast<std::size_t>(range_.start.value_or(0));
    const auto step = static_cast<std::size_t>(range_.step),
               stop = static_cast<std::size_t>(*range_.stop);
    return stop > first ? (stop - first + step - 1) / step : 0;
}

} // namespace raylane::scenes
