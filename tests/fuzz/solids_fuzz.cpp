#include "tests/fuzz/shapes.hpp"
#include "tests/scenes/api/solid_exam.hpp"

/// Solids of solids from any bytes. Exact arithmetic decides which answers are right.
using namespace raylane;
using namespace raylane::fuzz;
using oracle::Expression, oracle::Op;

namespace {

/// Returns a shape that may be a part.
AnyShapeInDouble any_part(Bytes& bytes) {
    switch (bytes.below(8)) {
    case 0:
        return fuzz::shape_of<core::PlaneOf<double>>(bytes);
    case 1:
        return fuzz::shape_of<core::QuadricOf<double>>(bytes);
    case 2:
        return fuzz::shape_of<core::CylinderOf<double, core::Ends::capped>>(bytes);
    case 3:
        return fuzz::shape_of<core::ConeOf<double, core::Ends::capped>>(bytes);
    case 4:
        return fuzz::shape_of<core::EllipsoidOf<double>>(bytes);
    case 5: {
        // A box along the axes. Most of these share a face's plane with another box.
        const core::Vec3d corner = bytes.vector<double>(), size = bytes.vector<double>();
        return core::BoxOf<double>{corner, {size.x, 0, 0}, {0, size.y, 0}, {0, 0, size.z}};
    }
    case 6:
        return fuzz::shape_of<core::BoxOf<double>>(bytes);
    default:
        return fuzz::shape_of<core::SphereOf<double>>(bytes);
    }
}

/// Returns an expression. Many of its parts are changed from earlier ones, so that they have
/// something in common.
Expression expression_of(Bytes& bytes, int depth, std::vector<AnyShapeInDouble>& before) {
    const int way = depth == 0 ? 4 + bytes.below(3) : bytes.below(8);
    constexpr Op ops[] = {Op::unite, Op::intersect, Op::subtract, Op::clip};
    if (way >= 4) {
        if (way == 4 && !before.empty())
            return {Op::part, before[static_cast<std::size_t>(bytes.byte()) % before.size()]};
        if (way == 5 && !before.empty()) {
            const auto which = static_cast<std::size_t>(bytes.byte()) % before.size();
            before.push_back(changed(before[which], bytes));
        } else {
            before.push_back(any_part(bytes));
        }
        if (!is_valid(before.back())) before.back() = core::SphereOf<double>{{0, 0, 0}, 1};
        return {Op::part, before.back()};
    }
    Expression made{ops[way]};
    const int few = 2 + bytes.below(2);
    const int parts = way == 0 && bytes.below(8) == 7 ? 25 : few;
    for (int i = 0; i < parts; ++i)
        made.operands.push_back(expression_of(bytes, depth - 1, before));
    return made;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    std::vector<AnyShapeInDouble> parts;
    Expression solid{Op::intersect};
    solid.operands.push_back(expression_of(bytes, 1 + bytes.below(5), parts));
    if (bytes.below(4) != 0) // so that it has bounds
        solid.operands.push_back(
            {Op::part, core::BoxOf<double>{{-9, -9, -9}, {18, 0, 0}, {0, 18, 0}, {0, 0, 18}}});
    const std::optional<Scene> scene = tests::scene_of(solid);
    if (!scene) return 0;
    std::vector<core::Ray<float>> rays;
    for (int i = 0; i < 16 && (i == 0 || bytes.any()); ++i) {
        rays.push_back(ray_of<float>(bytes, parts));
        const core::Ray<double> wide{core::convert<double>(rays.back().origin),
                                     core::convert<double>(rays.back().direction)};
        if (!is_usual(wide)) rays.pop_back();
    }
    tests::SolidTally wrong;
    tests::ask(solid, *scene, rays, wrong);
    if (wrong.wrong() != 0) found(wrong.first + wrong.example);
    return 0;
}
