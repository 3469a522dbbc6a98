#include "fit/shade.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "shading/gathered_light.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

namespace relamp
{
namespace
{

constexpr float kBesideSurfel = 1.6f;         // surfel sizes
constexpr float kMostOfSurfelBurntOut = 0.1f; // of a surfel
constexpr float kPaintStep = 0.3f;   // of log albedo between neighbours: more is an edge of paint
constexpr float kColorStep = 0.1f;   // of log (r / g) and log (b / g), likewise
constexpr float kBelief = 0.002f;    // in the light found in the middle of all places
constexpr float kMostUneven = 0.05f; // of log light that is too dark: so much is noise
constexpr int kShadeRounds = 6;      // of weights that follow from the light before
constexpr int kSolverSteps = 12;     // of conjugate gradients in each
constexpr float kDarkestShade = 1e-4f;

// A thin pattern in the open is paint: a joint between tiles, dots on a wallpaper.
constexpr int kThin = 2;               // rings of neighbours; a line is narrower than twice that
constexpr float kShallow = 0.15f;      // of log albedo: a pattern is deeper
constexpr float kOneSidedRing = 0.35f; // surfel sizes, of the mean way to those beside one
constexpr float kNear = 0.1f;          // metres; what throws so thin a shadow is about that near
constexpr float kOpen = 0.015f; // share of a view that is so near: less, and nothing throws one

/// Albedo as the light found makes it, in logarithms.
struct Paint
{
    float brightness;
    float even;   // the same without thin patterns
    float red;    // over green
    float blue;   // over green
    float belief; // in the light; < 0: nothing is known here
};

float logOf(float value)
{
    return std::log(std::max(value, kDarkestShade));
}

/// Steep: what is darker than usual by an octave is believed 64 times less.
float beliefIn(float bright)
{
    const float squared = bright * bright;
    return kBelief * squared * squared * squared;
}

std::vector<Paint> paintOf(const SurfelRadiance& radiance, std::span<const glm::vec3> irradiance)
{
    std::vector<float> found;
    for (const glm::vec3 light : irradiance) found.push_back(luminance(light));
    const auto middle = found.begin() + static_cast<ptrdiff_t>(found.size() / 2);
    std::nth_element(found.begin(), middle, found.end());
    const float usual = std::max(*middle, kDarkestShade);
    std::vector<Paint> paint(irradiance.size());
    forEach(paint.size(), [&](size_t s) {
        const glm::vec3 seen = radiance.plain[s];
        const glm::vec3 light = irradiance[s];
        const float green = logOf(seen.g) - logOf(light.g);
        const float bright = luminance(light) / usual;
        const bool isKnown =
            radiance.plainArea[s] > 0.0f &&
            radiance.clippedArea[s] < kMostOfSurfelBurntOut * radiance.plainArea[s];
        const float brightness = logOf(luminance(seen)) - logOf(luminance(light));
        paint[s] = {brightness, brightness, logOf(seen.r) - logOf(light.r) - green,
                    logOf(seen.b) - logOf(light.b) - green, isKnown ? beliefIn(bright) : -1.0f};
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
    const float reach = kBesideSurfel * surfels.size;
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
                glm::dot(way, way) > reach * reach)
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

/// The values without what is low and thin, by morphological closing; nothing is closed at a rim,
/// for beyond it the values may go on falling.
std::vector<float> closed(const Sheet& sheet, std::vector<float> values)
{
    std::vector<float> before;
    const auto ring = [&](const auto& pick) {
        before = values;
        forEach(values.size(), [&](size_t s) {
            for (size_t i = sheet.begin(s); i < sheet.end(s); ++i)
                values[s] = pick(s, before[static_cast<size_t>(sheet.surfel[i])]);
        });
    };
    const auto greater = [&](size_t s, float other) {
        return sheet.atRim[s] ? values[s] : std::max(values[s], other);
    };
    const auto less = [&](size_t s, float other) { return std::min(values[s], other); };
    for (int i = 0; i < kThin; ++i) ring(greater);
    for (int i = 0; i < kThin; ++i) ring(less);
    return values;
}

/// How much of what a surfel sees is near it, 0..1.
float nearness(const Surfels& surfels, const HitLists& hits, size_t surfel)
{
    const std::span<const HitTarget> targets = hits.targetsOf(surfel);
    float sum = 0.0f;
    for (const HitTarget target : targets) {
        if (target.isNothing()) continue;
        const glm::vec3 way = surfels.position[target.side().surfel()] - surfels.position[surfel];
        sum += kNear * kNear / (kNear * kNear + glm::dot(way, way));
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
            if (without[s] - values[s] > kShallow && nearness(surfels, hits, s) < kOpen)
                paint[s].even = sign * without[s];
        });
    }
}

using Matrix = Eigen::SparseMatrix<float, Eigen::RowMajor>;

/// What the light comes to where paint is even but for edges, and light stays where it is believed:
/// logs of the light that is there over that which was found.
class Settling
{
public:
    Settling(const Sheet& sheet, std::span<const Paint> paint)
        : sheet_(sheet), paint_(paint), weight_(sheet.surfel.size()), lit_(count()), pull_(count())
    {
        lit_.setZero();
    }

    Eigen::VectorXf run();

private:
    [[nodiscard]] Eigen::Index count() const { return static_cast<Eigen::Index>(paint_.size()); }
    void weigh(Eigen::Index s);

    const Sheet& sheet_;
    std::span<const Paint> paint_;
    std::vector<float> weight_; // entries of a matrix: of the surfel itself, less those beside it
    Eigen::VectorXf lit_;
    Eigen::VectorXf pull_; // the right side
};

/// Of brightness from b to a. Within a pattern it is as it shows, into one there is none.
float stepBetween(const Paint& a, const Paint& b)
{
    const float step = a.brightness - b.brightness;
    const float even = a.even - b.even;
    return std::abs(even) < std::abs(step) ? even : step;
}

/// A step that paint would not make is light's.
void Settling::weigh(Eigen::Index s)
{
    const size_t begin = sheet_.begin(static_cast<size_t>(s));
    const size_t end = sheet_.end(static_cast<size_t>(s));
    float sum = paint_[static_cast<size_t>(s)].belief * static_cast<float>(end - begin - 1);
    float pull = 0.0f;
    for (size_t i = begin + 1; i < end; ++i) {
        const int n = sheet_.surfel[i];
        const float step =
            stepBetween(paint_[static_cast<size_t>(s)], paint_[static_cast<size_t>(n)]);
        const float edge = (lit_[n] + step - lit_[s]) / kPaintStep;
        const float far = 1.0f + edge * edge;
        const float weight = sheet_.alike[i] / (far * far);
        weight_[i] = -weight;
        sum += weight;
        pull += weight * step;
    }
    weight_[begin] = sum;
    pull_[s] = pull;
}

Eigen::VectorXf Settling::run()
{
    const Eigen::Map<const Matrix> weights(
        count(), count(), static_cast<Eigen::Index>(weight_.size()), sheet_.first.data(),
        sheet_.surfel.data(), weight_.data());
    Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> solver;
    solver.setMaxIterations(kSolverSteps);
    for (int round = 0; round < kShadeRounds; ++round) {
        forEach(paint_.size(), [&](size_t s) { weigh(static_cast<Eigen::Index>(s)); });
        lit_ = solver.compute(weights).solveWithGuess(pull_, lit_);
    }
    return std::move(lit_);
}

/// Shares of light, each the mean of a surfel and those around it: what comes and goes from surfel
/// to surfel is a pattern.
std::vector<float> sharesOf(const Sheet& sheet, const Eigen::VectorXf& lit)
{
    std::vector<float> shares(sheet.count());
    forEach(shares.size(), [&](size_t s) {
        float sum = 0.0f;
        float weights = 0.0f;
        for (size_t i = sheet.begin(s); i < sheet.end(s); ++i) {
            sum += sheet.alike[i] * lit[sheet.surfel[i]];
            weights += sheet.alike[i];
        }
        shares[s] = std::exp(std::min(sum / weights, kMostUneven));
    });
    return shares;
}

} // namespace

std::vector<float> findShade(const Surfels& surfels, const SurfelRadiance& radiance,
                             const HitLists& hits, std::span<const glm::vec3> irradiance)
{
    if (irradiance.empty()) return {};
    std::vector<Paint> paint = paintOf(radiance, irradiance);
    const Sheet sheet = sheetOf(surfels, paint);
    clearOfPatterns(surfels, hits, sheet, paint);
    return sharesOf(sheet, Settling(sheet, paint).run());
}

TexelShading withShade(const Texels& texels, TexelShading shade, std::span<const float> lit)
{
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

} // namespace relamp
