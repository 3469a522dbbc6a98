#include "scan/rays.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <embree3/rtcore.h>
#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

// Numerics.
constexpr size_t kPacket = 16;
// A fine tree takes 1 microsecond a triangle and saves a tenth of a room's 25 million rays: it pays
// up to here.
constexpr size_t kTrianglesOfFineTree = 200'000;

// Rays that graze an edge hit by the order of operations: with AVX-512 another one than with AVX2,
// and no faster.
constexpr const char* kDevice = "max_isa=avx2,max_spatial_split_replications=2";

/// Embree ends the process on a ray that is not a number, so none is let through.
[[maybe_unused]] bool isFinite(const Ray& ray)
{
    const float sum = ray.origin.x + ray.origin.y + ray.origin.z + ray.direction.x +
                      ray.direction.y + ray.direction.z + ray.nearest;
    return std::isfinite(sum);
}

void fillBuffers(RTCGeometry geometry, const Scan& scan)
{
    size_t vertices = 0;
    for (const Mesh& mesh : scan.meshes) vertices += mesh.positions.size();
    auto* position = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices));
    auto* index = static_cast<uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(uint32_t), scan.triangleCount()));
    uint32_t firstVertex = 0;
    for (const Mesh& mesh : scan.meshes) {
        for (const glm::vec3& p : mesh.positions)
            for (int c = 0; c < 3; ++c) *position++ = p[c];
        for (const glm::uvec3& t : mesh.triangles)
            for (int c = 0; c < 3; ++c) *index++ = firstVertex + t[c];
        firstVertex += static_cast<uint32_t>(mesh.positions.size());
    }
}

Hit hitFrom(uint32_t triangle, float distance, glm::vec2 weights, glm::vec3 towardsFace,
            glm::vec3 direction)
{
    return {triangle, distance, weights, glm::dot(towardsFace, direction) < 0.0f};
}

RTCRay embreeRay(const Ray& ray)
{
    assert(isFinite(ray));
    RTCRay query{};
    query.org_x = ray.origin.x;
    query.org_y = ray.origin.y;
    query.org_z = ray.origin.z;
    query.dir_x = ray.direction.x;
    query.dir_y = ray.direction.y;
    query.dir_z = ray.direction.z;
    query.tnear = ray.nearest;
    query.tfar = std::max(ray.farthest, ray.nearest); // Embree ends the process on less
    query.mask = ~0u;
    return query;
}

/// Up to kPacket rays as Embree takes them together; lanes behind the last are switched off.
void fillPacket(std::span<const Ray> rays, int* valid, RTCRay16& packet)
{
    for (size_t i = 0; i < kPacket; ++i) {
        const Ray& ray = rays[std::min(i, rays.size() - 1)];
        assert(isFinite(ray));
        valid[i] = i < rays.size() ? -1 : 0;
        packet.org_x[i] = ray.origin.x;
        packet.org_y[i] = ray.origin.y;
        packet.org_z[i] = ray.origin.z;
        packet.dir_x[i] = ray.direction.x;
        packet.dir_y[i] = ray.direction.y;
        packet.dir_z[i] = ray.direction.z;
        packet.tnear[i] = ray.nearest;
        packet.tfar[i] = std::max(ray.farthest, ray.nearest); // Embree ends the process on less
        packet.time[i] = 0.0f;
        packet.mask[i] = ~0u;
        packet.flags[i] = 0;
    }
}

} // namespace

struct RayScene::Embree
{
    Embree() : device(rtcNewDevice(kDevice)), scene(rtcNewScene(device)) {}
    ~Embree()
    {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;

    RTCDevice device;
    RTCScene scene;
};

/// How Embree is asked, which gives it on to the filter.
struct RayScene::Query : RTCIntersectContext
{
    explicit Query(const RayScene& scene, RayOrder order = RayOrder::scattered)
        : isOpen(scene.isOpen_.get())
    {
        rtcInitIntersectContext(this);
        flags = order == RayOrder::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                            : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        if (isOpen != nullptr) filter = passOpen;
    }

    static void passOpen(const RTCFilterFunctionNArguments* hits)
    {
        const std::vector<uint8_t>& isOpen = *static_cast<const Query*>(hits->context)->isOpen;
        for (unsigned int i = 0; i < hits->N; ++i)
            if (hits->valid[i] != 0 && isOpen[RTCHitN_primID(hits->hit, hits->N, i)] != 0)
                hits->valid[i] = 0;
    }

    const std::vector<uint8_t>* isOpen;
};

RayScene::RayScene(const Scan& scan) : bounds_(boundsOf(scan))
{
    auto embree = std::make_shared<Embree>();
    const RTCGeometry geometry = rtcNewGeometry(embree->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    fillBuffers(geometry, scan);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree->scene, geometry);
    rtcReleaseGeometry(geometry);
    // RTC_SCENE_FLAG_ROBUST costs a quarter of the rate, and of two million rays through scanned
    // rooms it held back none that slipped through an edge without it.
    if (scan.triangleCount() <= kTrianglesOfFineTree)
        rtcSetSceneBuildQuality(embree->scene, RTC_BUILD_QUALITY_HIGH);
    rtcSetSceneFlags(embree->scene, RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION); // for without()
    rtcCommitScene(embree->scene);
    embree_ = std::move(embree);
}

RayScene RayScene::without(std::vector<uint8_t> isOpen) const
{
    RayScene rest = *this;
    if (std::ranges::any_of(isOpen, [](uint8_t open) { return open != 0; }))
        rest.isOpen_ = std::make_shared<const std::vector<uint8_t>>(std::move(isOpen));
    return rest;
}

void RayScene::intersect(std::span<const Ray> rays, std::span<Hit> hits, RayOrder order) const
{
    assert(rays.size() == hits.size());
    Query context(*this, order);
    for (size_t begin = 0; begin < rays.size(); begin += kPacket) {
        const size_t count = std::min(kPacket, rays.size() - begin);
        alignas(64) int valid[kPacket];
        RTCRayHit16 packet;
        fillPacket(rays.subspan(begin, count), valid, packet.ray);
        std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
        rtcIntersect16(valid, embree_->scene, &context, &packet);
        for (size_t i = 0; i < count; ++i) {
            const bool missed = packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID;
            hits[begin + i] =
                missed ? Hit{}
                       : hitFrom(packet.hit.primID[i], packet.ray.tfar[i],
                                 {packet.hit.u[i], packet.hit.v[i]},
                                 {packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]},
                                 rays[begin + i].direction);
        }
    }
}

void RayScene::occluded(std::span<const Ray> rays, std::span<uint8_t> blocked) const
{
    assert(rays.size() == blocked.size());
    Query context(*this);
    for (size_t begin = 0; begin < rays.size(); begin += kPacket) {
        const size_t count = std::min(kPacket, rays.size() - begin);
        alignas(64) int valid[kPacket];
        RTCRay16 packet;
        fillPacket(rays.subspan(begin, count), valid, packet);
        rtcOccluded16(valid, embree_->scene, &context, &packet);
        for (size_t i = 0; i < count; ++i) blocked[begin + i] = packet.tfar[i] < 0.0f ? 1 : 0;
    }
}

bool RayScene::occluded(const Ray& ray) const
{
    Query context(*this);
    RTCRay query = embreeRay(ray);
    rtcOccluded1(embree_->scene, &context, &query);
    return query.tfar < 0.0f;
}

Hit RayScene::intersect(const Ray& ray) const
{
    Query context(*this);
    RTCRayHit query{};
    query.ray = embreeRay(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return hitFrom(query.hit.primID, query.ray.tfar, {query.hit.u, query.hit.v},
                   {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z}, ray.direction);
}

} // namespace relamp
