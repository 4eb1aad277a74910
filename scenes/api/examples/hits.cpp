#include <raylane/raylane.hpp>
int main() {
    raylane::SceneBuilder builder;
    builder.add_light({.position = {4, 6, 5}});
    builder.add(raylane::Sphere{{0, 0, 0}, 1}, builder.add_material({.specular = 0.5F}));
    const raylane::Scene scene = builder.build();
    const float x[] = {0, 2}, zero[] = {0, 0}, z[] = {5, 5}, dz[] = {-1, -1};
    float t[2]; // will be 4 and infinity
    raylane::Tracer(scene).intersect({x, zero, z, zero, zero, dz}, {.t = t});
    raylane::write_image("sphere.png", raylane::render(scene));
    return t[0] == 4 && t[1] > 1e38F ? 0 : 1;
}
