#include "core/scene/transfer.hpp"
#include "simd/wavefront/render.hpp"
#include "tests/scenes/formats/json/json_scenes.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

// Tests of pixels against the shading equation in README.md and in the schema's "material".

using namespace raylane;
using Vector = core::Vec3d;

namespace {

constexpr std::array both_engines = {simd::Engine::vector, simd::Engine::reference};

/// Returns the color of the one pixel of a scene. Its ray is the camera's axis.
Vector pixel(const std::string& items, simd::Engine engine, int max_depth = 100) {
    const core::Scene scene = tests::scene_of(
        R"({"image": {"width": 1, "height": 1}, "limits": {"min_weight": 0, "max_depth": )" +
        std::to_string(max_depth) + "}, " + items + "}");
    return core::convert<double>(
        simd::render(scene, scene.settings(), {.engine = engine, .threads = 1}).film.at(0, 0));
}

std::string camera(const std::string& from, const std::string& at) {
    return R"("camera": {"type": "orthographic", "from": )" + from + R"(, "at": )" + at +
           R"(, "up": [0.1, 0.2, 0.3], "height": 1e-9})";
}

bool is_near(const Vector& found, const Vector& expected, double relative = 1e-6) {
    for (int channel = 0; channel < 3; ++channel)
        if (!(std::abs(found[channel] - expected[channel]) <= relative * expected[channel]))
            return false;
    return true;
}

void check(const std::string& items, const Vector& expected, int max_depth = 100) {
    for (const simd::Engine engine : both_engines) {
        const Vector found = pixel(items, engine, max_depth);
        CAPTURE(engine == simd::Engine::vector, found.x, found.y, found.z, expected.x, expected.y,
                expected.z);
        CHECK(is_near(found, expected));
    }
}

/// The unit vector to a light, its color, and V: the share of its light that arrives.
struct Lit {
    Vector to_light;
    Vector color;
    double let_through = 1.0;
};

struct Surface {
    Vector color;
    double ambient, diffuse, specular, exponent;

    /// The terms of a surface's own light. `normal`, `to_viewer`: unit.
    Vector own(const Vector& normal, const Vector& to_viewer,
               const std::vector<Lit>& lights) const {
        Vector sum = ambient * color;
        for (const Lit& light : lights) {
            const double cos_light = core::dot(normal, light.to_light);
            if (cos_light <= 0.0) continue;
            const Vector halfway = core::normalized(Vector(light.to_light + to_viewer));
            const double cos_halfway = std::max(core::dot(normal, halfway), 0.0);
            sum +=
                light.let_through * light.color *
                (diffuse * cos_light * color + Vector(specular * std::pow(cos_halfway, exponent)));
        }
        return sum;
    }
};

double fresnel(double cos_1, double n1, double n2) {
    const double sine = n1 / n2 * std::sqrt(1.0 - cos_1 * cos_1);
    const double cos_2 = std::sqrt(1.0 - sine * sine);
    const double s = (n1 * cos_1 - n2 * cos_2) / (n1 * cos_1 + n2 * cos_2);
    const double p = (n1 * cos_2 - n2 * cos_1) / (n1 * cos_2 + n2 * cos_1);
    return 0.5 * (s * s + p * p);
}

double schlick(double cos_1, double n1, double n2) {
    const double at_normal = std::pow((n1 - n2) / (n1 + n2), 2.0);
    return at_normal + (1.0 - at_normal) * std::pow(1.0 - cos_1, 5.0);
}

const std::string no_lights = R"("lights": [], )";
const std::string back = R"("background": [0.5, 0.75, 1], )";
const Vector background(0.5, 0.75, 1.0);

} // namespace

TEST_CASE("Ambient and diffuse and specular light add up as the shading equation says") {
    const Surface surface{{0.5, 0.25, 1.0}, 0.125, 0.75, 0.625, 8.0};
    const std::string material =
        R"({"color": [0.5, 0.25, 1], "ambient": 0.125, "diffuse": 0.75, "specular": 0.625,
            "exponent": 8})";
    const Vector up(0.0, 1.0, 0.0), to_viewer(0.0, 0.6, 0.8);
    // A point light at any distance, a directional one, and one below the surface.
    for (const char* place : {"[3, 4, 0]", "[30, 40, 0]"})
        check(camera("[0, 3, 4]", "[0, 0, 0]") + R"(, "lights": [
                  {"type": "point", "position": )" +
                  place + R"(, "color": [2, 1, 0.5]},
                  {"type": "directional", "direction": [0, -2, 0], "color": [0.25, 0.5, 1]},
                  {"type": "directional", "direction": [0, 1, 3], "color": [9, 9, 9]}],
              "objects": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "material": )" +
                  material + "}]",
              surface.own(up, to_viewer,
                          {{{0.6, 0.8, 0.0}, {2.0, 1.0, 0.5}}, {up, {0.25, 0.5, 1.0}}}));
}

TEST_CASE("Reflected light is added in full and a color may exceed 1") {
    const Surface surface{Vector(1.0), static_cast<double>(0.1F), static_cast<double>(0.8F), 0.0,
                          32.0};
    const Vector up(0.0, 1.0, 0.0), to_viewer(0.0, 0.6, 0.8);
    const auto scene = [&](const std::string& how) {
        return camera("[0, 3, 4]", "[0, 0, 0]") + ", " + back +
               R"("lights": [{"type": "directional", "direction": [0, -1, 0]}],
                  "objects": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0],
                               "material": {)" +
               how + "}}]";
    };
    const Vector own = surface.own(up, to_viewer, {{up, Vector(1.0)}});
    const Vector mirror = own + 0.5 * background;
    check(scene(R"("reflectivity": 0.5)"), mirror);
    REQUIRE(mirror.z > 1.0);
    const auto code = [](double x) {
        return core::encode(static_cast<float>(x), core::Transfer::srgb);
    };
    CHECK(code(mirror.z) == 255);
    CHECK(code(mirror.z) == code(1.0));
    check(scene(R"("reflection": "schlick", "index": 1.75)"),
          own + schlick(0.6, 1.0, 1.75) * background);
    check(scene(R"("reflection": "dielectric", "index": 1.75)"),
          own + fresnel(0.6, 1.0, 1.75) * background);
}

TEST_CASE("Each surface of a glass block follows the shading equation") {
    const double n = 1.5, R = std::pow((n - 1.0) / (n + 1.0), 2.0), T = 0.75;
    const Vector inside(std::exp(-0.25 * 2.0), std::exp(-0.5 * 2.0), 1.0);
    const Vector own(0.125, 0.0625, 0.25);
    for (const char* reflection : {"schlick", "dielectric"}) {
        // Light goes to and fro inside.
        const Vector twice =
            inside * (own + (1.0 - R) * T * background) / (Vector(1.0) - R * inside);
        check(camera("[0, 0, 5]", "[0, 0, 0]") + ", " + back + no_lights + R"(
              "objects": [{"type": "box", "min": [-3, -3, -1], "max": [3, 3, 1], "material": {
                  "color": [0.5, 0.25, 1], "ambient": 0.25, "diffuse": 0, "index": 1.5,
                  "transmission": 0.75, "absorption": [0.25, 0.5, 0], "reflection": ")" +
                  reflection + R"("}}])",
              own + R * background + (1.0 - R) * T * twice);
    }
}

TEST_CASE("Total internal reflection weighs 1 and rays beyond the depth limit add nothing") {
    const double own = 0.25;
    const auto left = [](double length) { return std::exp(-0.125 * length); };
    // Inside of a block: two total reflections, then a face that lets light out, and reflects.
    const double way_1 = 1.0 / 0.6, way_2 = 2.0 / 0.6, way_3 = (5.0 - 4.0) / 0.8,
                 way_4 = (1.0 + 1.0 - 0.6 * way_3) / 0.6;
    const auto expected = [&](double sky) {
        const double deepest = left(way_4) * own;
        const double at_end = left(way_3) * (own + 0.125 * deepest + 0.875 * 0.75 * sky);
        return left(way_1) * (own + left(way_2) * (own + at_end));
    };
    check(camera("[0, 0, 0]", "[0.8, -0.6, 0]") + ", " + back + no_lights + R"(
          "objects": [{"type": "box", "min": [-5, -1, -5], "max": [5, 1, 5], "material": {
              "ambient": 0.25, "diffuse": 0, "index": 1.5, "reflectivity": 0.125,
              "transmission": 0.75, "absorption": [0.125, 0.125, 0.125]}}])",
          {expected(background.x), expected(background.y), expected(background.z)}, 3);
}

TEST_CASE("Light through panes is weighed by V of the shading equation") {
    const Surface surface{Vector(1.0), 0.125, 0.5, 0.0, 32.0};
    const Vector up(0.0, 1.0, 0.0), to_viewer(0.8, 0.6, 0.0);
    const auto scene = [&](const std::string& pane) {
        return camera("[8, 6, 0]", "[0, 0, 0]") + R"(,
            "lights": [{"type": "directional", "direction": [0, -1, 0]}], "objects": [
            {"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0],
             "material": {"ambient": 0.125, "diffuse": 0.5}},
            {"type": "box", "min": [-0.5, 1, -0.5], "max": [0.5, 2, 0.5], "material": )" +
               pane + "}]";
    };
    const double R = fresnel(1.0, 1.0, 1.5), surfaces = std::pow((1.0 - R) * 0.75, 2.0);
    const auto shows = [&](const std::string& pane, const Vector& V) {
        check(scene(pane), surface.own(up, to_viewer, {{up, V}}));
    };
    shows("{}", Vector(0.0));
    shows(R"({"transmission": 0.75, "reflection": "dielectric", "absorption": [0.5, 1, 0]})",
          surfaces * Vector(std::exp(-0.5), std::exp(-1.0), 1.0));
    shows(R"({"opacity": 0.25})", Vector(0.75 * 0.75));
    shows(R"({"opacity": 0.25, "transmission": 0.5})", Vector(std::pow(0.75 + 0.25 * 0.5, 2.0)));
}

TEST_CASE("Opacity and fog weigh colors as the shading equation says") {
    const std::string objects = R"("objects": [
        {"type": "disc", "center": [0, 0, 3], "normal": [0, 0, 1], "radius": 1,
         "material": {"color": [1, 0.5, 0.25], "ambient": 1, "diffuse": 0, "opacity": 0.25}},
        {"type": "plane", "point": [0, 0, 0], "normal": [0, 0, 1],
         "material": {"color": [0.5, 0.25, 0.75], "ambient": 1, "diffuse": 0,
                      "reflectivity": 0.5}}])";
    const Vector disc(1.0, 0.5, 0.25), plane(0.5, 0.25, 0.75), fog(0.125, 0.25, 0.375);
    const auto scene = [&](const std::string& with) {
        return camera("[0, 0, 5]", "[0, 0, 0]") + ", " + back + no_lights + with + objects;
    };
    // The mirrored ray meets the disc from behind, 3 away.
    const auto shows = [&](const std::string& with, const auto& share, double at_infinity) {
        const auto in_fog = [&](double distance, const Vector& color) {
            return Vector(share(distance) * fog + (1.0 - share(distance)) * color);
        };
        const Vector sky = at_infinity * fog + (1.0 - at_infinity) * background;
        const Vector mirrored = 0.25 * in_fog(3.0, disc) + 0.75 * sky;
        check(scene(with), 0.25 * in_fog(2.0, disc) + 0.75 * in_fog(5.0, plane + 0.5 * mirrored));
    };
    const std::string color = R"("color": [0.125, 0.25, 0.375])";
    shows(
        "", [](double) { return 0.0; }, 0.0);
    shows(R"("fog": {"type": "exponential", "density": 0.125, )" + color + "}, ",
          [](double distance) { return 1.0 - std::exp(-0.125 * distance); }, 1.0);
    shows(R"("fog": {"type": "linear", "start": 1, "end": 9, )" + color + "}, ",
          [](double distance) { return (distance - 1.0) / 8.0; }, 1.0);
}

TEST_CASE("Surfaces in contact are both shaded") {
    // At the contact, the surface that is entered comes before the one that is left.
    const Vector red(1.0, 0.0, 0.0), green(0.0, 1.0, 0.0);
    const auto box = [](const char* from, const char* to, const char* color) {
        return std::string(R"({"type": "box", "min": [)") + from + R"(, -1, -1], "max": [)" + to +
               R"(, 1, 1], "material": {"ambient": 1, "diffuse": 0, "index": 1.5,
                   "transmission": 0.5, "color": )" +
               color + "}}";
    };
    check(camera("[-3, 0.125, 0.25]", "[0, 0.125, 0.25]") + ", " + no_lights + R"("objects": [)" +
              box("0", "1", "[1, 0, 0]") + ", " + box("1", "2", "[0, 1, 0]") + "]",
          red + 0.5 * (green + 0.5 * (red + 0.5 * green)));
}

TEST_CASE("A face on an edge of a checker's cells has the color of the cell that holds the edge") {
    const auto scene = [](const std::string& upper_edges) {
        return camera("[0.5, 0.5, 9]", "[0.5, 0.5, 0]") + ", " + no_lights + R"("objects": [
            {"type": "box", "min": [-1, -1, -1], "max": [1, 1, 2], "material": {
                "ambient": 1, "diffuse": 0, "pattern": {"type": "checker", "size": 1,
                "axes": "xyz", "colors": [[1, 0, 0], [0, 1, 0]])" +
               upper_edges + "}}}]";
    };
    check(scene(""), Vector(1.0, 0.0, 0.0));
    check(scene(R"(, "upper_edges": "z")"), Vector(0.0, 1.0, 0.0));
}

TEST_CASE("Lights with a size give the mean over their directions") {
    const auto scene = [](const std::string& light) {
        return camera("[0, 3, 4]", "[0, 0, 0]") +
               R"(, "sampling": {"light_samples": 1024}, "lights": [)" + light + R"(],
            "objects": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0],
                         "material": {"color": [0.5, 0.25, 1], "ambient": 0.125, "diffuse": 0.5,
                                      "specular": 0.5}}])";
    };
    const Vector color(0.5, 0.25, 1.0), ambient = 0.125 * color;
    // The sky, without a specular term.
    check(scene(R"({"type": "sky", "color": [1, 2, 3], "ground": [1, 2, 3]})"),
          ambient + 0.5 * color * Vector(1.0, 2.0, 3.0));
    // A ball above: radiance (r / d)^2 cos, and the highlight's mean, without the cosine.
    const double r = 0.25, d = 8.0, power = 3.0;
    const Vector halfway = core::normalized(Vector(0.0, 1.6, 0.8));
    const double highlight = 0.5 * std::pow(halfway.y, 32.0);
    const Vector expected = ambient + power * (r * r) / (d * d) * (0.5 * color + Vector(highlight));
    for (const simd::Engine engine : both_engines)
        CHECK(is_near(pixel(scene(R"({"type": "sphere", "position": [0, 8, 0], "radius": 0.25,
                                      "color": [3, 3, 3]})"),
                            engine),
                      expected, 2e-3));
}
