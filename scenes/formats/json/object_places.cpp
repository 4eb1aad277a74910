#include "scenes/formats/json/object_places.hpp"

#include "scenes/files/errors.hpp"

#include <utility>

namespace raylane::scenes {

void ObjectPlaces::add(std::size_t first, std::size_t count) {
    if (count > 1)
        several_.push_back(
            {static_cast<core::ShapeId>(first), static_cast<core::ShapeId>(first + count - 1)});
}

void ObjectPlaces::enter(std::string file, std::size_t first) {
    outer_.push_back(sections_.size() - 1);
    sections_.push_back({std::move(file), rank_of(first), 0});
}

void ObjectPlaces::leave(std::size_t first) {
    const std::size_t from = outer_.back();
    outer_.pop_back();
    const Section& outer = sections_[from];
    const std::size_t before = sections_[from + 1].first_of_all - outer.first_of_all;
    sections_.push_back({outer.file, rank_of(first), outer.first + before});
}

std::string ObjectPlaces::name_of(core::ShapeId id) const {
    const std::size_t rank = rank_of(id);
    std::size_t section = sections_.size() - 1;
    while (rank < sections_[section].first_of_all)
        --section;
    const auto& [file, first_of_all, first] = sections_[section];
    return (file.empty() ? "" : printable(file, 4096) + ": ") + "/objects/" +
           std::to_string(first + rank - first_of_all);
}

} // namespace raylane::scenes
