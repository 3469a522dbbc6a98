#pragma once

// Scenes of the tests of LightFit.

#include "base/radiometry.shared.h"
#include "fit/light_fit.h"

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace relamp
{

inline constexpr double kPairNoise = 0.08; // log: between places of one paint
inline constexpr double kWide = 6.0;       // times the noise: from far off

/// Numbers that are the same on every machine; distributions of the standard need not be.
class Numbers
{
public:
    float between(float low, float high)
    {
        return low + (high - low) * static_cast<float>(random_() >> 8) / 16777216.0f;
    }
    /// Of mean 0 and variance 1, about.
    float normal()
    {
        float sum = -6.0f;
        for (int i = 0; i < 12; ++i) sum += between(0.0f, 1.0f);
        return sum;
    }

private:
    std::mt19937 random_{7};
};

/// Behind the places of a model, those of pieces that nothing is known of.
inline void addPieces(LightModel& model)
{
    model.shown.insert(model.shown.end(), model.pieces, glm::vec3(1.0f));
    model.gathered.insert(model.gathered.end(), model.pieces, glm::vec3(0.0f));
    model.missed.resize(model.shown.size());
    model.direct.resize(model.shown.size());
    model.area.assign(model.pieces, 0.0f);
}

/// A floor of two materials under lamps, with what every lamp does there known. A lamp that is
/// black is a wall: it lights nothing.
struct Floor
{
    static constexpr size_t kPlaces = 800;

    LightModel model;
    std::vector<MaterialPair> pairs;
    std::vector<AlikePieces> alike;
    std::vector<glm::vec3> truth; // of pieces
    glm::vec3 outside{0.5f, 0.4f, 0.3f};

    /// `noise` of radiance, as a share; `outliers` share of the pairs across materials.
    Floor(std::vector<glm::vec3> lamps, float noise, float outliers);

    [[nodiscard]] LightFit fit(int channel = -1) const
    {
        return {model, pairs, alike, kPairNoise, channel};
    }
    /// All but walls emit.
    [[nodiscard]] std::vector<uint8_t> emits() const
    {
        std::vector<uint8_t> flags;
        for (const glm::vec3 lamp : truth) flags.push_back(lamp.g > 0.0f ? 1 : 0);
        return flags;
    }
    [[nodiscard]] LightEstimate solve(int channel = -1) const
    {
        const LightFit light = fit(channel);
        return light.solve(emits(), light.beginning(), kWide);
    }
    /// From 20 times white, where lamps are, be they seen or not.
    [[nodiscard]] LightEstimate solveFromLamps() const
    {
        return fit().solve(emits(), std::vector(truth.size() + 1, std::log(20.0)), kWide);
    }
    [[nodiscard]] double truthOf(size_t lamp) const
    {
        return std::log(static_cast<double>(luminance(truth[lamp])));
    }
    /// What a place gets from surfaces and from outside.
    [[nodiscard]] glm::vec3 restAt(size_t place) const
    {
        glm::vec3 rest = model.gathered[place];
        for (const auto [part, irradiance] : model.missed[place]) rest += outside * irradiance;
        return rest;
    }
    /// Takes a lamp out of the room.
    void darken(size_t lamp);
    /// A burnt-out piece of wall that gets this irradiance of a lamp at radiance 1.
    void burnOut(size_t wall, size_t lamp, float direct, float area = 0.1f);
};

inline Floor::Floor(std::vector<glm::vec3> lamps, float noise, float outliers)
    : truth(std::move(lamps))
{
    Numbers random;
    model.pieces = truth.size();
    std::vector<glm::vec2> under; // in braces numbers are drawn from left to right, by any compiler
    for (size_t f = 0; f < truth.size(); ++f)
        under.push_back({random.between(1, 4), random.between(1, 4)});
    for (size_t i = 0; i < kPlaces; ++i) {
        const glm::vec2 place{random.between(0, 5), random.between(0, 5)};
        glm::vec3 irradiance(random.between(0.2f, 0.5f));
        model.gathered.push_back(irradiance);
        const float missed = place.x < 2.0f ? random.between(0.0f, 0.4f) : 0.0f;
        model.missed.push_back({{0, missed}});
        irradiance += outside * missed;
        std::vector<DirectLight>& ofPlace = model.direct.emplace_back();
        for (uint32_t f = 0; f < truth.size(); ++f) {
            const float squared = 4.0f + glm::dot(place - under[f], place - under[f]);
            const bool isShadow = truth[f].g <= 0.0f || random.between(0, 1) < 0.3f;
            if (isShadow) continue;
            ofPlace.push_back({f, 0.1f * 4.0f / (squared * squared)});
            irradiance += truth[f] * ofPlace.back().irradiance;
        }
        const float albedo = (i % 2 == 0 ? 0.5f : 0.25f) * std::exp(noise * random.normal());
        model.shown.push_back(albedo * irradiance / kPi);
    }
    for (size_t i = 0; i < 8 * kPlaces; ++i) {
        const auto p = static_cast<uint32_t>(random.between(0, kPlaces - 1));
        const auto q = static_cast<uint32_t>(random.between(0, kPlaces - 1));
        const bool isOneMaterial = p % 2 == q % 2;
        if (p != q && (isOneMaterial || random.between(0, 1) < outliers)) pairs.push_back({p, q});
    }
    addPieces(model);
}

inline void Floor::darken(size_t lamp)
{
    for (size_t i = 0; i < model.places(); ++i) {
        glm::vec3 irradiance = restAt(i);
        for (const auto [f, direct] : model.direct[i]) irradiance += truth[f] * direct;
        model.shown[i] *= (irradiance - truth[lamp] * model.directAt(i, lamp)) / irradiance;
        std::erase_if(model.direct[i], [&](DirectLight light) { return light.piece == lamp; });
    }
}

inline void Floor::burnOut(size_t wall, size_t lamp, float direct, float area)
{
    const size_t place = model.placeOf(wall);
    model.area[wall] = area;
    model.gathered[place] = glm::vec3(0.2f);
    model.direct[place] = {{static_cast<uint32_t>(lamp), direct}};
}

} // namespace relamp
