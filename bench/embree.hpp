#pragma once

#if RAYLANE_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

/// Differences between Embree 3 and 4.
namespace raylane::bench {

/// Query for rays.
class EmbreeQuery {
  public:
    /// `coherent`: tells Embree that the rays are near each other.
    explicit EmbreeQuery(bool coherent);
    EmbreeQuery(const EmbreeQuery&) = delete; // parts refer to others
    EmbreeQuery& operator=(const EmbreeQuery&) = delete;

    /// Sets a filter for hits, in a scene with filter_flag. The filter gets `data` by data_for.
    void set_filter(RTCFilterFunctionN filter, const void* data);
    static const RTCSceneFlags filter_flag;
    static const void* data_for(const RTCFilterFunctionNArguments& hits) {
        return reinterpret_cast<const Context*>(hits.context)->data;
    }

    void nearest(RTCScene scene, RTCRayHit& ray);
    void nearest(RTCScene scene, const int* valid, RTCRayHit16& rays);
    void occluded(RTCScene scene, RTCRay& ray);
    void occluded(RTCScene scene, const int* valid, RTCRay16& rays);

  private:
#if RAYLANE_EMBREE >= 4
    struct Context {
        RTCRayQueryContext base;
        const void* data;
    };
    RTCIntersectArguments nearest_;
    RTCOccludedArguments occluded_;
#else
    struct Context {
        RTCIntersectContext base;
        const void* data;
    };
#endif
    Context context_{};
};

#if RAYLANE_EMBREE >= 4

inline constexpr RTCSceneFlags EmbreeQuery::filter_flag =
    RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

inline EmbreeQuery::EmbreeQuery(bool coherent) {
    rtcInitRayQueryContext(&context_.base);
    rtcInitIntersectArguments(&nearest_);
    rtcInitOccludedArguments(&occluded_);
    nearest_.context = occluded_.context = &context_.base;
    if (coherent) nearest_.flags = occluded_.flags = RTC_RAY_QUERY_FLAG_COHERENT;
}

inline void EmbreeQuery::set_filter(RTCFilterFunctionN filter, const void* data) {
    context_.data = data;
    nearest_.filter = occluded_.filter = filter;
    nearest_.flags = occluded_.flags =
        static_cast<RTCRayQueryFlags>(nearest_.flags | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
}

inline void EmbreeQuery::nearest(RTCScene scene, RTCRayHit& ray) {
    rtcIntersect1(scene, &ray, &nearest_);
}

inline void EmbreeQuery::nearest(RTCScene scene, const int* valid, RTCRayHit16& rays) {
    rtcIntersect16(valid, scene, &rays, &nearest_);
}

inline void EmbreeQuery::occluded(RTCScene scene, RTCRay& ray) {
    rtcOccluded1(scene, &ray, &occluded_);
}

inline void EmbreeQuery::occluded(RTCScene scene, const int* valid, RTCRay16& rays) {
    rtcOccluded16(valid, scene, &rays, &occluded_);
}

#else

inline constexpr RTCSceneFlags EmbreeQuery::filter_flag = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

inline EmbreeQuery::EmbreeQuery(bool coherent) {
    rtcInitIntersectContext(&context_.base);
    if (coherent) context_.base.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
}

inline void EmbreeQuery::set_filter(RTCFilterFunctionN filter, const void* data) {
    context_.data = data;
    context_.base.filter = filter;
}

inline void EmbreeQuery::nearest(RTCScene scene, RTCRayHit& ray) {
    rtcIntersect1(scene, &context_.base, &ray);
}

inline void EmbreeQuery::nearest(RTCScene scene, const int* valid, RTCRayHit16& rays) {
    rtcIntersect16(valid, scene, &context_.base, &rays);
}

inline void EmbreeQuery::occluded(RTCScene scene, RTCRay& ray) {
    rtcOccluded1(scene, &context_.base, &ray);
}

inline void EmbreeQuery::occluded(RTCScene scene, const int* valid, RTCRay16& rays) {
    rtcOccluded16(valid, scene, &context_.base, &rays);
}

#endif

} // namespace raylane::bench
