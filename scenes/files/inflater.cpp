#include "scenes/files/inflater.hpp"

#include "scenes/files/errors.hpp"

#include <algorithm>
#include <new>
#include <utility>
#include <zlib.h>

namespace raylane::scenes {

namespace {
constexpr std::size_t packed_size = 64 << 10;
/// Limits of the decompressed size: `max_for_each` times the compressed size, plus `max_besides`
/// bytes. Files of atoms and scenes mostly compress to between a third and a twentieth of their
/// size.
constexpr std::uint64_t max_for_each = 200, max_besides = 64 << 20;
} // namespace

struct Inflater::State {
    State(std::string name_of_file, std::string begin, Source more)
        : name(std::move(name_of_file)), packed(std::move(begin)), source(std::move(more)) {
        constexpr int largest_window = 15, with_gzip_header = 16;
        stream.next_in = reinterpret_cast<Bytef*>(packed.data());
        stream.avail_in = static_cast<uInt>(packed.size());
        if (::inflateInit2(&stream, largest_window + with_gzip_header) != Z_OK)
            throw std::bad_alloc();
    }
    ~State() { ::inflateEnd(&stream); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    bool refill() {
        packed.resize(packed_size);
        const std::size_t count = source(packed);
        stream.next_in = reinterpret_cast<Bytef*>(packed.data());
        stream.avail_in = static_cast<uInt>(count);
        return count != 0;
    }

    std::string name, packed;
    Source source;
    z_stream stream{};
    std::uint64_t packed_before = 0, before = 0; // bytes of earlier members, packed and not
    bool is_between = false;                     // between two members

    void begin_member() {
        packed_before += stream.total_in;
        before += stream.total_out;
        ::inflateReset(&stream);
    }
    bool is_too_large() const {
        const std::uint64_t size = before + stream.total_out;
        return size > max_besides &&
               (size - max_besides) / max_for_each > packed_before + stream.total_in;
    }
};

Inflater::Inflater(std::string name, std::string begin, Source source)
    : state_(std::make_unique<State>(std::move(name), std::move(begin), std::move(source))) {}
Inflater::~Inflater() = default;

std::size_t Inflater::read(std::span<char> buffer) {
    z_stream& stream = state_->stream;
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<uInt>(std::min(buffer.size(), std::size_t{1} << 30));
    const uInt room = stream.avail_out;
    while (stream.avail_out == room && room > 0) {
        if (stream.avail_in == 0 && !state_->refill()) {
            if (state_->is_between) return 0;
            throw BadInput(state_->name, "", "must be complete, got truncated gzip data");
        }
        if (state_->is_between) state_->begin_member();
        state_->is_between = false;
        const int result = ::inflate(&stream, Z_NO_FLUSH);
        if (result == Z_STREAM_END) {
            state_->is_between = true;
        } else if (result == Z_MEM_ERROR) {
            throw std::bad_alloc();
        } else if (result != Z_OK && result != Z_BUF_ERROR) {
            throw BadInput(state_->name, "",
                           std::string("must be valid gzip data: ") +
                               (stream.msg != nullptr ? stream.msg : "damaged"));
        }
    }
    if (state_->is_too_large())
        throw BadInput(state_->name, "",
                       "must not expand to more than 200 times its compressed size");
    return room - stream.avail_out;
}

} // namespace raylane::scenes
