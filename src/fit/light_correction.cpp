#include "fit/light_correction.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "base/sampling.shared.h"
#include "fit/light_fit_search.h"
#include "fit/pairs.h"
#include "fit/reliability.h"
#include "lights/candidates.h"
#include "relamp/delight.h"
#include "shading/gathered_light.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <tuple>
#include <utility>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

namespace relamp
{
namespace
{

constexpr float kColorStep = 0.1f; // of log (r / g) and log (b / g) between neighbours, likewise

// What an error of 1 is held against one pair of neighbours: errors of light are wide, so that all
// places of some hundred make one mistake.
constexpr float kBelief = 3e-5f;

// Pairs of one paint all over the scan.
constexpr float kPaintBrightness = 0.5f; // of log albedo
constexpr float kFarWeight = 0.02f;      // of a pair beside one of neighbours

// A thin pattern in the open is paint: a joint between tiles, dots on a wallpaper.
constexpr int kThin = 2;               // rings of neighbours; a line is narrower than twice that
constexpr float kOneSidedRing = 0.35f; // surfel sizes, of the mean way to those beside one
constexpr float kOpen = 0.015f; // share of a view that is so near: less, and nothing throws one

constexpr float kShadow = 0.35f; // m; reach of one that things throw which have grown together

// Numerics.
constexpr int kDraws = 2;            // of pairs that a place is in; each draw gives it two
constexpr size_t kTexelsOfMean = 32; // whose light stands for that of a run
constexpr int kMostRings = 32;       // of a shadow in a fine mesh; for time alone
constexpr float kMostShare = 255.0f / CorrectionMap::kAll; // that a result can keep

/// Albedo as the light found makes it, in logarithms.
struct Paint
{
    float brightness;
    float even;   // the same without thin patterns
    float red;    // over green
    float blue;   // over green
    float belief; // in the light; < 0: nothing is known here
    float lit;    // log share of the light that is expected to be there
};

std::vector<Paint> paintOf(const SurfelRadiance& radiance, const SurfelLighting& light,
                           std::span<const LightVariance> variance, float gaps)
{
    std::vector<Paint> paint(light.irradiance.size());
    forEach(paint.size(), [&](size_t s) {
        const glm::vec3 seen = radiance.plain[s];
        const glm::vec3 found = light.irradiance[s];
        const float green = logOfLight(seen.g) - logOfLight(found.g);
        const bool isKnown = radiance.plainArea[s] > 0.0f && isHardlyBurntOut(radiance, s);
        const float belief = kBelief / variance[s].ofMesh();
        const float brightness = logOfLight(luminance(seen)) - logOfLight(luminance(found));
        paint[s] = {brightness,
                    brightness,
                    logOfLight(seen.r) - logOfLight(found.r) - green,
                    logOfLight(seen.b) - logOfLight(found.b) - green,
                    isKnown ? belief : -1.0f,
                    std::log(shareExpected(variance[s], gaps))};
    });
    return paint;
}

/// How alike two neighbours' paint is, by colour: 0..1.
float alike(const Paint& a, const Paint& b)
{
    const float red = (a.red - b.red) / kColorStep;
    const float blue = (a.blue - b.blue) / kColorStep;
    const float far = 1.0f + red * red + blue * blue;
    return 1.0f / (far * far);
}

/// Every surfel with those beside it; entries of s are first[s] .. first[s + 1] - 1, itself first.
struct Sheet
{
    std::vector<int> first{0};
    std::vector<int> surfel;
    std::vector<float> alike; // in colour
    std::vector<char> atRim;  // of surfels: the others lie on one side of it

    [[nodiscard]] size_t count() const { return first.size() - 1; }
    [[nodiscard]] size_t begin(size_t s) const { return static_cast<size_t>(first[s]); }
    [[nodiscard]] size_t end(size_t s) const { return static_cast<size_t>(first[s + 1]); }
};

Sheet sheetOf(const Surfels& surfels, std::span<const Paint> paint)
{
    Sheet sheet;
    const auto add = [&](size_t n, float alike) {
        sheet.surfel.push_back(static_cast<int>(n));
        sheet.alike.push_back(alike);
    };
    for (size_t s = 0; s < surfels.count(); ++s) {
        add(s, 1.0f);
        glm::vec3 ways(0.0f);
        for (const uint32_t n : surfels.neighborsOf(s)) {
            const glm::vec3 way = surfels.position[n] - surfels.position[s];
            if (n == s || paint[s].belief < 0.0f || paint[n].belief < 0.0f ||
                !surfels.areBeside(s, n))
                continue;
            add(n, alike(paint[s], paint[n]));
            ways += way;
        }
        sheet.first.push_back(static_cast<int>(sheet.surfel.size()));
        const auto beside = static_cast<float>(sheet.end(s) - sheet.begin(s) - 1);
        sheet.atRim.push_back(glm::length(ways) > kOneSidedRing * surfels.size * beside);
    }
    return sheet;
}

/// What `pick(s, i, own, other)` makes of each value, ring by ring: of surfel s and the entries i
/// of its sheet.
template<class Pick>
std::vector<float> byRings(const Sheet& sheet, std::vector<float> values, int rings,
                           const Pick& pick)
{
    std::vector<float> before;
    for (int ring = 0; ring < rings; ++ring) {
        before = values;
        forEach(values.size(), [&](size_t s) {
            for (size_t i = sheet.begin(s); i < sheet.end(s); ++i)
                values[s] = pick(s, i, values[s], before[static_cast<size_t>(sheet.surfel[i])]);
        });
    }
    return values;
}

/// The values without what is low and thin, by morphological closing; nothing is closed at a rim,
/// for beyond it the values may go on falling.
std::vector<float> closed(const Sheet& sheet, std::vector<float> values)
{
    const auto greater = [&](size_t s, size_t, float own, float other) {
        return sheet.atRim[s] ? own : std::max(own, other);
    };
    const auto less = [](size_t, size_t, float own, float other) { return std::min(own, other); };
    return byRings(sheet, byRings(sheet, std::move(values), kThin, greater), kThin, less);
}

/// Adds the most that shadows which nothing throws have taken of each surfel's light, in
/// logarithms: what it lacks beside one of its colour within their reach, as far as the mesh has
/// `gaps`.
void addShadows(const Surfels& surfels, const Sheet& sheet, std::span<const glm::vec3> irradiance,
                float gaps, std::vector<float>& most)
{
    std::vector<float> found(irradiance.size());
    forEach(found.size(), [&](size_t s) { found[s] = logOfLight(luminance(irradiance[s])); });
    const auto rings = static_cast<int>(std::min(kShadow / surfels.size + 0.5f, float{kMostRings}));
    const auto greaterOfItsColour = [&](size_t, size_t i, float own, float other) {
        return sheet.alike[i] > 0.5f ? std::max(own, other) : own;
    };
    const std::vector<float> around = byRings(sheet, found, rings, greaterOfItsColour);
    forEach(most.size(), [&](size_t s) { most[s] += gaps * (around[s] - found[s]); });
}

/// How much of what a surfel sees is near it, 0..1.
float nearness(const Surfels& surfels, const HitLists& hits, size_t surfel)
{
    const std::span<const HitTarget> targets = hits.targetsOf(surfel);
    const float near = 5.0f * kScanError; // what throws so thin a shadow is about that near
    float sum = 0.0f;
    for (const HitTarget target : targets) {
        if (target.isNothing()) continue;
        const glm::vec3 way = surfels.position[target.side().surfel()] - surfels.position[surfel];
        sum += near * near / (near * near + glm::dot(way, way));
    }
    return targets.empty() ? 0.0f : sum / static_cast<float>(targets.size());
}

/// Takes thin patterns out of the paint where nothing is near that would throw them as shadows:
/// what is darker than all around, and then what is brighter.
void clearOfPatterns(const Surfels& surfels, const HitLists& hits, const Sheet& sheet,
                     std::vector<Paint>& paint)
{
    std::vector<float> values(paint.size());
    for (const float sign : {1.0f, -1.0f}) {
        for (size_t s = 0; s < paint.size(); ++s) values[s] = sign * paint[s].even;
        const std::vector<float> without = closed(sheet, values);
        forEach(paint.size(), [&](size_t s) {
            if (without[s] - values[s] > 0.5f * kPaintStep && nearness(surfels, hits, s) < kOpen)
                paint[s].even = sign * without[s];
        });
    }
}

/// Partners of every surfel that may be of its paint, wherever they are; those of s are
/// partner[first[s]] .. partner[first[s + 1] - 1].
struct Partners
{
    std::vector<uint32_t> first;
    std::vector<uint32_t> partner;
};

/// The class of a paint among cells whose edges lie elsewhere in each draw.
uint64_t classOf(const Paint& paint, uint seed, uint draw)
{
    const auto cell = [&](float value, float width, uint salt) {
        const float shifted = value / width + seededShift(seed, draw, salt);
        return static_cast<uint64_t>(shifted + 1048576.0f); // the middle of 21 bits
    };
    return cell(paint.red, 0.5f * kColorStep, 1) << 42 |
           cell(paint.blue, 0.5f * kColorStep, 2) << 21 | cell(paint.even, kPaintBrightness, 3);
}

/// Chains the surfels of each class in a random order, in each draw anew.
Partners partnersOf(std::span<const Paint> paint, uint seed)
{
    struct Drawn
    {
        uint64_t paint;
        float order;
        uint32_t surfel;
    };
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    Partners partners{std::vector<uint32_t>(paint.size() + 1, 0), {}};
    for (uint draw = 0; draw < kDraws; ++draw) {
        std::vector<Drawn> drawn;
        for (uint32_t s = 0; s < paint.size(); ++s)
            if (paint[s].belief >= 0.0f)
                drawn.push_back(
                    {classOf(paint[s], seed, draw), seededShift(seed, s, 10 + draw), s});
        std::sort(drawn.begin(), drawn.end(), [](const Drawn& a, const Drawn& b) {
            return std::tie(a.paint, a.order, a.surfel) < std::tie(b.paint, b.order, b.surfel);
        });
        for (size_t i = 1; i < drawn.size(); ++i)
            if (drawn[i].paint == drawn[i - 1].paint)
                pairs.emplace_back(drawn[i].surfel, drawn[i - 1].surfel);
    }
    for (const auto& [a, b] : pairs) {
        ++partners.first[a + 1];
        ++partners.first[b + 1];
    }
    std::partial_sum(partners.first.begin(), partners.first.end(), partners.first.begin());
    partners.partner.resize(2 * pairs.size());
    std::vector<uint32_t> next = partners.first;
    for (const auto& [a, b] : pairs) {
        partners.partner[next[a]++] = b;
        partners.partner[next[b]++] = a;
    }
    return partners;
}

using Matrix = Eigen::SparseMatrix<float, Eigen::RowMajor>;

/// What the light comes to where paint is even but for edges, and light stays where it is believed:
/// logs of the light that is there over that which was found.
class Settling
{
public:
    Settling(const Sheet& sheet, const Partners& partners, std::span<const Paint> paint);

    Eigen::VectorXf run();

private:
    [[nodiscard]] Eigen::Index count() const { return static_cast<Eigen::Index>(paint_.size()); }
    void weigh(size_t s);

    const Sheet& sheet_;
    std::span<const Paint> paint_;
    std::vector<int> first_{0}; // a row of the matrix: itself, those beside it, its partners
    std::vector<int> column_;
    std::vector<float> weight_;
    Eigen::VectorXf lit_;
    Eigen::VectorXf pull_; // the right side
};

Settling::Settling(const Sheet& sheet, const Partners& partners, std::span<const Paint> paint)
    : sheet_(sheet), paint_(paint), lit_(count()), pull_(count())
{
    lit_.setZero();
    for (size_t s = 0; s < paint.size(); ++s) {
        column_.insert(column_.end(), sheet.surfel.begin() + sheet.first[s],
                       sheet.surfel.begin() + sheet.first[s + 1]);
        column_.insert(column_.end(), partners.partner.begin() + partners.first[s],
                       partners.partner.begin() + partners.first[s + 1]);
        first_.push_back(static_cast<int>(column_.size()));
    }
    weight_.resize(column_.size());
}

/// Of brightness from b to a. Within a pattern it is as it shows, into one there is none.
float stepBetween(const Paint& a, const Paint& b)
{
    const float step = a.brightness - b.brightness;
    const float even = a.even - b.even;
    return std::abs(even) < std::abs(step) ? even : step;
}

/// 1 for albedos that are alike, 0 across an edge (Geman and McClure's loss).
float tieOver(float edge)
{
    const float far = 1.0f + edge * edge / (kPaintStep * kPaintStep);
    return 1.0f / (far * far);
}

/// A step that paint would not make is light's.
void Settling::weigh(size_t s)
{
    const Paint& own = paint_[s];
    const auto begin = static_cast<size_t>(first_[s]);
    const auto end = static_cast<size_t>(first_[s + 1]);
    const size_t beside = sheet_.end(s) - sheet_.begin(s) - 1;
    const float lit = lit_[static_cast<Eigen::Index>(s)];
    float sum = std::max(own.belief, 0.0f) * static_cast<float>(std::max<size_t>(beside, 1));
    float pull = sum * own.lit;
    for (size_t i = begin + 1; i < end; ++i) {
        const bool isNear = i - begin <= beside;
        const Paint& other = paint_[static_cast<size_t>(column_[i])];
        const float step = isNear ? stepBetween(own, other) : own.even - other.even;
        const float share = isNear ? sheet_.alike[sheet_.begin(s) + i - begin] : kFarWeight;
        const float weight = share * tieOver(lit_[column_[i]] + step - lit);
        weight_[i] = -weight;
        sum += weight;
        pull += weight * step;
    }
    weight_[begin] = sum;
    pull_[static_cast<Eigen::Index>(s)] = pull;
}

Eigen::VectorXf Settling::run()
{
    const Eigen::Map<const Matrix> weights(count(), count(),
                                           static_cast<Eigen::Index>(weight_.size()), first_.data(),
                                           column_.data(), weight_.data());
    Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> solver;
    solver.setMaxIterations(12);
    for (int round = 0; round < 6; ++round) { // weights follow from the light before
        forEach(paint_.size(), [&](size_t s) { weigh(s); });
        lit_ = solver.compute(weights).solveWithGuess(pull_, lit_);
    }
    return std::move(lit_);
}

/// Log share of the middle of all places: what they lose alike is no leak but the room's level.
float levelOf(std::span<const Paint> paint, std::span<const float> lit)
{
    std::vector<double> known;
    for (size_t s = 0; s < lit.size(); ++s)
        if (paint[s].belief >= 0.0f) known.push_back(static_cast<double>(lit[s]));
    return static_cast<float>(medianOfAll(std::move(known)));
}

struct TexelRange // of a page
{
    size_t begin;
    size_t end;
};

/// Texels of a run that tell its mean: where there are many, those of its middle rows.
TexelRange middleOf(const PageTexels& page, size_t run)
{
    const size_t begin = page.runs[run].begin;
    const size_t end = page.runs[run + 1].begin;
    const size_t left = end - begin - std::min(end - begin, kTexelsOfMean);
    return {begin + left / 2, end - (left - left / 2)};
}

/// Calls `work(begin, count)` for the middles of runs, those that touch together.
template<class Work>
void forEachMiddle(const PageTexels& page, size_t firstRun, size_t endRun, const Work& work)
{
    TexelRange all = middleOf(page, firstRun);
    for (size_t run = firstRun + 1; run < endRun; ++run) {
        const TexelRange next = middleOf(page, run);
        if (next.begin == all.end && next.end - all.begin <= TexelBlock::kCapacity) {
            all.end = next.end;
            continue;
        }
        work(all.begin, all.end - all.begin);
        all = next;
    }
    work(all.begin, all.end - all.begin);
}

} // namespace

SurfelLighting foundLight(const Texels& texels, const SurfelRadiance& radiance,
                          const TexelShading& shade, std::vector<float> spread)
{
    SurfelLighting light{std::vector<glm::vec3>(texels.surfels.count(), glm::vec3(0.0f)),
                         std::move(spread)};
    std::vector<float> counts(texels.surfels.count(), 0.0f);
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        const PageTexels& page = texels.pages[p];
        const TexelLoader loader(texels, p);
        forEachChunk(page.runs.size() - 1, 64, [&](size_t firstRun, size_t endRun) {
            TexelBlock block;
            ShadingBlock shading;
            forEachMiddle(page, firstRun, endRun, [&](size_t begin, size_t count) {
                loader.loadGeometry(begin, count, block);
                loader.loadSurfel(begin, count, block);
                shade(p, begin, block, shading);
                for (size_t i = 0; i < count; ++i) {
                    const uint32_t s = block.surfel[i];
                    const bool isPlain = !radiance.isClipped[p][page.pixel[begin + i]];
                    const float weight = isPlain || radiance.plainArea[s] == 0.0f ? 1.0f : 0.0f;
                    counts[s] += weight;
                    light.irradiance[s] += weight * kPi *
                                           glm::vec3(shading.direct.r[i] + shading.indirect.r[i],
                                                     shading.direct.g[i] + shading.indirect.g[i],
                                                     shading.direct.b[i] + shading.indirect.b[i]);
                }
            });
        });
    }
    for (size_t s = 0; s < counts.size(); ++s)
        if (counts[s] > 0.0f) light.irradiance[s] /= counts[s];
    return light;
}

std::vector<float> correctionOf(const Surfels& surfels, const SurfelRadiance& radiance,
                                const HitLists& hits, const SurfelLighting& light, float gaps)
{
    if (light.irradiance.empty()) return {};
    std::vector<Paint> paint = paintOf(radiance, light, varianceOf(hits, light), gaps);
    const Sheet sheet = sheetOf(surfels, paint);
    clearOfPatterns(surfels, hits, sheet, paint);
    const Eigen::VectorXf lit = Settling(sheet, partnersOf(paint, surfels.seed), paint).run();
    std::vector<float> most(surfels.count(), kAlwaysUnsure);
    if (gaps > 0.0f) addShadows(surfels, sheet, light.irradiance, gaps, most);
    std::vector<float> shares(surfels.count());
    for (size_t s = 0; s < shares.size(); ++s)
        shares[s] = std::min(lit[static_cast<Eigen::Index>(s)], most[s]);
    const float level = levelOf(paint, shares);
    for (float& share : shares) share = std::min(std::exp(share - level), kMostShare);
    return shares;
}

TexelShading corrected(const Texels& texels, TexelShading shade, std::span<const float> lit)
{
    if (lit.empty()) return shade;
    std::vector<glm::vec3> shares;
    shares.reserve(lit.size());
    for (const float share : lit) shares.emplace_back(kPi * share);
    return [&texels, shade = std::move(shade),
            shares = std::make_shared<const std::vector<glm::vec3>>(std::move(shares))](
               size_t page, size_t begin, const TexelBlock& block, ShadingBlock& out) {
        shade(page, begin, block, out);
        RgbBlock share;
        interpolate(texels, *shares, page, begin, block, share);
        for (RgbBlock* part : {&out.direct, &out.indirect})
            for (float* channel : {part->r, part->g, part->b})
                for (size_t i = 0; i < block.count; ++i) channel[i] *= share.r[i];
    };
}

std::vector<glm::vec3> corrected(std::span<const glm::vec3> ofSurfels, std::span<const float> lit)
{
    std::vector<glm::vec3> result(ofSurfels.begin(), ofSurfels.end());
    for (size_t s = 0; s < lit.size(); ++s) result[s] *= lit[s];
    return result;
}

/// More than 1 would let every bounce add light.
std::vector<glm::vec3> reflectanceBy(std::span<const glm::vec3> albedo, std::span<const float> lit)
{
    std::vector<glm::vec3> reflectance = corrected(albedo, lit);
    for (glm::vec3& share : reflectance) share = glm::min(share, 1.0f);
    return reflectance;
}

} // namespace relamp
