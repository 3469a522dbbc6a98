#include "fit/room_light.h"

#include "fit/light_fit_test.h"

#include <array>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using testing::ElementsAre;

constexpr uint8_t kFar = 1; // the second room

/// Two floors side by side, each with a lamp, and a gap through which the first one's lights a
/// corner of the second.
struct House
{
    LightModel model{.pieces = 2};
    std::vector<MaterialPair> pairs;
    std::vector<AlikePieces> alike{{0, 1}};
    std::vector<uint8_t> emits{1, 1};
    std::vector<double> log{std::log(30.0), std::log(50.0), -1.0};
    std::vector<glm::vec3> texture;
    std::vector<glm::vec3> position;
    std::vector<uint8_t> roomOfPlace;
    CameraModel camera;

    static constexpr size_t kPlaces = 400; // of each

    House()
    {
        Numbers numbers;
        for (size_t i = 0; i < 2 * kPlaces; ++i) {
            const uint8_t room = i % 2 == 0 ? 0 : kFar;
            const float x = numbers.between(0.0f, 4.0f);
            const float own = 0.2f / (1.0f + x * x);
            const float through = room == kFar && x < 0.5f ? 0.05f : 0.0f;
            roomOfPlace.push_back(room);
            position.emplace_back(x + (room == kFar ? 5.0f : 0.0f), 0.0f, 0.0f);
            const float ofFirst = room == 0 ? own : through;
            const float ofSecond = room == 0 ? 0.0f : own;
            model.direct.push_back({{0, ofFirst}, {1, ofSecond}});
            model.gathered.emplace_back(0.4f);
            const float missed = room == 0 ? 0.2f : 0.1f;
            model.missed.push_back({{0, missed}});
            const float light =
                0.4f + std::exp(-1.0f) * missed + 30.0f * ofFirst + 50.0f * ofSecond;
            model.shown.emplace_back(0.5f / kPi * light);
        }
        texture = model.shown;
        addPieces(model);
        for (uint32_t i = 0; i + 2 < 2 * kPlaces; ++i) pairs.push_back({i, i + 2});
        pairs.push_back({0, 1}); // of two rooms
    }

    [[nodiscard]] FittedLight asFitted() const
    {
        return {model, pairs, alike, kPairNoise, emits, log, camera, {texture, position},
                {},    false};
    }
};

} // namespace

TEST(RoomLight, OfOneRoomIsThatOfAll)
{
    const House house;
    const HouseLight light(house.asFitted(), {});
    ASSERT_EQ(light.rooms().size(), 1u);
    const RoomLight room = light.lightOf(0);
    EXPECT_EQ(room.model.direct, house.model.direct);
    EXPECT_EQ(room.model.gathered, house.model.gathered);
    EXPECT_EQ(room.model.missed, house.model.missed);
    EXPECT_EQ(room.model.shown, house.model.shown);
    EXPECT_EQ(room.log, house.log);
    EXPECT_EQ(room.pairs.size(), house.pairs.size());
    EXPECT_EQ(room.of.pairs, house.pairs.size());
    EXPECT_EQ(room.position, house.position);
}

TEST(RoomLight, WhatOtherRoomsSendIsGathered)
{
    const House house;
    const std::array noise{0.1, 0.2};
    const HouseLight light(house.asFitted(), house.roomOfPlace, noise);
    ASSERT_EQ(light.rooms().size(), 2u);
    EXPECT_THAT(light.rooms()[0].pieces, ElementsAre(0u));
    EXPECT_THAT(light.rooms()[1].pieces, ElementsAre(1u));
    EXPECT_THAT(light.rooms()[0].isOwnPart, ElementsAre(1));
    EXPECT_THAT(light.rooms()[1].isOwnPart, ElementsAre(0));
    light.forEachRoom([&](size_t r, const RoomLight& room) {
        EXPECT_EQ(room.noise, noise[r]);
        EXPECT_EQ(room.model.places(), House::kPlaces);
        EXPECT_TRUE(room.alike.empty()); // with a lamp of the other
        EXPECT_EQ(room.pairs.size(), House::kPlaces - 1);
        EXPECT_EQ(room.of.pairs, room.pairs.size());
        for (size_t i = 0; i < room.of.places.size(); ++i) {
            const size_t place = room.of.places[i];
            const float sent =
                std::exp(static_cast<float>(room.log[0])) * room.model.directAt(i, 0);
            const float all = 0.4f + 30.0f * house.model.directAt(place, 0) +
                              50.0f * house.model.directAt(place, 1);
            EXPECT_NEAR(room.model.gathered[i].g + sent, all, 1e-4f);
            EXPECT_EQ(room.position[i], house.position[place]);
        }
    });
}

// Each room finds its lamp by itself, from a wrong start, and the house has both.
TEST(RoomLight, RoomsTogetherAreTheHouse)
{
    House house;
    house.log[0] -= 0.5;
    house.log[1] += 0.5;
    for (int round = 0; round < 2; ++round) { // the second sees what the first one sends in truth
        const HouseLight light(house.asFitted(), house.roomOfPlace);
        const LightEstimate joint = light.joined(light.estimatesOf(
            [](const RoomLight& room) { return room.fit().solve(room.emits, room.log, 1.0); }));
        ASSERT_EQ(joint.log.size(), house.log.size());
        EXPECT_GT(joint.error[1], 0.0);
        house.log = joint.log;
    }
    const House whole;
    const LightEstimate all = LightFit(whole.model, whole.pairs, whole.alike, kPairNoise)
                                  .solve(whole.emits, whole.log, 1.0);
    for (size_t f = 0; f < 2; ++f) EXPECT_NEAR(house.log[f], all.log[f], 0.05);
}

TEST(RoomLight, SharesAreOfAllLightThatPlacesGet)
{
    const House house;
    const HouseLight light(house.asFitted(), {});
    ASSERT_EQ(light.rooms().size(), 1u);
    double expected = 0.0;
    for (size_t i = 0; i < 2 * House::kPlaces; ++i) {
        const float own = 30.0f * house.model.directAt(i, 0);
        expected += static_cast<double>(own / (kPi / 0.5f * house.texture[i].g));
    }
    const std::vector<double> shares = light.lightOf(0).shares();
    ASSERT_EQ(shares.size(), 2u);
    EXPECT_NEAR(shares[0], expected / (2.0 * House::kPlaces), 1e-4);
    EXPECT_GT(shares[1], shares[0]); // 50 for 30
    EXPECT_LT(shares[0] + shares[1], 1.0);
}

} // namespace relamp
