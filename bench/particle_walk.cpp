#include "raylane/raylane.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

/// Follows particles through a lattice of a reactor's pin cells: planes, nested cylinders, and rows
/// of nested spheres that touch each other and the shapes around them. Each flight goes from a
/// point to infinity, in double, and crosses surfaces in the rows of Tracer::crossings.
/// Tracer::contains tells which solids it starts in. From then on, a solid may only be entered from
/// the outside and left from the inside, t may never fall, and far away no solid may be around the
/// particle. A particle for which this fails is lost.
///
/// usage: raylane-particle-walk [STEPS]   crossings, default 1e8. Exit code 1: a particle was lost.
namespace raylane::bench {
namespace {

constexpr int across = 6;
constexpr float pitch = 1.25F, height = 8.0F;

/// All solids, in nests of three, and planes between the cells.
struct Lattice {
    Scene scene;
    std::size_t solids;
    std::vector<ShapeId> planes;
};

Lattice make_lattice() {
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    for (int i = 0; i < across; ++i)
        for (int j = 0; j < across; ++j) {
            const float x = pitch * static_cast<float>(i), y = pitch * static_cast<float>(j);
            for (const float radius : {0.5F, 0.5625F, 0.625F}) // the last touches its neighbours
                builder.add(CappedCylinder{{x, y, 0}, {0, 0, height}, radius}, material);
            for (int k = 0; k < 8; ++k)
                for (const float radius : {0.25F, 0.375F, 0.5F}) // in the pin, and touching it
                    builder.add(Sphere{{x, y, static_cast<float>(k) + 0.5F}, radius}, material);
        }
    const std::size_t solids = builder.shape_count();
    std::vector<ShapeId> planes;
    for (int i = 0; i <= across; ++i) {
        const float at = pitch * (static_cast<float>(i) - 0.5F);
        planes.push_back(builder.add(Plane{{at, 0, 0}, {1, 0, 0}}, material));
        planes.push_back(builder.add(Plane{{0, at, 0}, {0, 1, 0}}, material));
    }
    for (int k = 0; k <= 8; ++k)
        planes.push_back(builder.add(Plane{{0, 0, static_cast<float>(k)}, {0, 0, 1}}, material));
    return {builder.build(), solids, planes};
}

class Random {
  public:
    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    }
    int integer(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }

  private:
    std::mt19937_64 engine_{20261124};
};

struct Flights {
    std::vector<double> values[6]; ///< origins, directions

    std::size_t size() const { return values[0].size(); }
    DoubleRaySpan rays() const {
        return {values[0], values[1], values[2], values[3], values[4], values[5]};
    }
    DoublePointSpan origins() const { return {values[0], values[1], values[2]}; }
    void add(const double (&ray)[6]) {
        for (int i = 0; i < 6; ++i)
            values[i].push_back(ray[i]);
    }
};

/// Makes flights. Half of them go from anywhere to anywhere. The others go from and to places where
/// surfaces meet, or along surfaces; some of these are an ulp beside.
Flights make_flights(std::size_t count, Random& random) {
    Flights flights;
    const double size = static_cast<double>(pitch) * across;
    const auto on_grid = [&](double step, int steps) { return step * random.integer(steps); };
    for (std::size_t n = 0; n < count; ++n) {
        double ray[6];
        for (int axis = 0; axis < 3; ++axis) {
            ray[axis] = random.uniform(-1.0, size);
            ray[3 + axis] = random.uniform(-1.0, 1.0);
        }
        if (n % 2 == 1) {
            double to[3];
            for (int axis = 0; axis < 2; ++axis) {
                ray[axis] = on_grid(0.0625, 100) - 0.625;
                to[axis] = on_grid(0.0625, 100) - 0.625;
            }
            ray[2] = on_grid(0.25, 33);
            to[2] = on_grid(0.25, 33);
            for (int axis = 0; axis < 3; ++axis)
                ray[3 + axis] = to[axis] - ray[axis];
            if (n % 4 == 1) {
                double& component = ray[random.integer(6)];
                component = component == 0.0
                                ? 0x1p-60
                                : std::nextafter(component, random.integer(2) == 0 ? -99.0 : 99.0);
            }
        }
        if (ray[3] == 0.0 && ray[4] == 0.0 && ray[5] == 0.0) ray[5] = 1.0;
        flights.add(ray);
    }
    return flights;
}

struct Tally {
    std::uint64_t flights = 0, steps = 0, ties = 0, touches = 0, lost = 0;
    CrossingStatistics by{};
};

/// Known position of a particle, relative to a shape.
enum class Where : std::uint8_t { outside, inside, on_surface };

/// Returns true if a shape may be crossed in this direction from there. The particle is on the
/// other side then.
bool crosses(Where& where, bool entering) {
    const Where before = where;
    where = entering ? Where::inside : Where::outside;
    return before == Where::on_surface || before == (entering ? Where::outside : Where::inside);
}

bool is_kept(const Lattice& lattice, const Flights& flights, std::size_t i, const SolidRows& in,
             const CrossingRows& rows, std::vector<Where>& where, Tally& tally) {
    std::fill(where.begin(), where.end(), Where::outside);
    for (std::uint64_t k = in.first[i]; k < in.first[i + 1]; ++k)
        where[in.shape_id[k]] = in.on_surface[k] != 0 ? Where::on_surface : Where::inside;
    for (const ShapeId plane : lattice.planes) {
        const std::size_t n = plane - lattice.planes.front();
        const std::size_t grid = 2 * (across + 1);
        const std::size_t axis = n < grid ? n % 2 : 2;
        const double at = axis == 2
                              ? static_cast<double>(n - grid)
                              : static_cast<double>(pitch) * (static_cast<double>(n / 2) - 0.5);
        const double from = flights.values[axis][i];
        where[plane] = from < at ? Where::inside : from > at ? Where::outside : Where::on_surface;
    }
    double last = 0.0;
    for (std::uint64_t k = rows.first[i]; k < rows.first[i + 1]; ++k) {
        ++tally.steps;
        tally.ties += rows.tied[k];
        tally.touches += rows.touching[k];
        if (!(rows.t[k] >= last) || (rows.tied[k] != 0 && rows.t[k] != last)) return false;
        last = rows.t[k];
        if (!crosses(where[rows.shape_id[k]], rows.entering[k] != 0)) return false;
    }
    return std::all_of(where.begin(), where.begin() + static_cast<std::ptrdiff_t>(lattice.solids),
                       [](Where w) { return w != Where::inside; });
}

int walk(std::uint64_t steps) {
    const Lattice lattice = make_lattice();
    const Tracer tracer(lattice.scene);
    Random random;
    Tally tally;
    std::vector<Where> where(lattice.scene.shape_count());
    CrossingRows rows;
    SolidRows in;
    const auto start = std::chrono::steady_clock::now();
    double seconds = 0.0;
    while (tally.steps < steps) {
        const Flights flights = make_flights(1 << 16, random);
        const auto before = std::chrono::steady_clock::now();
        CrossingStatistics by;
        tracer.crossings(flights.rays(), rows, {}, &by);
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
        tally.by.by_bounds += by.by_bounds;
        tally.by.by_digits += by.by_digits;
        tally.by.exactly += by.exactly;
        tally.by.beyond_double += by.beyond_double;
        tracer.contains(flights.origins(), in);
        for (std::size_t i = 0; i < flights.size(); ++i) {
            ++tally.flights;
            if (is_kept(lattice, flights, i, in, rows, where, tally)) continue;
            if (tally.lost++ == 0) {
                std::printf("lost:");
                for (const auto& value : flights.values)
                    std::printf(" %a", value[i]);
                std::printf("\n");
            }
        }
    }
    const auto count = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    std::printf("%llu steps in %llu flights, %llu tied and %llu touching, %llu lost; compared by "
                "bounds %llu, by digits %llu, exactly %llu times; %llu solved beyond double; "
                "%.3g s, of which crossings %.3g\n",
                count(tally.steps), count(tally.flights), count(tally.ties), count(tally.touches),
                count(tally.lost), count(tally.by.by_bounds), count(tally.by.by_digits),
                count(tally.by.exactly), count(tally.by.beyond_double),
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
                seconds);
    return tally.lost == 0 ? 0 : 1;
}

} // namespace
} // namespace raylane::bench

int main(int argc, char** argv) {
    const double steps = argc > 1 ? std::strtod(argv[1], nullptr) : 1e8;
    if (!(steps > 0.0 && steps < 1e18)) {
        std::fprintf(stderr, "raylane-particle-walk: a number of steps is wanted\n");
        return 2;
    }
    return raylane::bench::walk(static_cast<std::uint64_t>(steps));
}
