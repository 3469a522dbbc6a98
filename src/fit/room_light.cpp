#include "fit/room_light.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/task_arena.h>

namespace relamp
{
namespace
{

/// The room that gets most: `light` is of [room * count + column].
std::vector<uint32_t> brightestRooms(std::span<const double> light, size_t rooms, size_t count)
{
    std::vector<uint32_t> brightest(count, 0);
    for (size_t column = 0; column < count; ++column)
        for (uint32_t room = 1; room < rooms; ++room)
            if (light[room * count + column] > light[brightest[column] * count + column])
                brightest[column] = room;
    return brightest;
}

/// Which rooms the parts of a house's light are of.
struct Rooms
{
    size_t count = 1;
    std::vector<uint32_t> ofPlace;
    std::vector<uint32_t> ofPiece;
    std::vector<uint32_t> ofOutside;
};

Rooms roomsOfParts(const FittedLight& house, std::span<const uint8_t> roomOfPlace)
{
    const LightModel& model = house.model;
    Rooms rooms;
    if (!roomOfPlace.empty())
        rooms.count = 1u + *std::max_element(roomOfPlace.begin(), roomOfPlace.end());
    rooms.ofPlace.assign(roomOfPlace.begin(), roomOfPlace.end());
    std::vector<double> byPiece(rooms.count * model.pieces, 0.0);
    std::vector<double> byOutside(rooms.count * model.outsides, 0.0);
    for (size_t i = 0; i < rooms.ofPlace.size(); ++i) {
        for (const auto [f, direct] : model.direct[i])
            byPiece[rooms.ofPlace[i] * model.pieces + f] += static_cast<double>(direct);
        for (const auto [part, missed] : model.missed[i])
            byOutside[rooms.ofPlace[i] * model.outsides + part] += static_cast<double>(missed);
    }
    rooms.ofPiece = brightestRooms(byPiece, rooms.count, model.pieces);
    rooms.ofOutside = brightestRooms(byOutside, rooms.count, model.outsides);
    rooms.ofPlace.resize(model.places(), rooms.ofPiece.empty() ? 0 : rooms.ofPiece.back());
    return rooms;
}

/// The numbers of those that are of `room`.
std::vector<uint32_t> numbersOf(std::span<const uint32_t> rooms, uint32_t room)
{
    std::vector<uint32_t> numbers;
    for (uint32_t i = 0; i < rooms.size(); ++i)
        if (rooms[i] == room) numbers.push_back(i);
    return numbers;
}

/// Parts of what lies outside that are the room's own or that its places see anything of, and the
/// first, ascending.
std::vector<uint32_t> partsSeen(const LightModel& model, const Rooms& rooms, uint32_t number,
                                const RoomParts& room)
{
    std::vector<uint32_t> isSeen(model.outsides, rooms.count == 1 ? 1 : 0);
    isSeen[0] = 1;
    const auto look = [&](size_t place) {
        for (const MissedLight missed : model.missed[place]) isSeen[missed.part] = 1;
    };
    for (const uint32_t place : room.places) look(place);
    for (const uint32_t f : room.pieces) look(model.placeOf(f));
    for (uint32_t part = 0; part < isSeen.size(); ++part)
        if (rooms.ofOutside[part] == number) isSeen[part] = 1;
    return numbersOf(isSeen, 1);
}

RoomParts partsOf(const FittedLight& house, const Rooms& rooms, uint32_t number)
{
    RoomParts room{.places = numbersOf(rooms.ofPlace, number),
                   .pieces = numbersOf(rooms.ofPiece, number),
                   .outsides = house.model.outsides};
    room.parts = partsSeen(house.model, rooms, number, room);
    for (const uint32_t part : room.parts)
        room.isOwnPart.push_back(rooms.ofOutside[part] == number ? 1 : 0);
    return room;
}

template<class Value>
std::vector<Value> picked(const std::vector<Value>& all, std::span<const uint32_t> numbers)
{
    std::vector<Value> some;
    for (const uint32_t number : numbers)
        if (number < all.size()) some.push_back(all[number]);
    return some;
}

// Numerics.
constexpr uint32_t kOfAnother = ~0u; // room's place, piece or part

/// Where each of `numbers` is among them; others are another's.
std::vector<uint32_t> backFrom(std::span<const uint32_t> numbers, size_t count)
{
    std::vector<uint32_t> back(count, kOfAnother);
    for (uint32_t i = 0; i < numbers.size(); ++i) back[numbers[i]] = i;
    return back;
}

/// A room's own numbers for those of the house.
struct OwnNumbers
{
    std::vector<uint32_t> ofPlace;
    std::vector<uint32_t> ofPiece;
    std::vector<uint32_t> ofPart;

    OwnNumbers(const RoomParts& room, const LightModel& house)
        : ofPlace(backFrom(room.places, house.places())),
          ofPiece(backFrom(room.pieces, house.pieces)), ofPart(backFrom(room.parts, house.outsides))
    {}
};

/// Those of which both are the room's, by its own numbers.
std::vector<MaterialPair> ownPairs(std::span<const MaterialPair> pairs,
                                   std::span<const uint32_t> ofPlace)
{
    std::vector<MaterialPair> own;
    for (const auto& [p, q] : pairs)
        if (ofPlace[p] != kOfAnother && ofPlace[q] != kOfAnother)
            own.push_back({ofPlace[p], ofPlace[q]});
    return own;
}

/// A place of the house, or the place of a piece, as one of the room. `sent`: what the house's
/// pieces send.
void addPlace(const LightModel& house, size_t place, const OwnNumbers& numbers,
              std::span<const double> sent, LightModel& model)
{
    std::vector<DirectLight>& own = model.direct.emplace_back();
    double elsewhere = 0.0; // by pieces that are not the room's
    for (const auto [f, direct] : house.direct[place])
        if (numbers.ofPiece[f] != kOfAnother)
            own.push_back({numbers.ofPiece[f], direct});
        else
            elsewhere += sent[f] * static_cast<double>(direct);
    model.shown.push_back(house.shown[place]);
    model.gathered.push_back(house.gathered[place] + glm::vec3(static_cast<float>(elsewhere)));
    std::vector<MissedLight>& missed = model.missed.emplace_back();
    for (const auto [part, irradiance] : house.missed[place])
        if (numbers.ofPart[part] != kOfAnother)
            missed.push_back({numbers.ofPart[part], irradiance});
}

LightModel modelOf(const FittedLight& house, const RoomParts& room, const OwnNumbers& numbers)
{
    const LightModel& whole = house.model;
    const auto share =
        static_cast<double>(room.places.size()) / static_cast<double>(whole.places());
    const auto ofOtherRooms = std::ranges::count_if(
        room.parts, [&](uint32_t part) { return part > 0 && whole.areSmallHoles(part); });
    LightModel model{.pieces = room.pieces.size(),
                     .outsides = room.parts.size(),
                     .roomsOfHoles = 1 + static_cast<size_t>(ofOtherRooms),
                     .area = picked(whole.area, room.pieces),
                     .coloured = picked(whole.coloured, room.pieces),
                     .fades = picked(whole.fades, room.pieces),
                     .rooms = std::max(1.0, share * whole.rooms),
                     .isBurntOut = picked(whole.isBurntOut, room.places)};
    std::vector<double> sent;
    for (size_t f = 0; f < whole.pieces; ++f) sent.push_back(std::exp(house.log[f]));
    for (const uint32_t place : room.places) addPlace(whole, place, numbers, sent, model);
    for (const uint32_t f : room.pieces) addPlace(whole, whole.placeOf(f), numbers, sent, model);
    return model;
}

} // namespace

void RoomParts::put(std::span<const double> ofRoom, std::vector<double>& ofHouse) const
{
    for (size_t f = 0; f < pieces.size(); ++f) ofHouse[pieces[f]] = ofRoom[f];
    const size_t first = ofHouse.size() - outsides;
    for (size_t k = 0; k < parts.size(); ++k)
        if (isOwnPart[k] != 0) ofHouse[first + parts[k]] = ofRoom[pieces.size() + k];
}

LightFit RoomLight::fit(int channel) const
{
    LightFit fit(model, pairs, alike, noise, channel);
    fit.believe(told);
    return fit;
}

FittedLight RoomLight::alone(const CameraModel& camera, bool isResponseKnown) const
{
    return {model, pairs, alike, noise, emits, log, camera, texturePlaces(), told, isResponseKnown};
}

std::vector<double> RoomLight::shares() const
{
    std::vector<double> radiance;
    for (const double l : log) radiance.push_back(std::exp(l));
    std::vector<double> light;
    for (const glm::vec3 gathered : model.gathered)
        light.push_back(static_cast<double>(std::max(luminance(gathered), kFaintest)));
    PackedLight(model).add(radiance, 0, light);
    std::vector<double> shares(model.pieces, 0.0);
    for (size_t i = 0; i < model.places(); ++i)
        for (const auto [f, direct] : model.direct[i])
            shares[f] += static_cast<double>(direct) * radiance[f] / light[i];
    for (double& share : shares) share /= static_cast<double>(std::max<size_t>(model.places(), 1));
    return shares;
}

HouseLight::HouseLight(const FittedLight& house, std::span<const uint8_t> roomOfPlace,
                       std::span<const double> noise)
    : house_(house), noise_(noise)
{
    const Rooms rooms = roomsOfParts(house, roomOfPlace);
    rooms_.resize(rooms.count);
    forEach(rooms.count,
            [&](size_t r) { rooms_[r] = partsOf(house, rooms, static_cast<uint32_t>(r)); });
    for (const auto& [p, q] : house.pairs)
        if (rooms.ofPlace[p] == rooms.ofPlace[q]) ++rooms_[rooms.ofPlace[p]].pairs;
}

RoomLight HouseLight::lightOf(size_t room) const
{
    const RoomParts& parts = rooms_[room];
    const OwnNumbers numbers(parts, house_.model);
    RoomLight light{.of = parts,
                    .model = modelOf(house_, parts, numbers),
                    .pairs = ownPairs(house_.pairs, numbers.ofPlace),
                    .told = ownPairs(house_.told, numbers.ofPlace),
                    .noise = noise_.empty() ? house_.noise : noise_[room]};
    for (const auto& [a, b] : house_.alike)
        if (numbers.ofPiece[a] != kOfAnother && numbers.ofPiece[b] != kOfAnother)
            light.alike.push_back({numbers.ofPiece[a], numbers.ofPiece[b]});
    for (const uint32_t f : parts.pieces) {
        light.emits.push_back(house_.emits[f]);
        light.log.push_back(house_.log[f]);
    }
    for (const uint32_t part : parts.parts)
        light.log.push_back(house_.log[house_.model.pieces + part]);
    for (const uint32_t i : parts.places) {
        if (i >= house_.texture.position.size()) break;
        light.texture.push_back(house_.texture.texture[i]);
        light.position.push_back(house_.texture.position[i]);
    }
    return light;
}

void HouseLight::forEachRoom(
    const std::function<void(size_t room, const RoomLight& light)>& visit) const
{
    // A thread that waits for others within a room begins none meanwhile: it would hold both.
    forEach(rooms_.size(),
            [&](size_t r) { tbb::this_task_arena::isolate([&] { visit(r, lightOf(r)); }); });
}

std::vector<LightEstimate> HouseLight::estimatesOf(
    const std::function<LightEstimate(const RoomLight& light)>& estimateOf) const
{
    std::vector<LightEstimate> estimates(rooms_.size());
    forEachRoom([&](size_t r, const RoomLight& light) { estimates[r] = estimateOf(light); });
    return estimates;
}

LightEstimate HouseLight::joined(std::span<const LightEstimate> estimates) const
{
    const size_t count = house_.model.pieces + house_.model.outsides;
    LightEstimate house{.log = std::vector<double>(count), .error = std::vector<double>(count)};
    double pairs = 0.0;
    for (size_t r = 0; r < rooms_.size(); ++r) {
        rooms_[r].put(estimates[r].log, house.log);
        rooms_[r].put(estimates[r].error, house.error);
        house.nats += estimates[r].nats;
        const auto own = static_cast<double>(rooms_[r].pairs);
        pairs += own;
        if (own > 0.0) house.residual += own / pairs * (estimates[r].residual - house.residual);
    }
    return house;
}

} // namespace relamp
