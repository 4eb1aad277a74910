#include "tests/oracle/line.hpp"

namespace raylane::oracle {

int compare(const Hit& a, const Hit& b) {
    return compare(a.root, a.t, b.root, b.t);
}

bool is_within(const Line& line, const Root& t, const Vector& offset, const Exact& radius) {
    const Vector f = line.f - offset;
    return sign_at(t, inner(f, f) - radius * radius, Exact(2) * inner(f, line.d),
                   inner(line.d, line.d)) <= 0;
}

std::optional<Hit> plane_crossing(const Line& line, const Vector& normal, const Exact& height,
                                  Face face) {
    const Exact approach = inner(normal, line.d);
    if (approach.sign() == 0) return std::nullopt;
    return Hit(Root::quotient(height - inner(normal, line.f), approach), approach.sign() < 0, face);
}

std::vector<Hit> first_and_last(const std::vector<Hit>& on_faces) {
    std::optional<Hit> first, last;
    const auto choose = [](std::optional<Hit>& chosen, const Hit& hit, int wanted) {
        const int order = chosen ? compare(hit, *chosen) : wanted;
        if (order == wanted || (order == 0 && hit.face < chosen->face)) chosen = hit;
    };
    for (const Hit& hit : on_faces)
        hit.entering ? choose(first, hit, -1) : choose(last, hit, 1);
    if (!first || !last) return {};
    return {*first, *last};
}

} // namespace raylane::oracle
