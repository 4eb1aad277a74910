#include "core/scene/generators.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/json/reader.hpp"
#include "scenes/formats/scene_file.hpp"
#include "simd/query/scene_data.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/replaced_heap.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <malloc.h>
#include <mutex>
#include <random>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <utility>

/// Tests of memory use, in a separate program. They count the bytes of live allocations, less those
/// that are returned to the system.
namespace {

std::atomic<std::size_t> live = 0, peak = 0;

/// A part of a live allocation that was returned to the system.
struct GivenBack {
    const char* first = nullptr;
    std::size_t bytes = 0;
};
std::array<GivenBack, 16> given_back;
std::mutex giving_back;

} // namespace

void raylane::tests::has_taken(void* memory) {
    live += ::malloc_usable_size(memory);
    peak = std::max(peak.load(), live.load());
}

void raylane::tests::will_release(void* memory) {
    const std::size_t bytes = ::malloc_usable_size(memory);
    const auto* const first = static_cast<const char*>(memory);
    live -= bytes;
    const std::lock_guard lock(giving_back);
    for (GivenBack& part : given_back)
        if (part.bytes != 0 && part.first >= first && part.first < first + bytes)
            live += std::exchange(part.bytes, 0);
}

/// Replaces the C library's function, and counts the bytes that are returned.
extern "C" int madvise(void* memory, std::size_t bytes, int advice) noexcept {
    if (advice == MADV_DONTNEED) {
        const std::lock_guard lock(giving_back);
        const auto free = std::find_if(given_back.begin(), given_back.end(),
                                       [](const GivenBack& part) { return part.bytes == 0; });
        if (free == given_back.end()) std::abort();
        *free = {static_cast<const char*>(memory), bytes};
        live -= bytes;
    }
    return static_cast<int>(::syscall(SYS_madvise, memory, bytes, advice));
}

using namespace raylane;

namespace {

/// Limits in bytes for each sphere: for a finished scene, and for the peak while it is built. The
/// second pair is for packed spheres: for all that a tracer holds, and for the peak.
constexpr double max_bytes = 40.0, max_at_peak = 2.5 * max_bytes;
constexpr double max_packed_bytes = 20.0, max_at_packed_peak = 60.0;

template <class Fill>
void check_memory(const Fill& fill) {
    const std::size_t before = live;
    peak = before;
    core::SceneBuilder builder;
    builder.wants_light = false;
    builder.add_material({});
    fill(builder);
    const core::Scene scene = std::move(builder).build();
    const auto each = [&](std::size_t bytes) {
        return static_cast<double>(bytes) / static_cast<double>(scene.shape_count());
    };
    CAPTURE(scene.shape_count(), each(scene.bytes()), each(live - before), each(peak - before));
    CHECK(each(scene.bytes()) <= max_bytes);
    CHECK(each(peak - before) <= max_at_peak);
    // The reported bytes are those that the scene holds, but for an overhead that does not grow
    // with it: mostly memory that the heap spends on aligning huge pages.
    constexpr std::size_t overhead = std::size_t{3} << 20;
    CHECK(scene.bytes() <= live - before);
    CHECK(live - before <= scene.bytes() + overhead);
}

void add_uniform(core::SceneBuilder& builder, int count) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    builder.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        const float x = uniform(engine), y = uniform(engine), z = uniform(engine);
        builder.add(core::Sphere{{x, y, z}, 0.3F / std::cbrt(static_cast<float>(count))}, 0);
    }
}

/// Adds atoms of six elements around the origin, in a file's order. They are a little off the sites
/// of a crystal.
void add_atoms(core::SceneBuilder& builder, int side) {
    constexpr float radii[] = {1.7F, 1.55F, 1.52F, 1.1F, 1.8F, 2.0F};
    std::mt19937 engine(2);
    std::normal_distribution<double> off(0.0, 0.2);
    for (std::size_t i = 1; i < std::size(radii); ++i)
        builder.add_material({});
    for (int z = 0; z < side; ++z)
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const auto at = [&](int place) {
                    return static_cast<float>(2.5 * (place - side / 2) + off(engine));
                };
                const auto element = static_cast<core::MaterialIndex>((x + 3 * y + 5 * z) % 6);
                builder.add(core::Sphere{{at(x), at(y), at(z)}, radii[element]}, element);
            }
}

template <class Fill>
void check_packed_memory(const Fill& fill) {
    const std::size_t before = live;
    peak = before;
    core::SceneBuilder builder;
    builder.wants_light = false;
    builder.pack_from = 1'000'000;
    builder.add_material({});
    fill(builder);
    const core::Scene scene = std::move(builder).build();
    REQUIRE(std::get<core::Table<core::Sphere>>(scene.shapes()).is_packed());
    const std::size_t of_scene = live - before, at_peak = peak - before;
    const simd::SceneData data(scene);
    const auto each = [&](std::size_t bytes) {
        return static_cast<double>(bytes) / static_cast<double>(scene.shape_count());
    };
    CAPTURE(scene.shape_count(), each(scene.bytes()), each(of_scene), each(live - before),
            each(at_peak));
    CHECK(scene.bytes() <= of_scene);
    CHECK(each(live - before) <= max_packed_bytes);
    CHECK(each(at_peak) <= max_at_packed_peak);
}

} // namespace

TEST_CASE("JSON takes no more memory if objects come before the materials") {
    constexpr std::size_t count = 200'000;
    const std::string objects = [] {
        std::string text = R"("objects": [)";
        for (std::size_t i = 0; i < count; ++i)
            text.append(i == 0 ? "" : ",")
                .append(R"({"type": "sphere", "material": "m)" + std::to_string(i % 9) +
                        R"(", "radius": 1, "center": [)" + std::to_string(i) + ", 0, 0]}");
        return text + "]";
    }();
    std::string materials = R"("materials": {"m0": {})";
    for (int i = 1; i < 9; ++i)
        materials += ", \"m" + std::to_string(i) + "\": {}";
    materials += "}";
    const std::string start = R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0]},
        "lights": [{"type": "directional", "direction": [0, 0, 1]}], )";
    for (const bool objects_first : {false, true}) {
        const tests::TemporaryFile written(start + (objects_first ? objects : materials) + ", " +
                                           (objects_first ? materials : objects) + "}");
        scenes::InputFile file(written.path());
        const std::size_t before = live;
        peak = before;
        const core::Scene scene = scenes::read_json(file);
        const double each = static_cast<double>(peak - before) / static_cast<double>(count);
        CAPTURE(objects_first, each);
        REQUIRE(scene.shape_count() == count);
        CHECK(each <= max_at_peak);
    }
}

TEST_CASE("a sphere takes at most 40 bytes and 100 while the scene is built") {
    for (const int count : {20'000, 200'000, 1'000'000})
        check_memory([&](core::SceneBuilder& builder) { add_uniform(builder, count); });
    for (const int depth : {5, 6})
        check_memory([&](core::SceneBuilder& builder) {
            core::add(builder, core::Sphereflake{{0, 0, 0}, 1.0F, depth}, 0);
        });
}

TEST_CASE("each of four million packed spheres takes at "
          "most 20 bytes with all that rendering needs") {
    // The unused rest of each table's last huge page is random: 2 MiB at most.
    check_packed_memory([&](core::SceneBuilder& builder) { add_uniform(builder, 4'000'000); });
    check_packed_memory([&](core::SceneBuilder& builder) { add_atoms(builder, 160); });
}

namespace {

std::string repeated(int times, const std::string& text) {
    std::string joined;
    for (int i = 0; i < times; ++i)
        joined += text;
    return joined;
}

/// A row of the table in SECURITY.md, and a file to test it with.
struct Budget {
    std::string name, text; ///< of a file
    double bytes_for_each;
    double megabytes = 16; ///< in addition
};

void check_budget(const Budget& file) {
    const std::size_t before = live;
    peak = before;
    std::string refused;
    try {
        scenes::parse_scene(file.name, file.text, {.on_remark = [](const std::string&) {}});
    } catch (const scenes::BadInput& bad) {
        refused = std::string(bad.what()).substr(0, 200);
    }
    const auto bytes = static_cast<double>(peak - before);
    const auto size = static_cast<double>(file.text.size());
    CAPTURE(file.name, file.text.substr(0, 200), size, bytes, bytes / size, refused);
    CHECK(bytes <= file.bytes_for_each * size + file.megabytes * (1 << 20));
}

} // namespace

TEST_CASE("reading a file takes no more memory than SECURITY.md states") {
    constexpr int many = 30'000;
    const std::string json = R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0]}, "lights": [],
        "materials": {"m": {}}, "objects": [)";
    const std::string sphere =
        R"({"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "m"},)";
    const std::string camera = "camera { location 1 look_at 0 }\n";
    const std::string cell =
        "data_a\n_cell_length_a 9\n_cell_length_b 9\n_cell_length_c 9\n_cell_angle_alpha 90\n"
        "_cell_angle_beta 90\n_cell_angle_gamma 90\n_symmetry_space_group_name_H-M 'F m -3 m'\n"
        "loop_\n_atom_site_label\n_atom_site_fract_x\n_atom_site_fract_y\n_atom_site_fract_z\n";
    const std::string places = "data_a\nloop_\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n"
                               "_atom_site.Cartn_z\n";
    std::string sites, named, atoms, residues;
    for (int i = 0; i < many / 10; ++i)
        sites += "C ." + std::to_string(i + 1000) + " ." + std::to_string(2 * i + 1000) + " ." +
                 std::to_string(3 * i + 1000) + "\n";
    for (int i = 0; i < many; ++i)
        named += "#declare A" + std::to_string(i) + " = 1;";
    for (int i = 1; i <= many; ++i)
        atoms += std::to_string(i) + " 1 1 1 1\n";
    for (int i = 1; i <= 10 * many; ++i)
        residues += "0 0 0 " + std::to_string(i) + "\n";
    const std::string box = "ITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\n";
    const std::string count = std::to_string(many);
    const std::string title = repeated(50, "TITLE     " + std::string(70, 'A') + "\n");
    for (const Budget& file : {
             Budget{"a.json",
                    json + repeated(many, sphere) + sphere.substr(0, sphere.size() - 1) + "]}", 64},
             Budget{"a.json",
                    json + R"({"type": "union", "material": "m", "objects": [)" +
                        repeated(many, sphere) + sphere.substr(0, sphere.size() - 1) + "]}]}",
                    64},
             Budget{"a.json", repeated(many, "["), 64},
             Budget{"a.json", R"({"camera": {"from": [)" + repeated(many, "1,"), 64},
             Budget{"a.nff",
                    "v\nfrom 0 0 9\nat 0 0 0\nup 0 1 0\nangle 40\nhither 1\nresolution 9 9\nl 9 9 "
                    "9\nf 1 1 1 1 0 0 0 0\n" +
                        repeated(many, "s 0 0 0 1\n"),
                    64},
             Budget{"a.pov", camera + repeated(many, "sphere{0,1}"), 64},
             Budget{"a.pov", camera + "union{" + repeated(many, "sphere{0,1}") + "}", 64},
             Budget{"a.pov", camera + "mesh{" + repeated(many, "triangle{0,x,y}") + "}", 64},
             Budget{"a.pov", camera + named, 64},
             Budget{"a.pov", camera + "#while(1)sphere{0,1}#end", 64, 640},
             Budget{"a.pov", "union{#while(1)sphere{0,1}#end}", 64, 640},
             Budget{"a.pov",
                    "#declare A=array[1000000];#for(I,0,999999)#declare A[I]=array[9];#end", 64,
                    640},
             Budget{"a.pov", "#for(I,0,1e7)sphere{0,1 pigment{rgb I}}#end", 64, 640},
             Budget{"a.dat",
                    "BEGIN_SCENE\n" +
                        repeated(many, "SPHERE CENTER 0 0 0 RAD 1 TEXTURE AMBIENT 0 DIFFUSE 1 "
                                       "SPECULAR 0 OPACITY 1 COLOR 1 1 1 TEXFUNC 0\n") +
                        "END_SCENE",
                    64},
             Budget{"a.pdb",
                    repeated(many, "ATOM      1  C   ALA A   1       0.000   0.000   0.000\n"), 64},
             Budget{"a.pdb",
                    title +
                        repeated(many,
                                 "END\nATOM      1  C   A   A   1       0.000   0.000   0.000\n"),
                    64},
             Budget{"a.pdb",
                    title +
                        repeated(many,
                                 "MODEL\nATOM      1  C   A   A   1       0.000   0.000   0.000\n"),
                    64},
             Budget{"a.cif", cell + sites, 2048},
             Budget{"a.cif", places + repeated(10 * many, "0 0 0\n"), 64},
             Budget{"a.cif", places + "_atom_site.auth_seq_id\n" + residues, 64},
             Budget{"a.xyz", count + "\n\n" + repeated(many, "C 0 0 0\n"), 64},
             Budget{"a.xyz", "2000000000\n\nC 0 0 0\n", 64},
             Budget{"a.gro",
                    "a\n" + count + "\n" +
                        repeated(many, "    1AAA      C    1   0.000   0.000   0.000\n") +
                        "9 9 9\n",
                    64},
             Budget{"a.gro", "a\n2000000000\n", 64},
             Budget{"a.lammpstrj",
                    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" + count + "\n" + box +
                        "ITEM: ATOMS type x y z\n" + repeated(many, "1 1 1 1\n"),
                    64},
             Budget{"a.lammpstrj",
                    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2000000000\n" + box +
                        "ITEM: ATOMS type x y z\n1 1 1 1\n",
                    64},
             Budget{"a.lammpstrj",
                    "ITEM: NUMBER OF ATOMS\n2000000000\n" + box + "ITEM: ATOMS x y z" +
                        repeated(5 * many, " a") + "\n" + repeated(5 * many + 3, "1 ") + "\n",
                    64},
             Budget{"a.lmp",
                    "a\n\n" + count +
                        " atoms\n1 atom types\n0 9 xlo xhi\n0 9 ylo yhi\n0 9 zlo zhi\n\nAtoms # "
                        "atomic\n\n" +
                        atoms,
                    64},
             Budget{"a.lmp",
                    "a\n\n2000000000 atoms\n2000000000 bonds\n1 atom types\n0 9 xlo xhi\n0 9 ylo "
                    "yhi\n0 9 zlo zhi\n\nAtoms # atomic\n\n1 1 1 1 1\n",
                    64},
         })
        check_budget(file);
}
