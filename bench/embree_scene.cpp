#include "bench/embree_scene.hpp"

#include "bench/by_id.hpp"

#include <algorithm>
#include <string>

namespace raylane::bench {

namespace {

void put(float* to, const core::Vec3f& v) {
    for (int axis = 0; axis < 3; ++axis)
        to[axis] = v[axis];
}

/// The buffers of one geometry of `count` shapes: in huge pages, which Embree's own are not.
template <class Shape>
class Buffers {
  public:
    /// Adds the memory to `keeper`, which has to exist as long as the geometry.
    Buffers(RTCGeometry geometry, std::size_t count,
            std::vector<core::BigArray<std::byte>>& keeper) {
        const auto make = [&](RTCBufferType buffer, RTCFormat format, std::size_t stride,
                              std::size_t items) -> void* {
            constexpr std::size_t padding = 16; // Embree reads whole registers
            std::byte* const memory = keeper.emplace_back(stride * items + padding).data();
            rtcSetSharedGeometryBuffer(geometry, buffer, 0, format, memory, 0, stride, items);
            return memory;
        };
        const auto vertices = [&](RTCFormat format, std::size_t stride, std::size_t items) {
            return static_cast<float*>(make(RTC_BUFFER_TYPE_VERTEX, format, stride, items));
        };
        if constexpr (type == RTC_GEOMETRY_TYPE_TRIANGLE) {
            vertices_ = vertices(RTC_FORMAT_FLOAT3, 12, 3 * count);
            indices_ =
                static_cast<unsigned*>(make(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, 12, count));
        } else if constexpr (type == RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE) {
            vertices_ = vertices(RTC_FORMAT_FLOAT4, 16, 2 * count);
            indices_ =
                static_cast<unsigned*>(make(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, 4, count));
        } else {
            vertices_ = vertices(RTC_FORMAT_FLOAT4, 16, count);
            if constexpr (type == RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT)
                normals_ =
                    static_cast<float*>(make(RTC_BUFFER_TYPE_NORMAL, RTC_FORMAT_FLOAT3, 12, count));
        }
    }

    void set(unsigned i, const Shape& shape) const {
        if constexpr (type == RTC_GEOMETRY_TYPE_TRIANGLE) {
            const core::Vec3f* const corners[] = {&shape.a, &shape.b, &shape.c};
            for (unsigned corner = 0; corner < 3; ++corner) {
                put(vertices_ + 9 * i + 3 * corner, *corners[corner]);
                indices_[3 * i + corner] = 3 * i + corner;
            }
        } else if constexpr (type == RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE) {
            put(vertices_ + 8 * i, shape.base);
            put(vertices_ + 8 * i + 4, shape.base + shape.axis);
            if constexpr (requires { shape.radius; }) {
                vertices_[8 * i + 3] = vertices_[8 * i + 7] = shape.radius;
            } else {
                vertices_[8 * i + 3] = shape.base_radius;
                vertices_[8 * i + 7] = shape.top_radius;
            }
            indices_[i] = 2 * i;
        } else {
            put(vertices_ + 4 * i, shape.center);
            vertices_[4 * i + 3] = shape.radius;
            if constexpr (type == RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT)
                put(normals_ + 3 * i, shape.normal);
        }
    }

  private:
    static constexpr RTCGeometryType type = geometry_type<Shape>;

    float* vertices_ = nullptr;
    float* normals_ = nullptr;
    unsigned* indices_ = nullptr;
};

} // namespace

EmbreeDevice make_embree_device(simd::Isa isa) {
    const std::string name(isa == simd::Isa::portable ? "sse2" : simd::name_of(isa));
    const std::string config = "threads=1,isa=" + name;
    return EmbreeDevice(rtcNewDevice(config.c_str()));
}

bool EmbreeScene::can_hold(const core::Scene& scene) {
    bool has_all = std::all_of(
        scene.materials().begin(), scene.materials().end(),
        [](const core::Material& material) { return material.visible == core::Visible::both; });
    core::for_each_table(scene.shapes(), [&]<class Shape>(const core::Table<Shape>& table) {
        has_all = has_all && (embree_has<Shape> || table.size() == 0);
    });
    return has_all;
}

EmbreeScene::EmbreeScene(RTCDevice device, const core::Scene& scene, RTCSceneFlags flags,
                         RTCBuildQuality quality)
    : scene_(rtcNewScene(device)) {
    rtcSetSceneFlags(scene_.get(), flags);
    rtcSetSceneBuildQuality(scene_.get(), quality);
    core::for_each_table(scene.shapes(), [&]<class Shape>(const core::Table<Shape>& table) {
        if constexpr (embree_has<Shape>) {
            if (table.size() == 0) return;
            RTCGeometry geometry = rtcNewGeometry(device, geometry_type<Shape>);
            const auto places = places_by_id(table); // none of duplicates
            const Buffers<Shape> buffers(geometry, places.size(), buffers_);
            core::BigArray<core::ShapeId>& ids = ids_.emplace_back(places.size());
            unsigned primitive = 0;
            for (const auto& [id, place] : places) {
                ids[primitive] = id;
                buffers.set(primitive++, core::to_floats(table.get(place)));
            }
            rtcSetGeometryBuildQuality(geometry, quality);
            rtcCommitGeometry(geometry);
            rtcAttachGeometry(scene_.get(), geometry); // numbers geometries from 0 on
            rtcReleaseGeometry(geometry);
        }
    });
}

} // namespace raylane::bench
