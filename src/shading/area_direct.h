#pragma once

#include "lights/area_light.h"
#include "scan/rays.h"
#include "scan/texels.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

constexpr float kOffLamp =
    0.015f; // m, at which shadow rays end: its surface is as uneven as any of a scan

/// How positions and normals are taken where light is computed. `exact`: as they are; for whatever
/// is to be true of the room that they make up. `scanned`: as a scan has them, with errors; for
/// estimating what its own lamps brought as it was captured, without what errors of the mesh alone
/// would bring (mesh_noise.shared.h).
enum class Geometry : uint8_t { exact, scanned };

/// Irradiance of a lamp of radiance 1 at one place, by samples on its surface.
struct AreaSample
{
    float open = 0.0f;    // without anything in the way
    float visible = 0.0f; // with shadows

    bool operator==(const AreaSample&) const = default;
    AreaSample& operator+=(AreaSample other)
    {
        open += other.open;
        visible += other.visible;
        return *this;
    }
};

/// Looks for one lamp from many places. Several places look, and their shadow rays are traced,
/// together.
class AreaSampler
{
public:
    AreaSampler(const RayScene& scene, const AreaLight& light, Geometry geometry)
        : scene_(scene), light_(light), geometry_(geometry)
    {}

    /// The mean of several sites on surfaces: `samples` points from each, evenly over the lamp's
    /// area and all sites together, shifted by `shift` (0..1), each with a shadow ray where it
    /// could be seen. Adds it to `sum`, which must stay where it is until finish().
    void add(std::span<const TexelSite> sites, size_t samples, float shift, AreaSample& sum);
    /// Completes all sums.
    void finish();

private:
    static constexpr size_t kBatch = 64;

    /// From places to points on the lamp. Structure of arrays.
    struct Looks
    {
        float fromX[kBatch], fromY[kBatch], fromZ[kBatch]; // m
        float nx[kBatch], ny[kBatch], nz[kBatch];          // unit, of the place
        float toX[kBatch], toY[kBatch], toZ[kBatch];       // m
        float fx[kBatch], fy[kBatch], fz[kBatch];          // unit, where the point faces
        float patch[kBatch];                               // m^2 of the patch it lies on
        float area[kBatch];                                // m^2 of the lamp that it stands for
        AreaSample* sum[kBatch];
    };

    void look();
    void trace();

    const RayScene& scene_;
    const AreaLight& light_;
    Geometry geometry_;
    Looks looks_;
    size_t looking_ = 0;
    Ray rays_[kBatch];
    float gain_[kBatch]; // of a ray that nothing is in the way of
    AreaSample* sum_[kBatch];
    size_t count_ = 0;
};

/// At one site, exact: `position` is on the surface, `normal` its unit normal.
AreaSample sampleAreaLight(const RayScene& scene, const AreaLight& light, glm::vec3 position,
                           glm::vec3 normal, size_t samples, float shift);

} // namespace relamp
