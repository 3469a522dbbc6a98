#pragma once

#include "fit/fitted_light.h"
#include "fit/light_fit.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// The part of a fitted light that one room of a house is: its places, and the pieces that light
/// these more than those of any other room. What pieces of other rooms send here is light that is
/// gathered. Numbers of places, pieces and parts of what lies outside are the room's own.
struct RoomLight
{
    LightModel model;
    std::vector<MaterialPair> pairs; // with both places here
    std::vector<MaterialPair> told;  // likewise
    std::vector<AlikePieces> alike;
    std::vector<uint8_t> emits;
    std::vector<double> log;         // as LightEstimate has it
    double noise = 0.0;              // as FittedLight has it
    std::vector<glm::vec3> texture;  // of places
    std::vector<glm::vec3> position; // likewise
    std::vector<uint32_t> places;    // the house's numbers of its places
    std::vector<uint32_t> pieces;    // likewise
    std::vector<uint32_t> parts;     // likewise, of what lies outside: those that it sees
    std::vector<uint8_t> isOwnPart;  // of these: no other room sees more of it
    size_t outsides = 1;             // parts of the house

    [[nodiscard]] TexturePlaces texturePlaces() const { return {texture, position}; }
    /// By luminance or one channel. The room must outlive it.
    [[nodiscard]] LightFit fit(int channel = -1) const;
    /// The room by itself, with its own camera.
    [[nodiscard]] FittedLight alone(const CameraModel& camera, bool isResponseKnown) const;
    /// Of each piece: what part of the light comes from it, in the mean of places.
    [[nodiscard]] std::vector<double> shares() const;
    /// Takes what is the room's from its own logs or errors over to those of the house.
    void put(std::span<const double> ofRoom, std::vector<double>& ofHouse) const;
};

/// One of each room. `roomOfPlace`: from 0 on, of the places that have a texture; empty: there is
/// one room. A sun's rim is of the room that the last piece lights most.
std::vector<RoomLight> lightOfRooms(const FittedLight& house, std::span<const uint8_t> roomOfPlace);

/// What `estimateOf` says of every room, all at once.
std::vector<LightEstimate>
estimatesOf(std::span<const RoomLight> rooms,
            const std::function<LightEstimate(const RoomLight& room)>& estimateOf);
/// All rooms' estimates, without a camera's, as one of the house; its residual is the mean by
/// pairs.
LightEstimate joined(std::span<const RoomLight> rooms, std::span<const LightEstimate> estimates);

} // namespace relamp
