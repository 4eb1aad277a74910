#pragma once

#include "core/scene.hpp"
#include "simd/isa.hpp"

#include <embree3/rtcore.h>
#include <memory>
#include <vector>

namespace raylane::bench {

struct DeviceDeleter {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
using EmbreeDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceDeleter>;

/// For one thread, held to an instruction set.
EmbreeDevice make_embree_device(simd::Isa isa);

/// A scene as Embree has it: spheres, discs and triangles as they are, cylinders and cones, open
/// ones too, as linear cone curves, whose ends are closed. One geometry for each kind of shape.
class EmbreeScene {
  public:
    /// Whether it has all of the scene's shapes.
    static bool can_hold(const core::Scene& scene);

    EmbreeScene(RTCDevice device, const core::Scene& scene, RTCSceneFlags flags,
                RTCBuildQuality quality);

    RTCScene get() const { return scene_.get(); }

    /// Builds its hierarchy; what is above only hands over the shapes.
    void commit() { rtcCommitScene(scene_.get()); }

    /// What has been hit; no_shape: nothing.
    core::ShapeId shape(unsigned geometry, unsigned primitive) const {
        return geometry == RTC_INVALID_GEOMETRY_ID ? core::no_shape : ids_[geometry][primitive];
    }

  private:
    struct Deleter {
        void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    };
    std::unique_ptr<std::remove_pointer_t<RTCScene>, Deleter> scene_;
    std::vector<std::vector<core::ShapeId>> ids_; // by geometry and primitive
};

} // namespace raylane::bench
