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

/// A room of a house: its places, and the pieces that light these more than those of any other
/// room. Numbers are the house's.
struct RoomParts
{
    std::vector<uint32_t> places;
    std::vector<uint32_t> pieces;
    std::vector<uint32_t> parts;    // of what lies outside: those that it sees
    std::vector<uint8_t> isOwnPart; // of these: no other room sees more of it
    size_t pairs = 0;               // with both places here
    size_t outsides = 1;            // parts of the house

    /// Takes what is the room's from its own logs or errors over to those of the house.
    void put(std::span<const double> ofRoom, std::vector<double>& ofHouse) const;
};

/// The part of a fitted light that such a room is. What pieces of other rooms send here is light
/// that is gathered. Numbers of places, pieces and parts of what lies outside are the room's own.
struct RoomLight
{
    const RoomParts& of; // in the house
    LightModel model;
    std::vector<MaterialPair> pairs;
    std::vector<MaterialPair> told; // with both places here
    std::vector<AlikePieces> alike;
    std::vector<uint8_t> emits;
    std::vector<double> log;         // as LightEstimate has it
    double noise = 0.0;              // as FittedLight has it
    std::vector<glm::vec3> texture;  // of places
    std::vector<glm::vec3> position; // likewise

    [[nodiscard]] TexturePlaces texturePlaces() const { return {texture, position}; }
    /// By luminance or one channel. The room must outlive it.
    [[nodiscard]] LightFit fit(int channel = -1) const;
    /// The room by itself, with its own camera.
    [[nodiscard]] FittedLight alone(const CameraModel& camera, bool isResponseKnown) const;
    /// Of each piece: what part of the light comes from it, in the mean of places.
    [[nodiscard]] std::vector<double> shares() const;
};

/// A fitted light as that of rooms. The light of one is made for who asks and goes with them: all
/// of them at once are as large as the house. Once what it was made of changes, only rooms() are
/// left of it.
class HouseLight
{
public:
    /// `roomOfPlace`: from 0 on, of the places that have a texture; empty: there is one room. A
    /// sun's rim is of the room that the last piece lights most. `noise`: of rooms, in place of the
    /// house's; empty: that. What `house` refers to must outlive this.
    HouseLight(const FittedLight& house, std::span<const uint8_t> roomOfPlace,
               std::span<const double> noise = {});

    [[nodiscard]] std::span<const RoomParts> rooms() const { return rooms_; }
    [[nodiscard]] RoomLight lightOf(size_t room) const;
    /// Calls `visit(room, light)` for all, on all threads.
    void forEachRoom(const std::function<void(size_t room, const RoomLight& light)>& visit) const;
    /// What `estimateOf` says of every room.
    [[nodiscard]] std::vector<LightEstimate>
    estimatesOf(const std::function<LightEstimate(const RoomLight& light)>& estimateOf) const;
    /// All rooms' estimates, without a camera's, as one of the house; its residual is the mean by
    /// pairs.
    [[nodiscard]] LightEstimate joined(std::span<const LightEstimate> estimates) const;

private:
    FittedLight house_;
    std::span<const double> noise_; // of rooms
    std::vector<RoomParts> rooms_;
};

} // namespace relamp
