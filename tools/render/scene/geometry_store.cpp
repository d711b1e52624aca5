// SPDX-License-Identifier: Apache-2.0
#include "scene/geometry_store.h"

#include "scene/embree.h"

#include <brdf/error.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>

namespace brdf::render {

namespace {

constexpr float largest_part = (1 << 20) - 1;

}  // namespace

struct GeometryStore::Handles {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Handles() {
    device = rtcNewDevice(nullptr);
    if (!device) throw Error(ErrorCode::unsupported, "Embree does not run on this machine (error " + std::to_string(static_cast<int>(rtcGetDeviceError(nullptr))) + ")");
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  }
  ~Handles() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;

  void* buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t bytes, std::size_t count) const {
    void* memory = rtcSetNewGeometryBuffer(geometry, type, 0, format, bytes, count);
    if (!memory) throw Error(ErrorCode::limit_exceeded, "out of memory for the geometry of the scene");
    return memory;
  }
  void attach(RTCGeometry geometry, std::uint32_t id) const {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
  }
};

GeometryStore::GeometryStore()
    : handles_(std::make_unique<Handles>()), has_packets_(rtcGetDeviceProperty(handles_->device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0) {}
GeometryStore::~GeometryStore() = default;
GeometryStore::GeometryStore(GeometryStore&&) noexcept = default;
GeometryStore& GeometryStore::operator=(GeometryStore&&) noexcept = default;

RTCSceneTy* GeometryStore::embree_scene() const noexcept { return handles_->scene; }

void GeometryStore::grow(const Vec3f& p) {
  low_ = is_empty_ ? p : glm::min(low_, p);
  high_ = is_empty_ ? p : glm::max(high_, p);
  is_empty_ = false;
}

float GeometryStore::radius() const noexcept { return std::max(0.5f * glm::length(high_ - low_), 1e-6f); }

std::uint32_t GeometryStore::add(const Mesh& mesh, bool flat) {
  const auto id = static_cast<std::uint32_t>(shapes_.size());
  RTCGeometry geometry = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<Vec3f*>(handles_->buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, sizeof(Vec3f), mesh.positions.size()));
  std::copy(mesh.positions.begin(), mesh.positions.end(), vertices);
  auto* indices = static_cast<glm::uvec3*>(handles_->buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, sizeof(glm::uvec3), mesh.triangles.size()));
  std::copy(mesh.triangles.begin(), mesh.triangles.end(), indices);
  handles_->attach(geometry, id);

  const std::vector<Vec3f> normals = !mesh.normals.empty() ? mesh.normals : smooth_normals(mesh);
  Shape shape;
  shape.first = static_cast<std::uint32_t>(triangles_.size());
  triangles_.reserve(triangles_.size() + mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles) {
    const Vec3f a = mesh.positions[t.x], e1 = mesh.positions[t.y] - a, e2 = mesh.positions[t.z] - a;
    Vec3f n0 = normals[t.x], n1 = normals[t.y], n2 = normals[t.z];
    if (flat) {
      const Vec3f n = glm::cross(e1, e2);
      const float length = glm::length(n);
      n0 = n1 = n2 = length > 0 ? n / length : Vec3f(0, 0, 1);
    }
    triangles_.push_back({a, e1, e2, PackedNormal(n0), PackedNormal(n1), PackedNormal(n2)});
    grow(a);
    grow(mesh.positions[t.y]);
    grow(mesh.positions[t.z]);
  }
  if (!mesh.uvs.empty()) {
    const std::vector<Vec3f> tangents = vertex_tangents(mesh, normals);
    shape.first_tangent = static_cast<std::uint32_t>(tangents_.size());
    for (const glm::uvec3& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) tangents_.push_back(tangents[t[k]]);
  }
  shapes_.push_back(shape);
  return id;
}

std::uint32_t GeometryStore::add_sphere(const Vec3f& centre, float radius) {
  const auto id = static_cast<std::uint32_t>(shapes_.size());
  RTCGeometry geometry = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  auto* sphere = static_cast<float*>(handles_->buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 1));
  std::memcpy(sphere, &centre, sizeof centre);
  sphere[3] = radius;
  handles_->attach(geometry, id);
  Shape shape;
  shape.centre = centre;
  shape.radius = radius;
  shapes_.push_back(shape);
  grow(centre - radius);
  grow(centre + radius);
  return id;
}

void GeometryStore::commit() {
  rtcCommitScene(handles_->scene);
  if (rtcGetDeviceError(handles_->device) != RTC_ERROR_NONE) {
    throw Error(ErrorCode::limit_exceeded, "out of memory for the geometry of the scene");
  }
}

GeometryStore::PackedNormal::PackedNormal(const Vec3f& n) noexcept : bits_(0) {
  for (int k = 0; k < 3; ++k) {
    const auto part = static_cast<std::int64_t>(std::lround(std::clamp(n[k], -1.0f, 1.0f) * largest_part)) + (1 << 20);
    bits_ |= static_cast<std::uint64_t>(part) << (21 * k);
  }
}

Vec3f GeometryStore::PackedNormal::unpack() const noexcept {
  constexpr std::uint64_t mask = (1U << 21) - 1;
  const auto part = [this](int k) { return static_cast<float>(static_cast<int>((bits_ >> (21 * k)) & mask) - (1 << 20)); };
  return Vec3f(part(0), part(1), part(2)) * (1 / largest_part);
}

Intersection GeometryStore::intersect(const Ray& ray) const noexcept {
  RTCRayHit query;
  query.ray.org_x = ray.origin.x;
  query.ray.org_y = ray.origin.y;
  query.ray.org_z = ray.origin.z;
  query.ray.dir_x = ray.direction.x;
  query.ray.dir_y = ray.direction.y;
  query.ray.dir_z = ray.direction.z;
  query.ray.tnear = 0;
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.time = 0;
  query.ray.mask = ~0U;
  query.ray.id = 0;
  query.ray.flags = 0;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  embree_intersect(handles_->scene, query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {query.ray.tfar, query.hit.u, query.hit.v, query.hit.geomID, query.hit.primID};
}

void GeometryStore::intersect(std::span<const Ray> rays, std::span<Intersection> met) const noexcept {
  if (!has_packets_) {
    std::transform(rays.begin(), rays.end(), met.begin(), [this](const Ray& r) { return intersect(r); });
    return;
  }
  alignas(32) std::array<int, packet> valid{};
  RTCRayHit8 query;
  for (std::size_t i = 0; i < packet; ++i) {
    const Ray& ray = rays[std::min(i, rays.size() - 1)];
    valid[i] = i < rays.size() ? -1 : 0;
    query.ray.org_x[i] = ray.origin.x;
    query.ray.org_y[i] = ray.origin.y;
    query.ray.org_z[i] = ray.origin.z;
    query.ray.dir_x[i] = ray.direction.x;
    query.ray.dir_y[i] = ray.direction.y;
    query.ray.dir_z[i] = ray.direction.z;
    query.ray.tnear[i] = 0;
    query.ray.tfar[i] = std::numeric_limits<float>::infinity();
    query.ray.time[i] = 0;
    query.ray.mask[i] = ~0U;
    query.ray.id[i] = 0;
    query.ray.flags[i] = 0;
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  embree_intersect_packet(valid.data(), handles_->scene, query);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    met[i] = {};
    if (query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    met[i] = {query.ray.tfar[i], query.hit.u[i], query.hit.v[i], query.hit.geomID[i], query.hit.primID[i]};
  }
}

void GeometryStore::prefetch(const Intersection& met) const noexcept {
  if (!met.is_hit()) return;
  const Shape& shape = shapes_[met.shape];
  if (!(shape.radius > 0)) __builtin_prefetch(&triangles_[shape.first + met.primitive]);
}

Hit GeometryStore::hit(const Ray& ray, const Intersection& met, bool tangents) const noexcept {
  Hit hit;
  hit.shape = met.shape;
  hit.distance = met.distance;
  const Shape& shape = shapes_[met.shape];
  Vec3f tangent(0);
  if (shape.radius > 0) {
    const Vec3f from_centre = ray.origin + ray.direction * hit.distance - shape.centre;
    hit.facet = hit.normal = from_centre / glm::length(from_centre);
    hit.point = shape.centre + hit.normal * shape.radius;
    tangent = Vec3f(hit.normal.z, 0, -hit.normal.x);  // round the axis y
  } else {
    const Triangle& t = triangles_[shape.first + met.primitive];
    const float u = met.u, v = met.v, w = 1 - u - v;
    hit.point = t.p0 + t.e1 * u + t.e2 * v;  // closer to the triangle than the ray's own end
    hit.facet = glm::normalize(glm::cross(t.e1, t.e2));
    const Vec3f n = t.n0.unpack() * w + t.n1.unpack() * u + t.n2.unpack() * v;
    const float length2 = glm::dot(n, n);
    hit.normal = length2 > 0 ? n / std::sqrt(length2) : hit.facet;
    if (tangents && shape.first_tangent != no_index) {
      const Vec3f* corner = &tangents_[shape.first_tangent + 3 * static_cast<std::size_t>(met.primitive)];
      tangent = corner[0] * w + corner[1] * u + corner[2] * v;
    }
  }
  tangent -= hit.normal * glm::dot(hit.normal, tangent);
  const float length2 = glm::dot(tangent, tangent);
  if (length2 > 1e-12f) {
    hit.tangent = tangent / std::sqrt(length2);
    hit.bitangent = glm::cross(hit.normal, hit.tangent);
  } else {
    make_frame(hit.normal, hit.tangent, hit.bitangent);
  }
  return hit;
}

bool GeometryStore::occluded(const Ray& ray, float distance) const noexcept {
  RTCRay query;
  query.org_x = ray.origin.x;
  query.org_y = ray.origin.y;
  query.org_z = ray.origin.z;
  query.dir_x = ray.direction.x;
  query.dir_y = ray.direction.y;
  query.dir_z = ray.direction.z;
  query.tnear = 0;
  query.tfar = distance;
  query.time = 0;
  query.mask = ~0U;
  query.id = 0;
  query.flags = 0;
  embree_occluded(handles_->scene, query);
  return query.tfar < 0;
}

Vec3f offset_point(const Vec3f& point, const Vec3f& facet, const Vec3f& direction) noexcept {
  constexpr float near_origin = 1.0f / 32, small_step = 1.0f / 65536, units_in_last_place = 256;
  const Vec3f n = glm::dot(facet, direction) < 0 ? -facet : facet;
  Vec3f moved;
  for (int k = 0; k < 3; ++k) {
    const auto step = static_cast<std::int32_t>(units_in_last_place * n[k]);
    const auto bits = std::bit_cast<std::int32_t>(point[k]), sign = bits >> 31;  // -1 below 0
    const auto near = std::bit_cast<std::int32_t>(point[k] + small_step * n[k]), far = bits + ((step ^ sign) - sign);
    moved[k] = std::bit_cast<float>(std::abs(point[k]) < near_origin ? near : far);  // of integers: a move, no branch
  }
  return moved;
}

void make_frame(const Vec3f& n, Vec3f& tangent, Vec3f& bitangent) noexcept {
  const float sign = std::copysign(1.0f, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  tangent = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  bitangent = {b, sign + n.y * n.y * a, -n.y};
}

}  // namespace brdf::render
