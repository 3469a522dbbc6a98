#include "scan/overlap.h"

#include "base/fail.h"
#include "scan/texels.h"

#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr double kMostApart = 0.03; // share of texels; measured, see docs/method/texels.md
constexpr float kSkins = 0.02f;     // m, between two surfaces that are one thing's
constexpr float kLeastStep = 5e-4f; // m, of one before the other

/// Whether the page is seen the right way round in the room.
bool isTurnedOver(const Facet& facet)
{
    return glm::dot(glm::cross(facet.positionX, facet.positionY), facet.normal) < 0.0f;
}

std::string kindsOf(const Overlap& overlap)
{
    const std::pair<double, const char*> kinds[] = {
        {overlap.tiled, "tiled (the texture repeats beyond its edge)"},
        {overlap.mirrored, "mirrored (two places show one part of it, turned over)"},
        {overlap.copied, "copied (two places show one part of it)"},
        {overlap.opposite, "of doubled skins that face apart (two surfaces within 2 cm)"},
        {overlap.alike, "of doubled skins that face alike, which get the same light"}};
    std::string text;
    for (const auto& [share, name] : kinds)
        if (share >= 5e-5)
            text += fmt::format("{}{:.2f} % {}", text.empty() ? "" : ", ", 100.0 * share, name);
    return text;
}

std::string sentenceOn(const Overlap& overlap)
{
    std::string meshes;
    for (const std::string& mesh : overlap.meshes)
        meshes += fmt::format("{}\"{}\"", meshes.empty() ? "" : ", ", mesh);
    return fmt::format("{:.2f} % of its texels stand for several places: {}; most in {}",
                       100.0 * overlap.share(), kindsOf(overlap), meshes);
}

} // namespace

OverlapKind overlapKindOf(const Facet& a, const Facet& b, glm::vec2 pixel, bool isSameTile)
{
    const glm::vec3 way = siteOn(b, pixel).position - siteOn(a, pixel).position;
    if (glm::dot(way, way) < kSkins * kSkins)
        return glm::dot(a.normal, b.normal) > 0.0f ? OverlapKind::alike : OverlapKind::opposite;
    if (!isSameTile) return OverlapKind::tiled;
    return isTurnedOver(a) != isTurnedOver(b) ? OverlapKind::mirrored : OverlapKind::copied;
}

bool isBefore(const Facet& a, const Facet& b, glm::vec2 pixel)
{
    return glm::dot(siteOn(b, pixel).position - siteOn(a, pixel).position,
                    glm::normalize(a.normal + b.normal)) > kLeastStep;
}

std::optional<std::string> noteOn(const Overlap& overlap)
{
    if (overlap.share() < kSeams) return std::nullopt;
    std::string note = sentenceOn(overlap);
    if (spoils(overlap))
        note += ". It spoils the room, and delight refuses it without --allow-overlap: unwrap them "
                "without overlap and bake the texture, or leave them out with --skip-mesh";
    else if (overlap.inOtherLight() >= kSeams)
        note += ". Their albedo is right for one of these places at most, and has low confidence";
    return note;
}

bool spoils(const Overlap& overlap)
{
    return overlap.tiled + overlap.mirrored + overlap.copied > kMostApart;
}

void checkOverlap(const Texels& texels)
{
    if (!spoils(texels.overlap) || texels.scan->options.allowOverlap) return;
    fail(ErrorCode::unsupported, texels.scan->title(),
         sentenceOn(texels.overlap) +
             ".\nLight can only be taken off where every place has a texel of its own: unwrap them "
             "without overlap and bake the texture, leave them out with --skip-mesh, or go on all "
             "the same with --allow-overlap.");
}

} // namespace relamp
