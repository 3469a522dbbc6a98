#include "fit/sun_trial.h"

#include "base/radiometry.shared.h"
#include "fit/light_fit.h"
#include "image/burnt_out.shared.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relamp
{
namespace
{

constexpr float kMostly = 0.8f; // of a burnt-out piece that the sun reaches: it is a patch of it

/// Light at the front of a surfel, in the mean of its neighbours: its own few rays are noise.
class LightAt
{
public:
    LightAt(const Surfels& surfels, uint32_t surfel) : around_(surfels.neighborsOf(surfel)) {}

    template<class T, class Of>
    [[nodiscard]] T mean(const Of& of) const
    {
        T sum{0.0f};
        for (const uint32_t n : around_) sum += of(n);
        return sum / static_cast<float>(around_.size());
    }

private:
    std::span<const uint32_t> around_;
};

} // namespace

std::vector<glm::vec3> shownOf(const SurfelRadiance& radiance)
{
    std::vector<glm::vec3> shown = radiance.plain;
    for (const ClippedPatch& patch : radiance.clipped)
        if (isMostlyBurntOut(radiance, patch.surfel)) shown[patch.surfel] = patch.radiance;
    return shown;
}

SunTrial::SunTrial(const Texels& texels, const SurfelRadiance& radiance, const LightSoFar& light,
                   glm::vec3 direction, std::vector<AreaSample> seen)
    : towards(direction), onSides(std::move(seen)), rim(texels, radiance, onSides)
{
    addRows(radiance, texels.surfels, light);
    setChannel(without, -1);
    findPatches(light);
    with = without;
    for (const SunPatch& patch : patches) {
        with.area[patch.piece] = 0.0f;
        for (size_t i = 0; i < with.shown.size(); ++i)
            with.direct[i * with.pieces + patch.piece] = 0.0f;
    }
    setChannel(with, -1);
}

/// Rows of the rim come behind the places, a column and a row for the sun come last.
void SunTrial::addRows(const SurfelRadiance& radiance, const Surfels& surfels,
                       const LightSoFar& light)
{
    const LightModel& before = light.model;
    LightModel& model = without;
    model.pieces = before.pieces + 1;
    model.area = before.area;
    model.area.push_back(0.0f);
    const auto addRow = [&](glm::vec3 shown, glm::vec3 gathered, float missed, float ofSun) {
        model.shown.push_back(shown);
        model.gathered.push_back(gathered);
        model.missed.push_back(missed);
        model.direct.resize(model.shown.size() * model.pieces, 0.0f);
        model.direct.back() = ofSun;
        straight_.push_back(ofSun);
        return std::span(model.direct).last(model.pieces);
    };
    const auto copyRow = [&](size_t i, float ofSun) {
        const std::span<float> row =
            addRow(before.shown[i], before.gathered[i], before.missed[i], ofSun);
        std::copy_n(before.directAt(i).begin(), before.pieces, row.begin());
    };
    for (size_t i = 0; i < before.places(); ++i) copyRow(i, onSides[light.places[i]].visible);
    firstOfRim_ = before.places();
    const std::vector<glm::vec3> shown = shownOf(radiance);
    for (const uint32_t s : rim.surfels()) {
        const LightAt at(surfels, s);
        const std::span<float> row = addRow(
            shown[s],
            at.mean<glm::vec3>([&](uint32_t n) { return light.sides.gathered.irradiance[n]; }),
            at.mean<float>([&](uint32_t n) { return light.sides.gathered.missed[n]; }),
            onSides[s].visible);
        for (size_t f = 0; f < before.pieces; ++f)
            if (light.emits[f] != 0)
                row[f] =
                    at.mean<float>([&](uint32_t n) { return light.pieces[f].onSides[n].visible; });
    }
    for (size_t f = 0; f < before.pieces; ++f) {
        float lit = 0.0f;
        for (const ClippedPatch& patch : light.pieces[f].candidate.patches)
            if (patch.surfel != Surfels::kNone) lit += patch.area * onSides[patch.surfel].visible;
        copyRow(before.placeOf(f), lit / std::max(light.pieces[f].candidate.area, 1e-9f));
    }
    addRow(glm::vec3(0.0f), glm::vec3(0.0f), 0.0f, 0.0f);
}

void SunTrial::findPatches(const LightSoFar& light)
{
    const std::vector<MaterialPair> across = rim.all();
    const auto paintBeside = [&](const std::vector<uint8_t>& isOfPiece) {
        glm::vec3 sum(0.0f);
        float count = 0.0f;
        for (const MaterialPair pair : across) {
            if (!isOfPiece.empty() && isOfPiece[pair.p] == 0) continue;
            sum += light.sides.albedo[pair.q];
            count += 1.0f;
        }
        return std::pair(sum / std::max(count, 1.0f), count > 0.0f);
    };
    const glm::vec3 anywhere = paintBeside({}).first;
    for (size_t f = 0; f < light.pieces.size(); ++f) {
        std::vector<uint8_t> isOfPiece(light.sides.albedo.size(), 0);
        float lit = 0.0f;
        for (const ClippedPatch& patch : light.pieces[f].candidate.patches) {
            if (patch.surfel == Surfels::kNone) continue;
            isOfPiece[patch.surfel] = 1;
            const AreaSample& sample = onSides[patch.surfel];
            if (sample.open > 0.0f) lit += patch.area * sample.visible / sample.open;
        }
        if (lit < kMostly * light.pieces[f].candidate.area) continue;
        const auto [paint, isKnown] = paintBeside(isOfPiece);
        patches.push_back({f, (isKnown ? paint : anywhere) / kPi * straight_[without.placeOf(f)]});
    }
}

/// Where one channel alone is burnt out, the others are as seen, and so is most of the luminance.
void SunTrial::setChannel(LightModel& model, int channel) const
{
    const auto pick = [&](glm::vec3 rgb) { return channel < 0 ? luminance(rgb) : rgb[channel]; };
    model.isBurntOut.assign(model.places(), 0);
    for (size_t i = firstOfRim_; i < model.places(); ++i)
        model.isBurntOut[i] = pick(model.shown[i]) >= kSafelyBelow ? 1 : 0;
    for (size_t i = 0; i < model.shown.size(); ++i) {
        float& ofSun = model.direct[i * model.pieces + sun()];
        ofSun = straight_[i];
        for (const SunPatch& patch : patches)
            ofSun += pick(patch.perRadiance) * without.directAt(i)[patch.piece];
    }
}

std::vector<MaterialPair> SunTrial::pairs(size_t drawn) const
{
    const double perCell = static_cast<double>(drawn) / LightFit::effectivePairs();
    return rim.pairs(static_cast<size_t>(std::ceil(perCell)), static_cast<uint32_t>(firstOfRim_));
}

LightModel SunTrial::channelOf(int channel) const
{
    LightModel model = with;
    setChannel(model, channel);
    return model;
}

} // namespace relamp
