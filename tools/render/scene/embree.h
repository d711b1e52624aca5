// SPDX-License-Identifier: Apache-2.0
// The one place that knows which Embree it is. Version 3.13 is what is tested; 4 differs in these calls and is untested.
#pragma once

#if __has_include(<embree3/rtcore.h>)
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

namespace brdf::render {

#if RTC_VERSION_MAJOR < 4

inline void embree_intersect(RTCScene scene, RTCRayHit& ray) noexcept {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &ray);
}

inline void embree_intersect_packet(const int* valid, RTCScene scene, RTCRayHit8& rays) noexcept {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &context, &rays);
}

inline void embree_occluded(RTCScene scene, RTCRay& ray) noexcept {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
}

#else

inline void embree_intersect(RTCScene scene, RTCRayHit& ray) noexcept { rtcIntersect1(scene, &ray, nullptr); }
inline void embree_intersect_packet(const int* valid, RTCScene scene, RTCRayHit8& rays) noexcept { rtcIntersect8(valid, scene, &rays, nullptr); }
inline void embree_occluded(RTCScene scene, RTCRay& ray) noexcept { rtcOccluded1(scene, &ray, nullptr); }

#endif

}  // namespace brdf::render
