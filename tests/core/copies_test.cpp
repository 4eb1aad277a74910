#include "core/scene/scene.hpp"
#include "core/shapes/material_indices.hpp"
#include "tests/support/catch.hpp"

using namespace raylane::core;

namespace {

Sphere at(float x) {
    return {{x, 0, 0}, 1};
}

} // namespace

TEST_CASE("a list and its copies grow independently") {
    ShapeList<Sphere> list;
    for (int i = 0; i < 70; ++i)
        list.add(at(static_cast<float>(i)), static_cast<ShapeId>(i));
    ShapeList<Sphere> copy = list, third;
    third = copy;
    list.add(at(100), 70);
    copy.add(at(200), 70);
    for (int i = 0; i < 200; ++i)
        third.add(at(300), static_cast<ShapeId>(70 + i));
    CHECK(list[70].shape.center.x == 100);
    CHECK(copy[70].shape.center.x == 200);
    CHECK(third[70].shape.center.x == 300);
    CHECK(third.size() == 270);
    CHECK(copy[69].shape.center.x == 69);
}

TEST_CASE("material indices and their copies grow independently") {
    MaterialIndices indices;
    for (MaterialIndex i = 0; i < 100; ++i)
        indices.push_back(i);
    MaterialIndices copy = indices;
    indices.push_back(7);
    copy.push_back(8);
    CHECK(indices[100] == 7);
    CHECK(copy[100] == 8);
    copy.push_back(70'000);
    CHECK(copy[99] == 99);
    CHECK(indices[99] == 99);
    CHECK(indices.size() == 101);
}

TEST_CASE("copies of an array share memory that lives as long as any copy") {
    BigArray<int> first(1000);
    CHECK_FALSE(first.is_shared());
    for (std::size_t i = 0; i < first.size(); ++i)
        first[i] = static_cast<int>(i);
    const int* const memory = first.data();
    const BigArray<int> second = first;
    CHECK(first.is_shared());
    CHECK(second.data() == memory);
    first = BigArray<int>();
    CHECK_FALSE(second.is_shared());
    CHECK(second[999] == 999);
    const BigArray<int> empty(0);
    CHECK(empty.empty());
    CHECK_FALSE(BigArray<int>(empty).is_shared());
}
