#include "fit/stray.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "fit/pairs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Dense>

namespace relamp
{
namespace
{

constexpr size_t kStrayPlaces = 6000;
constexpr size_t kPairs = 6;                  // of a place
constexpr size_t kTexels = 64;                // of a place, at most
constexpr float kMostOfPlaceBurntOut = 0.02f; // of a place
constexpr double kScale = 0.25;               // of the Cauchy loss, octaves
constexpr double kStiffness = 5e-4;           // of the curve, in pairs' squared residuals
constexpr int kStrayRounds = 20;
constexpr float kDarkestStray = 1e-4f; // shading

using Row = Eigen::Matrix<double, StrayLight::kKnots, 1>;

/// Where a shading lies between two knots.
struct Between
{
    int knot;    // the lower; there is a higher
    float share; // of the higher, 0..1
};

Between knotsAround(float shading)
{
    constexpr int kLast = StrayLight::kKnots - 1;
    const float at = amongStrayKnots(shading);
    const int knot = std::min(static_cast<int>(at), kLast - 1);
    return {knot, at - static_cast<float>(knot)};
}

/// Weights of the knots around a shading; their sum is 1.
Row knotsAt(float shading)
{
    const auto [knot, share] = knotsAround(shading);
    Row row = Row::Zero();
    row[knot] = 1.0 - static_cast<double>(share);
    row[knot + 1] = static_cast<double>(share);
    return row;
}

/// Places to compare: texels of one surfel, on one page, next to nothing of it burnt out.
struct Places
{
    std::vector<uint32_t> surfels;
    FitData seen; // only its radiance
    std::vector<float> shading;
};

struct RunOfTexels
{
    size_t page;
    size_t run;
};

std::vector<RunOfTexels> goodRuns(const Texels& texels, const SurfelRadiance& radiance)
{
    std::vector<RunOfTexels> good;
    for (size_t p = 0; p < texels.pages.size(); ++p)
        for (size_t run = 0; run + 1 < texels.pages[p].runs.size(); ++run) {
            const uint32_t s = texels.pages[p].runs[run].surfel;
            if (radiance.plainArea[s] > 0.0f &&
                radiance.clippedArea[s] < kMostOfPlaceBurntOut * radiance.plainArea[s])
                good.push_back({p, run});
        }
    return good;
}

float meanShading(const Texels& texels, const TexelLoader& loader, RunOfTexels place,
                  const TexelShading& shade)
{
    const PageTexels& page = texels.pages[place.page];
    const size_t begin = page.runs[place.run].begin;
    const size_t count = std::min<size_t>(page.runs[place.run + 1].begin - begin, kTexels);
    TexelBlock block;
    loader.loadGeometry(begin, count, block);
    loader.loadSurfel(begin, count, block);
    ShadingBlock shading;
    shade(place.page, begin, block, shading);
    float sum = 0.0f;
    for (size_t i = 0; i < count; ++i)
        sum += luminance({shading.direct.r[i] + shading.indirect.r[i],
                          shading.direct.g[i] + shading.indirect.g[i],
                          shading.direct.b[i] + shading.indirect.b[i]});
    return sum / static_cast<float>(count);
}

Places placesOf(const Texels& texels, const SurfelRadiance& radiance, const TexelShading& shade)
{
    const std::vector<RunOfTexels> good = goodRuns(texels, radiance);
    const size_t count = std::min(kStrayPlaces, good.size());
    Places places;
    places.shading.resize(count);
    for (size_t i = 0; i < count; ++i) {
        const RunOfTexels& place = good[i * good.size() / count];
        places.surfels.push_back(texels.pages[place.page].runs[place.run].surfel);
        places.seen.radiance.push_back(radiance.plain[places.surfels.back()]);
    }
    std::vector<TexelLoader> loaders;
    for (size_t p = 0; p < texels.pages.size(); ++p) loaders.emplace_back(texels, p);
    forEachChunk(count, 64, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const RunOfTexels& place = good[i * good.size() / count];
            places.shading[i] = meanShading(texels, loaders[place.page], place, shade);
        }
    });
    return places;
}

/// What two places of a pair say: `row` * octaves is about -`apart`.
struct Equation
{
    Row row;
    double apart; // octaves by which p's albedo is above q's
};

std::vector<Equation> equationsOf(const Places& places, std::span<const MaterialPair> pairs)
{
    const auto logOf = [](float value) {
        return std::log2(static_cast<double>(std::max(value, kDarkestStray)));
    };
    std::vector<Row> knots;
    std::vector<double> albedo;
    for (size_t i = 0; i < places.shading.size(); ++i) {
        knots.push_back(knotsAt(places.shading[i]));
        albedo.push_back(logOf(luminance(places.seen.radiance[i])) - logOf(places.shading[i]));
    }
    std::vector<Equation> equations;
    for (const auto [p, q] : pairs)
        equations.push_back({knots[p] - knots[q], albedo[p] - albedo[q]});
    return equations;
}

/// Octaves by which the shading at each knot is too high, up to a common constant.
Row octavesOf(const std::vector<Equation>& equations)
{
    Eigen::Matrix<double, StrayLight::kKnots, StrayLight::kKnots> stiffness;
    stiffness.setIdentity();
    for (int k = 1; k + 1 < StrayLight::kKnots; ++k) {
        Row bend = Row::Zero();
        bend.segment<3>(k - 1) << 1.0, -2.0, 1.0;
        stiffness += bend * bend.transpose();
    }
    stiffness *= kStiffness * static_cast<double>(equations.size());
    Row octaves = Row::Zero();
    for (int round = 0; round < kStrayRounds; ++round) {
        auto left = stiffness;
        Row right = Row::Zero();
        for (const auto& [row, apart] : equations) {
            const double residual = (apart + row.dot(octaves)) / kScale;
            const double weight = 1.0 / (1.0 + residual * residual);
            left += weight * row * row.transpose();
            right -= weight * apart * row;
        }
        octaves = left.ldlt().solve(right);
    }
    return octaves;
}

} // namespace

float StrayLight::kept(float shading) const
{
    const auto [knot, share] = knotsAround(shading);
    const auto k = static_cast<size_t>(knot);
    return keptOfStray(octaves_[k], octaves_[k + 1], share);
}

StrayLight fitStray(const Texels& texels, const SurfelRadiance& radiance, const TexelShading& shade)
{
    Places places = placesOf(texels, radiance, shade);
    const std::vector<MaterialPair> pairs =
        drawPairs(places.seen, places.surfels, texels.surfels, kPairs);
    if (pairs.empty()) return StrayLight();
    const Row octaves = octavesOf(equationsOf(places, pairs));
    const auto middle = places.shading.begin() + static_cast<ptrdiff_t>(places.shading.size() / 2);
    std::nth_element(places.shading.begin(), middle, places.shading.end());
    const double right = knotsAt(*middle).dot(octaves);
    std::array<float, StrayLight::kKnots> tooHigh{};
    for (int k = 0; k < StrayLight::kKnots; ++k)
        if (StrayLight::kFirst + static_cast<float>(k) <
            std::log2(std::max(*middle, kDarkestStray)))
            tooHigh[static_cast<size_t>(k)] =
                static_cast<float>(std::clamp(octaves[k] - right, 0.0, 1.0));
    return StrayLight(tooHigh);
}

std::vector<glm::vec3> withoutStray(std::vector<glm::vec3> irradiance, const StrayLight& stray)
{
    for (glm::vec3& light : irradiance) light *= stray.kept(luminance(light) / kPi);
    return irradiance;
}

TexelShading withoutStray(TexelShading shade, const StrayLight& stray)
{
    if (stray.isNone()) return shade;
    return [shade = std::move(shade), stray](size_t page, size_t begin, const TexelBlock& block,
                                             ShadingBlock& out) {
        shade(page, begin, block, out);
        for (size_t i = 0; i < block.count; ++i) {
            const float kept = stray.kept(
                luminance({out.direct.r[i] + out.indirect.r[i], out.direct.g[i] + out.indirect.g[i],
                           out.direct.b[i] + out.indirect.b[i]}));
            for (RgbBlock* part : {&out.direct, &out.indirect})
                for (float* channel : {part->r, part->g, part->b}) channel[i] *= kept;
        }
    };
}

} // namespace relamp
