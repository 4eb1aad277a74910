// Traces an image with calls of the library only: rays bounce between mirrors and glass, and
// shadows fall through glass. No epsilon is used: each ray names the surface that it leaves.
//
// The image is that of raylane::render, with two differences. Normals are floats, which bends
// reflected and refracted rays by up to 1e-7. Light is added up in another order. Neither can be
// seen: hardly any pixel of path.png differs by one step of 255.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <raylane/raylane.hpp>
#include <vector>

namespace {

struct Vector {
    double x = 0, y = 0, z = 0;
    friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vector operator*(double s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
};
double dot(Vector a, Vector b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vector cross(Vector a, Vector b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vector normalized(Vector a) {
    return 1.0 / std::sqrt(dot(a, a)) * a;
}
Vector wide(raylane::Vec3 a) {
    return {a.x, a.y, a.z};
}

/// A ray, and the surface that it leaves.
struct Ray {
    Vector origin, direction;
    double distance; ///< the maximum distance of a hit
    std::size_t pixel;
    Vector weight; ///< of its contribution to the pixel
    raylane::ShapeId shape = raylane::no_shape;
    std::uint8_t face = 0, inward = 0;
};

struct Hit {
    bool any;
    raylane::ShapeId shape;
    std::uint8_t face, entering;
    double t;
    Vector normal; ///< unit, on the side that the ray comes from
};

/// Traces all rays at once, because the library is fastest with many rays.
std::vector<Hit> intersect(const raylane::Tracer& tracer, const std::vector<Ray>& rays) {
    const std::size_t count = rays.size();
    std::vector<double> o[3], d[3], t_max, t(count);
    std::vector<raylane::ShapeId> leaves, shape(count);
    std::vector<std::uint8_t> leaves_face, inward, face(count), entering(count);
    std::vector<float> nx(count), ny(count), nz(count);
    for (const Ray& ray : rays) {
        const double from[] = {ray.origin.x, ray.origin.y, ray.origin.z};
        const double along[] = {ray.direction.x, ray.direction.y, ray.direction.z};
        for (int axis = 0; axis < 3; ++axis) {
            o[axis].push_back(from[axis]);
            d[axis].push_back(along[axis]);
        }
        t_max.push_back(ray.distance);
        leaves.push_back(ray.shape);
        leaves_face.push_back(ray.face);
        inward.push_back(ray.inward);
    }
    raylane::DoubleRaySpan asked{o[0], o[1], o[2], d[0], d[1], d[2]};
    asked.t_max = t_max;
    asked.origin_shape = leaves;
    asked.origin_face = leaves_face;
    asked.origin_inward = inward;
    raylane::HitSpan found{{}, nx, ny, nz, shape, entering, face, t};
    tracer.intersect(asked, found);
    std::vector<Hit> hits(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Vector outside{nx[i], ny[i], nz[i]};
        hits[i] = {shape[i] != raylane::no_shape,
                   shape[i],
                   face[i],
                   entering[i],
                   t[i],
                   entering[i] != 0 ? outside : -1.0 * outside};
    }
    return hits;
}

/// Returns the ray that continues from a hit: through the surface, or back from it.
Ray onward(const Ray& ray, const Hit& hit, Vector direction, bool through) {
    Ray next = ray;
    next.origin = ray.origin + hit.t * ray.direction;
    next.direction = direction;
    next.shape = hit.shape;
    next.face = hit.face;
    next.inward = through == (hit.entering != 0) ? 1 : 0;
    return next;
}

/// Returns the reflected share of light by Schlick, from the cosine of the larger angle.
double schlick(double cosine, double index) {
    const double at_normal = std::pow((1 - index) / (1 + index), 2);
    return at_normal + (1 - at_normal) * std::pow(1 - cosine, 5);
}

/// Adds light along shadow rays. Opaque surfaces block it; glass lets some through.
void add_light(const raylane::Scene& scene, const raylane::Tracer& tracer, std::vector<Ray> rays,
               std::vector<Vector>& sums) {
    while (!rays.empty()) {
        const std::vector<Hit> hits = intersect(tracer, rays);
        std::vector<Ray> further;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Ray& ray = rays[i];
            if (!hits[i].any) {
                sums[ray.pixel] = sums[ray.pixel] + ray.weight;
                continue;
            }
            const raylane::Material material = scene.material(scene.material_of(hits[i].shape));
            if (material.transmission == 0) continue;
            Ray next = onward(ray, hits[i], ray.direction, true);
            next.distance -= hits[i].t;
            const double cosine = -dot(ray.direction, hits[i].normal);
            next.weight =
                (1 - schlick(cosine, material.index)) * double(material.transmission) * ray.weight;
            further.push_back(next);
        }
        rays = std::move(further);
    }
}

/// Shades a hit. Adds its shadow rays to `shadows`, and the rays that continue to `next`.
void shade(const raylane::Scene& scene, const Ray& ray, const Hit& hit, std::vector<Ray>& shadows,
           std::vector<Ray>& next, std::vector<Vector>& sums) {
    const raylane::Material material = scene.material(scene.material_of(hit.shape));
    const Vector own = wide(material.pattern.colors[0]), point = ray.origin + hit.t * ray.direction;
    const auto colored = [&](double share) {
        return Vector{share * own.x * ray.weight.x, share * own.y * ray.weight.y,
                      share * own.z * ray.weight.z};
    };
    sums[ray.pixel] = sums[ray.pixel] + colored(material.ambient);
    for (const raylane::Light& light : scene.lights()) {
        const Vector way = wide(light.position) - point;
        const double distance = std::sqrt(dot(way, way)), cosine = dot(hit.normal, way) / distance;
        if (!(cosine > 0) || material.diffuse == 0) continue;
        Ray shadow = onward(ray, hit, 1 / distance * way, false);
        shadow.distance = distance;
        shadow.weight = colored(material.diffuse * cosine);
        shadows.push_back(shadow);
    }

    const double cosine = -dot(ray.direction, hit.normal);
    double reflected = material.reflectivity;
    if (material.transmission > 0) {
        const double ratio = hit.entering != 0 ? 1.0 / material.index : double(material.index);
        const Vector across = ratio * (ray.direction + cosine * hit.normal);
        const double sine_squared = dot(across, across);
        reflected = 1;
        if (sine_squared <= 1) {
            const double behind = std::sqrt(1 - sine_squared);
            reflected = schlick(hit.entering != 0 ? cosine : behind, material.index);
            Ray refracted = onward(ray, hit, normalized(across - behind * hit.normal), true);
            refracted.weight = (1 - reflected) * double(material.transmission) * ray.weight;
            next.push_back(refracted);
        }
    }
    Ray mirrored = onward(ray, hit, normalized(ray.direction + 2 * cosine * hit.normal), false);
    mirrored.weight = reflected * ray.weight;
    next.push_back(mirrored);
}

raylane::Scene mirrors_and_glass() {
    raylane::SceneBuilder builder;
    builder.camera = {.from = {0, 1.6F, 6}, .at = {0, 0.7F, 0}, .field_of_view = 32};
    builder.background = {0.55F, 0.65F, 0.8F};
    builder.settings = {.width = 480, .height = 300, .max_depth = 6};
    builder.add_light({.position = {-4, 6, 4}});
    const auto color = [&](float r, float g, float b) {
        return builder.add_material({.pattern = {.colors = {{r, g, b}}}});
    };
    const auto mirror = builder.add_material({.diffuse = 0, .reflectivity = 0.9F});
    const auto glass = builder.add_material({.ambient = 0,
                                             .diffuse = 0,
                                             .reflection = raylane::Reflection::schlick,
                                             .transmission = 1});
    builder.add(raylane::Plane{{0, 0, 0}, {0, 1, 0}}, color(0.8F, 0.75F, 0.65F));
    builder.add(raylane::Sphere{{-1.3F, 1, -0.8F}, 1}, mirror);
    builder.add(raylane::Sphere{{0.4F, 0.6F, 0.9F}, 0.6F}, glass);
    builder.add(raylane::CappedCylinder{{1.5F, 0, -0.4F}, {0, 1.4F, 0}, 0.5F}, mirror);
    builder.add(raylane::Sphere{{-0.6F, 0.3F, 1.3F}, 0.3F}, color(0.85F, 0.25F, 0.15F));
    builder.add(raylane::Sphere{{0.5F, 0.4F, -1.2F}, 0.4F}, color(0.2F, 0.5F, 0.3F));
    return builder.build();
}

} // namespace

int main() {
    const raylane::Scene scene = mirrors_and_glass();
    const raylane::Tracer tracer(scene);
    const raylane::Camera camera = scene.camera();
    const raylane::Settings settings = scene.settings();
    raylane::Image image{settings.width, settings.height, {}};

    // One ray through the middle of each pixel.
    const Vector from = wide(camera.from), forward = normalized(wide(camera.at) - from);
    const Vector right = normalized(cross(forward, wide(camera.up))), up = cross(right, forward);
    const double half = std::tan(camera.field_of_view * 3.14159265358979323846 / 360);
    const double pixel = half / settings.height;
    std::vector<Ray> rays;
    for (int y = 0; y < settings.height; ++y)
        for (int x = 0; x < settings.width; ++x) {
            const Vector offset = (2 * x + 1 - settings.width) * pixel * right +
                                  (settings.height - 2 * y - 1) * pixel * up;
            rays.push_back({from, normalized(forward + offset), INFINITY, rays.size(), {1, 1, 1}});
        }

    std::vector<Vector> sums(rays.size());
    for (int depth = 0; !rays.empty(); ++depth) {
        const std::vector<Hit> hits = intersect(tracer, rays);
        std::vector<Ray> shadows, next;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Vector w = rays[i].weight, sky = wide(scene.background());
            if (hits[i].any)
                shade(scene, rays[i], hits[i], shadows, next, sums);
            else
                sums[rays[i].pixel] =
                    sums[rays[i].pixel] + Vector{w.x * sky.x, w.y * sky.y, w.z * sky.z};
        }
        add_light(scene, tracer, std::move(shadows), sums);
        std::erase_if(next, [&](const Ray& ray) {
            const double most = std::max({ray.weight.x, ray.weight.y, ray.weight.z});
            return depth == settings.max_depth || most < settings.min_weight;
        });
        for (Ray& ray : next)
            ray.distance = INFINITY;
        rays = std::move(next);
    }

    for (const Vector& sum : sums)
        image.rgb.insert(image.rgb.end(), {float(sum.x), float(sum.y), float(sum.z)});
    raylane::write_image("path.png", image);

    const raylane::Image rendered = raylane::render(scene);
    std::size_t same = 0, apart = 0; // by more than 1e-5
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
        same += image.rgb[i] == rendered.rgb[i] ? 1 : 0;
        apart += std::abs(image.rgb[i] - rendered.rgb[i]) > 1e-5F ? 1 : 0;
    }
    std::printf("of %zu numbers %zu are those of raylane::render to the bit, %zu differ by more "
                "than 1e-5\n",
                image.rgb.size(), same, apart);
    return apart < image.rgb.size() / 10000 ? 0 : 1;
}
