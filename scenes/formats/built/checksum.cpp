#include "scenes/formats/built/checksum.hpp"

#include <algorithm>
#include <new>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace raylane::scenes {

namespace {

constexpr std::size_t piece_bytes = std::size_t{1} << 20;

std::uint64_t of_all(const std::vector<std::uint64_t>& pieces) {
    return XXH3_64bits(pieces.data(), pieces.size() * sizeof pieces[0]);
}

} // namespace

struct Checksum::State {
    XXH3_state_t* piece = XXH3_createState();
    State() {
        if (piece == nullptr) throw std::bad_alloc();
        XXH3_64bits_reset(piece);
    }
    ~State() { XXH3_freeState(piece); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
};

Checksum::Checksum() : state_(std::make_unique<State>()) {}
Checksum::~Checksum() = default;

void Checksum::add(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const auto part = bytes.first(std::min(bytes.size(), piece_bytes - in_piece_));
        XXH3_64bits_update(state_->piece, part.data(), part.size());
        in_piece_ += part.size();
        bytes = bytes.subspan(part.size());
        if (in_piece_ < piece_bytes) continue;
        pieces_.push_back(XXH3_64bits_digest(state_->piece));
        XXH3_64bits_reset(state_->piece);
        in_piece_ = 0;
    }
}

std::uint64_t Checksum::result() const {
    std::vector<std::uint64_t> pieces = pieces_;
    if (in_piece_ > 0) pieces.push_back(XXH3_64bits_digest(state_->piece));
    return of_all(pieces);
}

std::uint64_t checksum_of(std::span<const std::byte> bytes, core::Workers& workers) {
    std::vector<std::uint64_t> pieces((bytes.size() + piece_bytes - 1) / piece_bytes);
    workers.each(pieces.size(), [&](std::size_t i) {
        const auto piece = bytes.subspan(i * piece_bytes)
                               .first(std::min(piece_bytes, bytes.size() - i * piece_bytes));
        pieces[i] = XXH3_64bits(piece.data(), piece.size());
    });
    return of_all(pieces);
}

std::uint64_t checksum_of(layout::Header header, std::uint64_t behind) {
    header.checksum = behind;
    return XXH3_64bits(&header, sizeof header);
}

} // namespace raylane::scenes
