#pragma once

#include "base/radiometry.shared.h"
#include "fit/packed_rows.h"
#include "shading/gather.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// What a piece sends straight to a place: irradiance at radiance 1.
struct DirectLight
{
    uint32_t piece;
    float irradiance;

    bool operator==(const DirectLight&) const = default;
};

/// What is fixed of a room's light once rays are cast. At places of the scan, and on the pieces
/// themselves, the irradiance is
///     E = gathered + sum over parts of outside * missed + sum over pieces of radiance * direct.
/// Places that are measured come first; behind them comes one for each piece: the light on itself.
struct LightModel
{
    size_t pieces = 0;
    std::vector<glm::vec3> shown;    // radiance that the texture has there, > 0
    std::vector<glm::vec3> gathered; // irradiance by way of all surfaces that are no piece
    std::vector<std::vector<MissedLight>> missed; // of places, by ascending part
    size_t outsides = 1;                          // parts; the first are small holes
    size_t roomsOfHoles = 1; // of which small holes are a part by themselves; the others come last
    std::vector<std::vector<DirectLight>> direct; // of places, by ascending piece; of a house it
                                                  // is a place's own room that lights it
    std::vector<float> area;                      // of pieces, m^2; 0: nothing of it was seen
    std::vector<float> coloured;     // of pieces, share that some channel is not burnt out in: its
                                     // radiance is seen there; empty: none is
    std::vector<uint8_t> fades;      // of pieces, 1: as an overexposed wall does; empty: none does
    double rooms = 1.0;              // that its places are as much as, >= 1
    std::vector<uint8_t> isBurntOut; // of places that sent more than they show; empty: none did

    [[nodiscard]] size_t places() const { return shown.size() - pieces; } // that are measured
    [[nodiscard]] bool areSmallHoles(size_t part) const
    {
        return part == 0 || part + roomsOfHoles > outsides;
    }
    [[nodiscard]] size_t placeOf(size_t piece) const { return places() + piece; }
    [[nodiscard]] float directAt(size_t place, size_t piece) const
    {
        const auto found = std::ranges::lower_bound(direct[place], piece, {}, &DirectLight::piece);
        return found != direct[place].end() && found->piece == piece ? found->irradiance : 0.0f;
    }
};

/// The second and third sum of that E, for as many radiances as are asked for.
class PackedLight
{
public:
    explicit PackedLight(const LightModel& model);

    /// Pieces by where their light is, so that those of one room are together: columns of `rows`.
    /// The parts outside come behind.
    std::vector<uint32_t> order;
    PackedRows rows; // of places and pieces

    /// Adds them, in luminance or in one channel, to what places from `first` on gathered.
    /// `radiance`: of pieces, and then of parts of what lies outside; more is passed over.
    void add(std::span<const double> radiance, size_t first, std::span<double> irradiance) const;
};

/// What a camera may have done to what the places of a LightModel show, near what is known of it:
/// log radiance = log shown + sum over coefficients of (coefficient - known) * bend.
struct CameraColumns
{
    std::vector<double> known;     // coefficients that `shown` is for
    std::vector<double> expected;  // that are believed beforehand
    std::vector<float> bend;       // [place * count + coefficient]
    std::vector<float> slopeKnown; // of places: d log radiance / d log texture with `known`
    std::vector<float> slope;      // what the first coefficients do to that, and no others:
                                   // [place * slopes + coefficient]
    double worth = 1.0; // how many times as many pairs are independent once these are known
    std::vector<double> precision; // of that belief: count * count

    [[nodiscard]] size_t count() const { return known.size(); }
    [[nodiscard]] std::span<const float> bendAt(size_t place) const
    {
        return {bend.data() + place * count(), count()};
    }
    [[nodiscard]] size_t slopes() const
    {
        return slopeKnown.empty() ? 0 : slope.size() / slopeKnown.size();
    }
    [[nodiscard]] std::span<const float> slopeAt(size_t place) const
    {
        return {slope.data() + place * slopes(), slopes()};
    }
};

/// Two places that are likely of one material.
struct MaterialPair
{
    uint32_t p;
    uint32_t q;
};

/// Two pieces that look like one model of lamp, or are parts of one.
struct AlikePieces
{
    uint32_t a;
    uint32_t b;
};

} // namespace relamp
