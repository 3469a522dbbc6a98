#pragma once

#include "fit/powers.h"
#include "lights/candidates.h"
#include "shading/area_direct.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// A piece of surface that is thought to be a lamp, with what it does at all places at radiance 1.
struct Suspect
{
    Candidate candidate;
    std::vector<float> direct; // irradiance at radiance 1, one a place
    glm::vec3 radiance{1.0f};
    glm::vec3 logError{0.0f};
    std::vector<AreaSample> onSides; // at radiance 1, one a hit list
    bool isGiven = false;            // a person says that it shines
    size_t body = 0;                 // of the same number: two sides of one lamp
    bool isUnseen = false;           // its far side, not scanned
    float told = 1.0f;               // see Powers
    float share = 0.0f;              // of the light at places, mean, 0..1
    std::vector<uint32_t> ends{};    // see LampGroup; empty: it is one lamp

    [[nodiscard]] float power() const; // luminance * m^2
    [[nodiscard]] size_t rays() const; // to it from an origin, at least 1
    [[nodiscard]] float reach() const; // share of the places that see it, 0..1
};

/// Pairs that look like one model of lamp, or are two sides of one: they have one radiance. Of
/// small ones a scan shows more or less; where they agree they have one power.
std::vector<AlikeLamps> alikesOf(const std::vector<Suspect>& suspects);

/// Suspect `f` and, if it is small or a whole body, those that look like its model and were found
/// to be about as powerful; itself alone where they are less than four, or two bodies: a few agree
/// by chance.
std::vector<uint32_t> familyOf(const std::vector<Suspect>& suspects, uint32_t f);

/// Whether two pieces touch in one plane and were found to be equally bright: panes of one window,
/// each of which does what the other does.
bool arePanesOfOne(const Suspect& a, const Suspect& b);

/// How much of the light that comes to measured places is whose: a radiance says little of what is
/// small or hidden. `data` has the suspects' light in their order.
void findShares(const FitData& data, glm::vec3 ambient, std::vector<Suspect>& suspects);

/// Leaves out the far side of what is no suspect any more; returns how many.
size_t dropHalves(std::vector<Suspect>& suspects);

/// Which suspects go where suspect `f` goes: its far side with it. One flag each.
std::vector<uint8_t> goneWith(const std::vector<Suspect>& suspects, size_t f);

/// Makes one suspect of pieces that touch and are about equally bright, of a lamp and a sliver
/// beside it, and of two sides.
void joinPieces(std::vector<Suspect>& suspects);

} // namespace relamp
