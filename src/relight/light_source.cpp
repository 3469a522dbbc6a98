#include "relight/light_source.h"

#include "base/lanes.h"
#include "base/radiometry.shared.h"
#include "base/sampling.shared.h"
#include "shading/area_direct.shared.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kAllAround = -2.0f;     // below any cosine
constexpr float kLeastDistance = 1e-3f; // m; nearer to a point its light grows no more
constexpr float kOffPoint = 1e-3f;      // m, a ray's end from a light that is not in the scan
constexpr float kOffFixture = 0.015f;   // m; a lamp's surface is as uneven as any of a scan
constexpr int kPatchesAcross = 8;       // of a rectangle; a disc has as many in all

ClippedPatch patchAt(glm::vec3 position, glm::vec3 normal, float area)
{
    return {position, normal, area, Surfels::kNone};
}

AreaLight rectangleOf(const NewLight& light)
{
    const glm::mat3 frame = frameOf(light);
    std::vector<ClippedPatch> patches;
    const float area =
        light.size.x * light.size.y / (static_cast<size_t>(kPatchesAcross) * kPatchesAcross);
    for (int j = 0; j < kPatchesAcross; ++j)
        for (int i = 0; i < kPatchesAcross; ++i) {
            const float u = (static_cast<float>(i) + 0.5f) / kPatchesAcross - 0.5f;
            const float v = (static_cast<float>(j) + 0.5f) / kPatchesAcross - 0.5f;
            patches.push_back(
                patchAt(light.position + u * light.size.x * frame[0] + v * light.size.y * frame[1],
                        frame[2], area));
        }
    return AreaLight(std::move(patches));
}

ShiningRectangle outlineOf(const NewLight& light)
{
    const glm::mat3 frame = frameOf(light);
    const glm::vec3 u = 0.5f * light.size.x * frame[0];
    const glm::vec3 v = 0.5f * light.size.y * frame[1];
    const glm::vec3 at = light.position;
    return {{at - u - v, at + u - v, at + u + v, at - u + v}, frame[2]};
}

AreaLight discOf(const NewLight& light)
{
    constexpr int kBulbPatches = kPatchesAcross * kPatchesAcross;
    const glm::mat3 frame = frameOf(light);
    std::vector<ClippedPatch> patches;
    const float area = kPi * light.radius * light.radius / kBulbPatches;
    for (int i = 0; i < kBulbPatches; ++i) { // Vogel's spiral: every turn by the golden angle
        const float r = light.radius * std::sqrt((static_cast<float>(i) + 0.5f) / kBulbPatches);
        const float angle = 2.3999632f * static_cast<float>(i);
        patches.push_back(patchAt(light.position + r * std::cos(angle) * frame[0] +
                                      r * std::sin(angle) * frame[1],
                                  frame[2], area));
    }
    return AreaLight(std::move(patches));
}

/// A point of the disc of radius 1 around `axis`.
glm::vec3 onDisc(glm::vec3 axis, glm::vec2 u)
{
    const glm::vec3 over = cosineDirection(axis, u);
    return over - glm::dot(over, axis) * axis;
}

struct FacingArgs
{
    const TexelBlock* block;
    glm::vec3 towards;
    float* irradiance;
};

void facingKernel(const FacingArgs& args)
{
    const TexelBlock& block = *args.block;
    for (size_t first = 0; first < block.count; first += kLanes)
        for (size_t lane = 0; lane < kLanes; ++lane) {
            const size_t i = first + lane;
            const glm::vec3 normal(block.nx[i], block.ny[i], block.nz[i]);
            args.irradiance[i] = max(dot(normal, args.towards), 0.0f);
        }
}

} // namespace

glm::mat3 frameOf(const NewLight& light)
{
    const glm::vec3 axis = glm::normalize(light.direction);
    glm::vec3 along = light.along - glm::dot(light.along, axis) * axis;
    if (glm::length(along) < 1e-4f) { // level, if it can be
        const glm::vec3 up =
            std::abs(axis.y) < 0.999f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(0.0f, 0.0f, 1.0f);
        along = glm::cross(up, axis);
    }
    along = glm::normalize(along);
    return {along, glm::cross(axis, along), axis};
}

float LightProfile::at(float verticalAngle, float horizontalAngle) const
{
    if (vertical.empty() || verticalAngle > vertical.back()) return 0.0f;
    const auto after = [](std::span<const float> angles, float angle) {
        const auto found = std::upper_bound(angles.begin(), angles.end(), angle);
        return static_cast<size_t>(found - angles.begin());
    };
    const size_t rows = horizontal.size();
    const size_t columns = vertical.size();
    const size_t next = std::clamp<size_t>(after(vertical, verticalAngle), 1, columns) - 1;
    const size_t column[2] = {next, std::min(next + 1, columns - 1)};
    const float width = vertical[column[1]] - vertical[column[0]];
    const float x =
        width > 0.0f ? std::clamp((verticalAngle - vertical[column[0]]) / width, 0.0f, 1.0f) : 0.0f;
    const auto inRow = [&](size_t row) {
        const float* gains = &gain[row * columns];
        return gains[column[0]] + x * (gains[column[1]] - gains[column[0]]);
    };
    if (rows == 1) return inRow(0);
    float angle = std::fmod(horizontalAngle, 2.0f * kPi);
    if (angle < 0.0f) angle += 2.0f * kPi;
    const size_t above = after(horizontal, angle) % rows;
    const size_t below = (above + rows - 1) % rows;
    float gap = horizontal[above] - horizontal[below];
    float way = angle - horizontal[below];
    if (gap <= 0.0f) gap += 2.0f * kPi;
    if (way < 0.0f) way += 2.0f * kPi;
    const float y = std::clamp(way / gap, 0.0f, 1.0f);
    return inRow(below) + y * (inRow(above) - inRow(below));
}

LightSource::LightSource(const NewLight& light)
    : shape_(Sun{-glm::normalize(light.direction), 0.5f * light.angle})
{
    switch (light.type) {
    case LightType::rectangle:
        shape_ = Surface{rectangleOf(light), outlineOf(light), kOffPoint};
        break;
    case LightType::disc: {
        AreaLight area = discOf(light);
        LampPatches patches(area);
        shape_ = Surface{std::move(area), std::move(patches), kOffPoint};
        break;
    }
    case LightType::point:
    case LightType::spot:
    case LightType::sphere: {
        const bool isSpot = light.type == LightType::spot;
        const bool isSphere = light.type == LightType::sphere;
        const float inner = light.cone * (1.0f - light.blend);
        shape_ = Bulb{light.position,
                      frameOf(light),
                      light.radius,
                      isSphere ? kPi * light.radius * light.radius : 1.0f,
                      isSpot ? std::cos(light.cone) : kAllAround,
                      isSpot ? std::cos(inner) : kAllAround,
                      light.profile};
        break;
    }
    case LightType::sun:
        break;
    }
}

LightSource::LightSource(AreaLight surface) : shape_(Sun{{0.0f, 1.0f, 0.0f}, 0.0f})
{
    LampPatches patches(surface);
    shape_ = Surface{std::move(surface), std::move(patches), kOffFixture};
}

float LightSource::Bulb::intensity(glm::vec3 away) const
{
    float value = gain;
    const float cosine = glm::clamp(glm::dot(away, frame[2]), -1.0f, 1.0f);
    if (cosOuter > kAllAround) {
        const float t =
            glm::clamp((cosine - cosOuter) / std::max(cosInner - cosOuter, 1e-5f), 0.0f, 1.0f);
        value *= t * t * (3.0f - 2.0f * t);
    }
    if (profile)
        value *= profile->at(std::acos(cosine),
                             std::atan2(glm::dot(away, frame[1]), glm::dot(away, frame[0])));
    return value;
}

bool LightSource::isPoint() const
{
    const auto* bulb = std::get_if<Bulb>(&shape_);
    return bulb != nullptr && bulb->radius <= 0.0f;
}

glm::vec3 LightSource::centre() const
{
    if (const auto* bulb = std::get_if<Bulb>(&shape_)) return bulb->position;
    if (const auto* surface = std::get_if<Surface>(&shape_)) return surface->light.centre();
    return glm::vec3(0.0f);
}

float LightSource::intensityTowards(glm::vec3 direction) const
{
    if (const auto* bulb = std::get_if<Bulb>(&shape_)) return bulb->intensity(direction);
    if (const auto* surface = std::get_if<Surface>(&shape_)) return 0.25f * surface->light.area();
    return 0.0f;
}

void LightSource::open(const TexelBlock& block, float* irradiance, InstructionSet set) const
{
    if (const auto* surface = std::get_if<Surface>(&shape_)) {
        if (const auto* rectangle = std::get_if<ShiningRectangle>(&surface->extent))
            return irradianceOf(*rectangle, block, irradiance);
        return openIrradiance(block, std::get<LampPatches>(surface->extent), Geometry::exact,
                              irradiance, set);
    }
    if (const auto* sun = std::get_if<Sun>(&shape_)) {
        const FacingArgs args{&block, sun->towards, irradiance};
        return runKernel<facingKernel>(set, args);
    }
    const Bulb& bulb = std::get<Bulb>(shape_);
    for (size_t i = 0; i < block.count; ++i) {
        const Look straight = lookAt(bulb, {block.x[i], block.y[i], block.z[i]},
                                     {block.nx[i], block.ny[i], block.nz[i]}, {0.0f, 0.0f});
        irradiance[i] = straight.irradiance;
    }
}

Look LightSource::look(glm::vec3 place, glm::vec3 normal, float share, glm::vec2 u) const
{
    if (const auto* bulb = std::get_if<Bulb>(&shape_)) return lookAt(*bulb, place, normal, u);
    if (const auto* surface = std::get_if<Surface>(&shape_))
        return lookAt(*surface, place, normal, share);
    return lookAt(std::get<Sun>(shape_), normal, u);
}

/// What arrives is that of the centre; where the light is looked for, any point of its disc.
Look LightSource::lookAt(const Bulb& bulb, glm::vec3 place, glm::vec3 normal, glm::vec2 u) const
{
    const glm::vec3 way = bulb.position - place;
    const float least = std::max(bulb.radius, kLeastDistance);
    const float length = std::max(glm::length(way), 1e-6f);
    const float cosine = glm::dot(way, normal) / length;
    if (cosine <= 0.0f) return {};
    const float squared = std::max(length * length, least * least);
    const glm::vec3 to = bulb.radius > 0.0f ? way + bulb.radius * onDisc(-way / length, u) : way;
    const float distance = std::max(glm::length(to), 1e-6f);
    return {to / distance, std::max(distance - kOffPoint, 0.0f),
            bulb.intensity(-way / length) * cosine / squared};
}

Look LightSource::lookAt(const Surface& surface, glm::vec3 place, glm::vec3 normal,
                         float share) const
{
    const ClippedPatch& patch = surface.light.at(share);
    const glm::vec3 way = patch.position - place;
    const float distance = std::max(glm::length(way), 1e-6f);
    return {way / distance, std::max(distance - surface.off, 0.0f),
            surface.light.area() * patchFormFactor(way, normal, patch.normal, patch.area)};
}

Look LightSource::lookAt(const Sun& sun, glm::vec3 normal, glm::vec2 u) const
{
    const float cosine = glm::dot(sun.towards, normal);
    if (cosine <= 0.0f) return {};
    const glm::vec3 to =
        glm::normalize(sun.towards + std::tan(sun.radius) * onDisc(sun.towards, u));
    return {to, 1e30f, cosine};
}

bool sameShape(const NewLight& a, const NewLight& b)
{
    return a.type == b.type && a.position == b.position && a.direction == b.direction &&
           a.along == b.along && a.size == b.size && a.radius == b.radius && a.cone == b.cone &&
           a.blend == b.blend && a.angle == b.angle && a.profile == b.profile;
}

} // namespace relamp
