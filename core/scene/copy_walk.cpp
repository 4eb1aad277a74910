#include "core/scene/copy_walk.hpp"

#include "core/numbers/float4.hpp"
#include "core/numbers/infinity.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace raylane::core {

namespace {

Float4 load4(const float* from) {
    Float4 values;
    std::memcpy(&values, from, sizeof values);
    return values;
}

/// Returns a float that is not below a value >= 0.
float rounded_up(double value) {
    constexpr auto most = double(std::numeric_limits<float>::max());
    if (!(value < most)) return infinity<float>; // true for NaN
    return static_cast<float>(value) * (1.0F + 0x1p-22F) + std::numeric_limits<float>::min();
}

} // namespace

void CopyWalk::start(const Ray<double>& ray, double off) {
    const Vec3d& d = ray.direction;
    const double scale = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    const Vec3d part(d.x / scale, d.y / scale, d.z / scale);
    const double rest = length(part), inverse_of_rest = 1.0 / rest;
    length_ = rest * scale;
    double moved = 4.0 * off;
    float origin[3];
    for (int axis = 0; axis < 3; ++axis) {
        constexpr double most = 0x1p100;
        const double unit = part[axis] * inverse_of_rest;
        origin[axis] = static_cast<float>(std::clamp(ray.origin[axis], -most, most));
        moved += std::abs(ray.origin[axis] - static_cast<double>(origin[axis]));
        // Along a smaller component, the ray moves by nothing in any scene.
        inverse_[axis] =
            static_cast<float>(std::copysign(1.0 / std::max(std::abs(unit), 0x1p-80), unit));
    }
    const float slack = rounded_up(moved);
    for (int axis = 0; axis < 3; ++axis) {
        const float shift = std::copysign(
            slack * (1.0F + 0x1p-20F) + 0x1p-22F * std::abs(origin[axis]), inverse_[axis]);
        from_[axis] = origin[axis] + shift;
        until_[axis] = origin[axis] - shift;
    }
    pending_.clear();
    if (!copies_->nodes().empty()) pending_.push_back({0.0F, 0});
}

CopyWalk::At CopyWalk::step(double t_limit, std::uint32_t& copy) {
    const bool is_usual = length_ > 0x1p-1000 && length_ < 0x1p1000;
    const float limit = is_usual ? rounded_up(t_limit * length_) : infinity<float>;
    while (!pending_.empty()) {
        const Pending nearest = pending_.back();
        pending_.pop_back();
        if (nearest.t > limit) continue;
        if ((nearest.child & Copies::Node::copy_bit) != 0) {
            copy = nearest.child & ~Copies::Node::copy_bit;
            return At::copy;
        }
        enter(copies_->nodes()[nearest.child], limit);
        load_next();
        return At::node;
    }
    return At::end;
}

void CopyWalk::load_next() const {
    const auto load = [](const auto& object) {
        const char* const bytes = reinterpret_cast<const char*>(&object);
        __builtin_prefetch(bytes);
        __builtin_prefetch(bytes + sizeof object - 1);
    };
    if (pending_.empty()) return;
    const std::uint32_t child = pending_.back().child;
    if ((child & Copies::Node::copy_bit) != 0)
        load(copies_->placement(child & ~Copies::Node::copy_bit));
    else
        load(copies_->nodes()[child]);
}

/// Differences, inverses and products have a relative error of half an ulp each.
void CopyWalk::enter(const Copies::Node& node, float t_limit) {
    Float4 near = all4(0.0F), far = all4(t_limit);
    for (int axis = 0; axis < 3; ++axis) {
        const bool negative = std::signbit(inverse_[axis]);
        const Float4 inverse = all4(inverse_[axis]);
        const Float4 enters = load4((negative ? node.upper : node.lower)[axis]);
        const Float4 leaves = load4((negative ? node.lower : node.upper)[axis]);
        near = greatest((enters - all4(from_[axis])) * inverse, near);
        far = least((leaves - all4(until_[axis])) * inverse, far);
    }
    near *= all4(1.0F - 0x1p-20F);
    const Int4 hits = (near <= far * all4(1.0F + 0x1p-20F)) & Int4{1, 2, 4, 8};
    const std::size_t first = pending_.size();
    for (auto left = static_cast<unsigned>(hits[0] | hits[1] | hits[2] | hits[3]); left != 0;
         left &= left - 1) {
        const int i = std::countr_zero(left);
        if (node.children[i] == Copies::Node::none) break; // if all bounds are entered
        pending_.push_back({near[i], node.children[i]});
        for (std::size_t at = pending_.size() - 1;
             at > first && pending_[at - 1].t < pending_[at].t; --at)
            std::swap(pending_[at - 1], pending_[at]);
    }
}

} // namespace raylane::core
