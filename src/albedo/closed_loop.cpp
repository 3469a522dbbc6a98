#include "albedo/closed_loop.h"

#include "albedo/divide.shared.h"
#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "base/random.h"
#include "fit/light_correction.h"
#include "shading/lit_sides.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace relamp
{
namespace
{

constexpr size_t kBins = 5;
constexpr double kLeastSquare = 1e-12; // -120 dB
constexpr float kBlack = 1e-4f;        // albedo and radiance; ratios to less mean nothing

struct TexelAt
{
    size_t page;
    size_t texel;
};

TexelAt texelAt(const Texels& texels, size_t index)
{
    size_t page = 0;
    while (index >= texels.pages[page].count()) index -= texels.pages[page++].count();
    return {page, index};
}

struct AlbedoSum
{
    glm::vec3 albedo{0.0f};
    float area = 0.0f;
};

/// Sums of the runs of a page over texels that are not burnt out.
std::vector<AlbedoSum> sumRuns(const Texels& texels, size_t p, const std::vector<bool>& isClipped,
                               const Image& image)
{
    const PageTexels& page = texels.pages[p];
    const TexelLoader loader(texels, p);
    const Radiance albedo(image);
    std::vector<AlbedoSum> sums(page.runs.size() - 1);
    forEachRun(page, [&](size_t run, TexelBlock& block) {
        forEachBlockOfRun(page, run, [&](size_t begin, size_t count) {
            loader.loadArea(begin, count, block);
            for (size_t i = 0; i < count; ++i) {
                const uint32_t pixel = page.pixel[begin + i];
                if (isClipped[pixel]) continue;
                sums[run].albedo += block.area[i] * glm::min(albedo[pixel], 1.0f);
                sums[run].area += block.area[i];
            }
        });
    });
    return sums;
}

/// Squared error of places, the noise taken off: by area, mean of the channels.
struct ErrorSum
{
    double error = 0.0;
    double squaredError = 0.0;
    double weighted = 0.0; // error, by the square of area, as is the next
    double squaredArea = 0.0;
    double scan = 0.0;
    double area = 0.0;
    glm::dvec3 rendered{0.0};
    glm::dvec3 shown{0.0};

    void add(const RenderedPlace& place)
    {
        const auto weight = static_cast<double>(place.area);
        const double own = weight * place.squaredError();
        error += own;
        squaredError += own * own;
        weighted += weight * own;
        squaredArea += weight * weight;
        scan += weight * static_cast<double>(glm::dot(place.scan, place.scan)) / 3.0;
        area += weight;
        rendered += weight * 0.5 * glm::dvec3(place.first + place.second);
        shown += weight * glm::dvec3(place.scan);
    }
    /// Of the mean square, by the scatter of the places.
    [[nodiscard]] double standardError() const
    {
        const double mean = error / area;
        const double squares = squaredError - 2.0 * mean * weighted + mean * mean * squaredArea;
        return std::sqrt(std::max(squares, 0.0)) / area;
    }
    /// No less than the noise could hide.
    [[nodiscard]] double meanSquare() const
    {
        return std::max({error / area, standardError(), kLeastSquare});
    }
};

/// The whitest that divide() gives, as a half float.
bool isAsWhiteAsPaper(const RenderedPlace& place)
{
    return brightestChannel(place.albedo) > kWhitePaint - 1e-3f;
}

float shadingOf(const RenderedPlace& place)
{
    return luminance(place.scan) / std::max(luminance(place.albedo), kBlack);
}

VerifiedBin binOf(std::span<const RenderedPlace> places)
{
    ErrorSum sum;
    double shading = 0.0;
    for (const RenderedPlace& place : places) {
        sum.add(place);
        shading += static_cast<double>(place.area * shadingOf(place));
    }
    return {static_cast<float>(shading / sum.area),
            luminance(sum.rendered) / std::max(luminance(sum.shown), kBlack),
            static_cast<float>(std::sqrt(sum.meanSquare()))};
}

/// Fifths of equal area, from dark to bright.
std::vector<VerifiedBin> binsOf(std::span<const RenderedPlace> sorted, double area)
{
    std::vector<VerifiedBin> bins;
    size_t begin = 0;
    double reached = 0.0;
    for (size_t end = 0; end < sorted.size();) {
        reached += static_cast<double>(sorted[end++].area);
        const bool isFull = reached * kBins >= area * static_cast<double>(bins.size() + 1);
        if (!isFull && end < sorted.size()) continue;
        bins.push_back(binOf(sorted.subspan(begin, end - begin)));
        begin = end;
    }
    return bins;
}

/// A TexelShading: 1 everywhere, all of it indirect.
void evenShading(size_t /*page*/, size_t /*begin*/, const TexelBlock& block, ShadingBlock& out)
{
    for (float* channel : {out.direct.r, out.direct.g, out.direct.b})
        std::fill_n(channel, block.count, 0.0f);
    for (float* channel : {out.indirect.r, out.indirect.g, out.indirect.b})
        std::fill_n(channel, block.count, 1.0f);
}

} // namespace

std::vector<glm::vec3> meanAlbedo(const Texels& texels, const SurfelRadiance& radiance,
                                  std::span<const Image> albedo)
{
    std::vector<AlbedoSum> total(texels.surfels.count());
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        const std::vector<AlbedoSum> sums = sumRuns(texels, p, radiance.isClipped[p], albedo[p]);
        for (size_t run = 0; run < sums.size(); ++run) {
            total[texels.pages[p].runs[run].surfel].albedo += sums[run].albedo;
            total[texels.pages[p].runs[run].surfel].area += sums[run].area;
        }
    }
    std::vector<glm::vec3> mean(total.size(), glm::vec3(0.0f));
    for (size_t s = 0; s < mean.size(); ++s)
        if (total[s].area > 0.0f) mean[s] = total[s].albedo / total[s].area;
    guessBurntOut(texels, radiance, mean);
    return mean;
}

std::vector<RenderedPlace> renderAgain(const Texels& texels, const PathTracer& tracer,
                                       const DelitSurface& surface,
                                       const Linearization& linearization,
                                       const VerifyOptions& options, Progress& progress)
{
    const TexelShading shareOfLight = corrected(texels, evenShading, surface.lit);
    std::deque<TexelLoader> loaders;
    std::vector<Radiance> albedoOf;
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        loaders.emplace_back(texels, p, &linearization);
        albedoOf.emplace_back(surface.albedo[p]);
    }
    const size_t all = texels.count();
    const size_t paths = std::max<size_t>(static_cast<size_t>(options.samples) / 2, 1);
    std::vector<RenderedPlace> places(std::min(static_cast<size_t>(options.places), all));
    Progress::Stage stage(progress, "paths", places.size());
    forEachChunk(places.size(), 64, [&](size_t begin, size_t end) {
        TexelBlock block;
        ShadingBlock share;
        for (size_t i = begin; i < end; ++i) {
            const auto [page, texel] = texelAt(texels, i * all / places.size());
            loaders[page].load(texel, 1, block);
            loaders[page].loadArea(texel, 1, block);
            const uint32_t pixel = texels.pages[page].pixel[texel];
            if (tracer.room().isClipped[page][pixel]) continue;
            shareOfLight(page, texel, block, share);
            const TexelSite site = texels.siteOf(page, texel);
            const glm::vec3 rho = albedoOf[page][pixel];
            const auto render = [&](uint64_t sequence) {
                return share.indirect.r[0] * glm::min(rho, 1.0f) *
                       tracer.shade(site, paths, {options.seed, sequence, i}).total();
            };
            places[i] = {
                block.area[0], {block.r[0], block.g[0], block.b[0]}, rho, render(0), render(1)};
        }
        stage.advance(end - begin);
    });
    return places;
}

void compare(std::span<const RenderedPlace> places, Verification& result)
{
    std::vector<RenderedPlace> sorted;
    ErrorSum sum;
    ErrorSum elsewhere;
    for (const RenderedPlace& place : places) {
        if (place.area <= 0.0f) continue;
        sorted.push_back(place);
        sum.add(place);
        if (!isAsWhiteAsPaper(place)) elsewhere.add(place);
    }
    result.places = sorted.size();
    if (sorted.empty()) return;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return shadingOf(a) < shadingOf(b); });
    const double rms = std::sqrt(sum.meanSquare());
    result.rmsError = static_cast<float>(rms);
    result.standardError = static_cast<float>(sum.standardError() / (2.0 * rms));
    result.asWhiteAsPaper = static_cast<float>(1.0 - elsewhere.area / sum.area);
    if (elsewhere.area > 0.0)
        result.rmsErrorElsewhere = static_cast<float>(std::sqrt(elsewhere.meanSquare()));
    result.rmsOfScan = static_cast<float>(std::sqrt(sum.scan / sum.area));
    result.psnr = static_cast<float>(-10.0 * std::log10(sum.meanSquare()));
    result.ratio = glm::vec3(sum.rendered / glm::max(sum.shown, 1e-9));
    result.bins = binsOf(sorted, sum.area);
}

} // namespace relamp
