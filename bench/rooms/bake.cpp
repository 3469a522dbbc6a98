#include "rooms/bake.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "base/random.h"
#include "base/sampling.shared.h"
#include "scan/rays.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace relamp::rooms
{
namespace
{

constexpr int kAlbedoSamples = 4;     // across a texel
constexpr float kSettled = 2e-4f;     // share of the mean that the last bounce adds
constexpr float kTouching = 0.05f;    // m; what lies closer hides a place from every camera
constexpr float kMostlyHidden = 0.8f; // of a texel's rays meet that, or backs of surfaces
constexpr float kFar = 1e4f;          // m
constexpr uint32_t kNoPixel = ~0u;
constexpr size_t kTexelsAtOnce = 64;

/// A triangle that sends light, or half of an opening.
struct Sender
{
    glm::vec3 corner, alongU, alongV;
    glm::vec3 normal;
    float until = 0.0f; // area of its lamp's triangles up to this one, m^2
};

/// A lamp or an opening.
struct Source
{
    std::vector<Sender> senders;
    float area = 0.0f;
    glm::vec3 radiance{0.0f}; // of a lamp
    bool isOutside = false;

    void add(glm::vec3 corner, glm::vec3 alongU, glm::vec3 alongV)
    {
        const glm::vec3 cross = glm::cross(alongU, alongV);
        area += 0.5f * glm::length(cross);
        senders.push_back({corner, alongU, alongV, glm::normalize(cross), area});
    }
};

struct PointOnSource
{
    glm::vec3 position;
    glm::vec3 normal;
};

/// The point that a share of a source's area and a place across its triangle stand for.
PointOnSource pointOn(const Source& source, float share, glm::vec2 across)
{
    const float until = share * source.area;
    auto sender = source.senders.begin();
    while (sender + 1 != source.senders.end() && sender->until < until) ++sender;
    if (across.x + across.y > 1.0f) across = 1.0f - across;
    return {sender->corner + across.x * sender->alongU + across.y * sender->alongV, sender->normal};
}

struct Site
{
    glm::vec3 position;
    glm::vec3 normal;
};

class Baker
{
public:
    Baker(const Room& room, const Atlas& atlas, const BakeOptions& options);

    Baked bake();

private:
    struct TexelPlace
    {
        uint32_t chart;
        glm::ivec2 at; // in the chart
    };
    struct Met
    {
        uint32_t pixel = kNoPixel;
        bool isBack = false;
    };

    [[nodiscard]] size_t pixelOf(const TexelPlace& texel) const;
    [[nodiscard]] Site siteIn(const TexelPlace& texel, float u, float v) const;
    [[nodiscard]] float share(float pointDensity, float chance) const;
    [[nodiscard]] glm::vec3 colourOf(const Source& source, glm::vec3 direction) const;
    [[nodiscard]] const Source* openingOn(const Ray& ray, float& distance) const;
    [[nodiscard]] Met met(const Hit& hit) const;

    void addMaterial();
    void addSent(size_t texel, Random& random);
    void addMet(size_t texel, Random& random);
    void bounce();
    void smoothIndirect();

    const Room& room_;
    const Atlas& atlas_;
    BakeOptions options_;
    ChartMesh mesh_;
    RayScene rays_;
    std::vector<Source> sources_; // lamps, then openings
    std::vector<TexelPlace> texels_;
    std::vector<uint32_t> metPixel_; // [texel][ray]
    std::vector<glm::vec3> outside_; // of pixels: irradiance / pi from there
    Baked baked_;
};

Baker::Baker(const Room& room, const Atlas& atlas, const BakeOptions& options)
    : room_(room), atlas_(atlas), options_(options), mesh_(meshOf(atlas, kWhole)),
      rays_(mesh_.scan), sources_(room.lamps.size())
{
    const Mesh& mesh = mesh_.scan.meshes[0];
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        const int lamp = atlas.charts[mesh_.chartOf[t]].patch.lamp;
        if (lamp < 0) continue;
        const glm::uvec3 corners = mesh.triangles[t];
        const glm::vec3 first = mesh.positions[corners.x];
        sources_[static_cast<size_t>(lamp)].add(first, mesh.positions[corners.y] - first,
                                                mesh.positions[corners.z] - first);
    }
    for (size_t i = 0; i < room.lamps.size(); ++i) sources_[i].radiance = room.lamps[i].radiance;
    for (const Opening& opening : room.openings) {
        Source source{.isOutside = true};
        source.add(opening.corner, opening.alongU, opening.alongV);
        source.add(opening.corner + opening.alongU + opening.alongV, -opening.alongU,
                   -opening.alongV);
        sources_.push_back(std::move(source));
    }
    for (size_t i = 0; i < atlas.charts.size(); ++i)
        for (int y = 0; y < atlas.charts[i].pixels.y; ++y)
            for (int x = 0; x < atlas.charts[i].pixels.x; ++x)
                texels_.push_back({static_cast<uint32_t>(i), {x, y}});
}

size_t Baker::pixelOf(const TexelPlace& texel) const
{
    const glm::ivec2 at = atlas_.charts[texel.chart].corner + texel.at;
    return static_cast<size_t>(at.y * atlas_.side + at.x);
}

Site Baker::siteIn(const TexelPlace& texel, float u, float v) const
{
    const Chart& chart = atlas_.charts[texel.chart];
    const glm::vec2 at = (glm::vec2(texel.at) + glm::vec2(u, v)) / glm::vec2(chart.pixels);
    return {chart.patch.at(at.x, at.y), chart.patch.normalAt(at.x, at.y)};
}

/// What one find of light adds to irradiance / pi a unit of radiance: `chance` is the density of
/// directions of chance, cos / pi, `pointDensity` that of directions to points on the source. Both
/// ways of finding it add this much, so that together they count once.
float Baker::share(float pointDensity, float chance) const
{
    return chance / (static_cast<float>(options_.lampRays) * pointDensity +
                     static_cast<float>(options_.bounceRays) * chance);
}

glm::vec3 Baker::colourOf(const Source& source, glm::vec3 direction) const
{
    return source.isOutside ? room_.outside.radiance(direction) : source.radiance;
}

/// Light by points on every lamp and opening.
void Baker::addSent(size_t texel, Random& random)
{
    const size_t pixel = pixelOf(texels_[texel]);
    const auto count = static_cast<float>(options_.lampRays);
    for (const Source& source : sources_) {
        const float shift = random.next();
        const glm::vec2 across{random.next(), random.next()};
        for (int i = 0; i < options_.lampRays; ++i) {
            const Site site = siteIn(texels_[texel], random.next(), random.next());
            const float along = (static_cast<float>(i) + shift) / count;
            const PointOnSource point =
                pointOn(source, along, evenPoint(static_cast<float>(i), across));
            const glm::vec3 origin = site.position + kOffSurface * site.normal;
            const glm::vec3 way = point.position - origin;
            const float distance = glm::length(way);
            const glm::vec3 direction = way / std::max(distance, 1e-6f);
            const float chance = glm::dot(direction, site.normal) / kPi;
            const float facing = -glm::dot(direction, point.normal);
            if (chance <= 0.0f || facing <= 0.0f || distance < kOffSurface) continue;
            const float farthest = source.isOutside ? kFar : distance - kOffSurface;
            if (rays_.occluded({.origin = origin, .direction = direction, .farthest = farthest}))
                continue;
            const float density = distance * distance / (facing * source.area);
            const glm::vec3 light = share(density, chance) * colourOf(source, direction);
            (source.isOutside ? outside_ : baked_.direct)[pixel] += light;
        }
    }
}

/// The opening that a ray leaves the room by.
const Source* Baker::openingOn(const Ray& ray, float& distance) const
{
    for (size_t i = 0; i < room_.openings.size(); ++i) {
        const Opening& o = room_.openings[i];
        const glm::vec3 normal = glm::cross(o.alongU, o.alongV);
        const float facing = glm::dot(ray.direction, normal);
        if (facing >= 0.0f) continue;
        distance = glm::dot(o.corner - ray.origin, normal) / facing;
        const glm::vec3 at = ray.origin + distance * ray.direction - o.corner;
        const float u = glm::dot(at, o.alongU) / glm::dot(o.alongU, o.alongU);
        const float v = glm::dot(at, o.alongV) / glm::dot(o.alongV, o.alongV);
        if (u >= 0.0f && u <= 1.0f && v >= 0.0f && v <= 1.0f)
            return &sources_[room_.lamps.size() + i];
    }
    return nullptr;
}

Baker::Met Baker::met(const Hit& hit) const
{
    const Mesh& mesh = mesh_.scan.meshes[0];
    const glm::uvec3 corners = mesh.triangles[hit.triangle];
    const glm::vec2 first = mesh.uvs[corners.x];
    const glm::vec2 uv = first + hit.weights.x * (mesh.uvs[corners.y] - first) +
                         hit.weights.y * (mesh.uvs[corners.z] - first);
    const Chart& chart = atlas_.charts[mesh_.chartOf[hit.triangle]];
    const glm::ivec2 at = glm::clamp(glm::ivec2(uv * static_cast<float>(atlas_.side)), chart.corner,
                                     chart.corner + chart.pixels - 1);
    return {static_cast<uint32_t>(at.y * atlas_.side + at.x), !hit.front};
}

/// Light that rays of chance meet, and what they meet for the bounces.
void Baker::addMet(size_t texel, Random& random)
{
    const size_t pixel = pixelOf(texels_[texel]);
    const glm::vec2 shift{random.next(), random.next()};
    int hiding = 0;
    for (int i = 0; i < options_.bounceRays; ++i) {
        const Site site = siteIn(texels_[texel], random.next(), random.next());
        const glm::vec3 direction =
            cosineDirection(site.normal, evenPoint(static_cast<float>(i), shift));
        const Ray ray{.origin = site.position + kOffSurface * site.normal, .direction = direction};
        const float chance = std::max(glm::dot(direction, site.normal), 0.0f) / kPi;
        const Hit hit = rays_.intersect(ray);
        if (hit.missed()) {
            float distance = 0.0f;
            const Source* opening = openingOn(ray, distance);
            if (opening == nullptr) continue;
            const float facing = -glm::dot(direction, opening->senders[0].normal);
            const float density = distance * distance / (facing * opening->area);
            outside_[pixel] += share(density, chance) * colourOf(*opening, direction);
            continue;
        }
        const Met found = met(hit);
        if (found.isBack || hit.distance < kTouching) ++hiding;
        if (found.isBack) continue;
        metPixel_[texel * static_cast<size_t>(options_.bounceRays) + static_cast<size_t>(i)] =
            found.pixel;
        const int lamp = atlas_.charts[mesh_.chartOf[hit.triangle]].patch.lamp;
        if (lamp < 0) continue;
        const Source& source = sources_[static_cast<size_t>(lamp)];
        const glm::uvec3 corners = mesh_.scan.meshes[0].triangles[hit.triangle];
        const auto& positions = mesh_.scan.meshes[0].positions;
        const glm::vec3 normal =
            glm::normalize(glm::cross(positions[corners.y] - positions[corners.x],
                                      positions[corners.z] - positions[corners.x]));
        const float facing = std::max(-glm::dot(direction, normal), 1e-6f);
        const float density = hit.distance * hit.distance / (facing * source.area);
        baked_.direct[pixel] += share(density, chance) * source.radiance;
    }
    baked_.isHidden[pixel] =
        static_cast<float>(hiding) > kMostlyHidden * static_cast<float>(options_.bounceRays);
}

/// Albedo, mean over a texel, and emission.
void Baker::addMaterial()
{
    forEach(texels_.size(), [&](size_t t) {
        const size_t pixel = pixelOf(texels_[t]);
        const Patch& patch = atlas_.charts[texels_[t].chart].patch;
        glm::vec3 sum(0.0f);
        for (int i = 0; i < kAlbedoSamples * kAlbedoSamples; ++i) {
            const glm::vec2 at = (glm::vec2(i % kAlbedoSamples, i / kAlbedoSamples) + 0.5f) /
                                 static_cast<float>(kAlbedoSamples);
            const Site site = siteIn(texels_[t], at.x, at.y);
            sum += albedoOf(room_.paints[static_cast<size_t>(patch.paint)], site.position,
                            site.normal);
        }
        baked_.albedo[pixel] = sum / static_cast<float>(kAlbedoSamples * kAlbedoSamples);
        baked_.isCovered[pixel] = 1;
        if (patch.lamp >= 0)
            baked_.emission[pixel] = room_.lamps[static_cast<size_t>(patch.lamp)].radiance;
    });
}

/// Bounces light between texels along the rays of chance until it has settled.
void Baker::bounce()
{
    baked_.indirect = outside_;
    const auto rays = static_cast<size_t>(options_.bounceRays);
    for (float change = 1.0f; change > kSettled;) {
        std::vector<glm::vec3> reflected(atlas_.pixels());
        forEach(reflected.size(), [&](size_t p) {
            reflected[p] = baked_.albedo[p] * (baked_.direct[p] + baked_.indirect[p]);
        });
        std::vector<glm::vec3> next = outside_;
        forEach(texels_.size(), [&](size_t t) {
            glm::vec3 sum(0.0f);
            for (size_t i = t * rays; i < (t + 1) * rays; ++i)
                if (metPixel_[i] != kNoPixel) sum += reflected[metPixel_[i]];
            next[pixelOf(texels_[t])] += sum / static_cast<float>(rays);
        });
        double before = 0.0;
        double after = 0.0;
        for (size_t p = 0; p < next.size(); ++p) {
            before += static_cast<double>(baked_.direct[p].g + baked_.indirect[p].g);
            after += static_cast<double>(baked_.direct[p].g + next[p].g);
        }
        change = static_cast<float>((after - before) / std::max(after, 1e-12));
        baked_.indirect = std::move(next);
    }
}

/// Mean over the texels around each in its chart, which all see nearly the same.
void Baker::smoothIndirect()
{
    const std::vector<glm::vec3> noisy = baked_.indirect;
    forEach(texels_.size(), [&](size_t t) {
        const TexelPlace& texel = texels_[t];
        const glm::ivec2 end = atlas_.charts[texel.chart].pixels - 1;
        glm::vec3 sum(0.0f);
        float weights = 0.0f;
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                const glm::ivec2 at = texel.at + glm::ivec2(dx, dy);
                if (at != glm::clamp(at, glm::ivec2(0), end)) continue;
                const size_t pixel = pixelOf({texel.chart, at});
                if (baked_.isHidden[pixel] != 0) continue;
                const float weight = (dx == 0 ? 2.0f : 1.0f) * (dy == 0 ? 2.0f : 1.0f);
                sum += weight * noisy[pixel];
                weights += weight;
            }
        baked_.indirect[pixelOf(texel)] = weights > 0.0f ? sum / weights : glm::vec3(0.0f);
    });
}

Baked Baker::bake()
{
    const size_t pixels = atlas_.pixels();
    for (auto* layer : {&baked_.albedo, &baked_.direct, &baked_.indirect, &baked_.emission})
        layer->resize(pixels);
    baked_.isCovered.resize(pixels);
    baked_.isHidden.resize(pixels);
    outside_.resize(pixels);
    metPixel_.assign(texels_.size() * static_cast<size_t>(options_.bounceRays), kNoPixel);
    addMaterial();
    forEachChunk(texels_.size(), kTexelsAtOnce, [&](size_t begin, size_t end) {
        for (size_t t = begin; t < end; ++t) {
            Random random(options_.seed, 0, t);
            addSent(t, random);
            addMet(t, random);
        }
    });
    bounce();
    smoothIndirect();
    for (size_t p = 0; p < pixels; ++p)
        if (baked_.isHidden[p] != 0) baked_.direct[p] = baked_.indirect[p] = glm::vec3(0.0f);
    return std::move(baked_);
}

} // namespace

Baked bake(const Room& room, const Atlas& atlas, const BakeOptions& options)
{
    return Baker(room, atlas, options).bake();
}

} // namespace relamp::rooms
