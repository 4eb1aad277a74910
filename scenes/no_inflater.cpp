#include "scenes/errors.hpp"
#include "scenes/inflater.hpp"

namespace raylane::scenes {

struct Inflater::State {};

Inflater::Inflater(std::string name, std::string begin, Source source) {
    static_cast<void>(begin), static_cast<void>(source);
    throw BadInput(name, "", "must not be compressed: raylane was built without zlib");
}
Inflater::~Inflater() = default;

std::size_t Inflater::read(std::span<char> buffer) {
    static_cast<void>(buffer);
    return 0;
}

} // namespace raylane::scenes
