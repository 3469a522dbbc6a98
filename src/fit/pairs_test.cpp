#include "fit/pairs.h"

#include "scenes/axes.h"
#include "scenes/scenes.h"

#include <numeric>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::kUp;

/// Places of a room, each a surfel of its own.
struct Places
{
    std::vector<glm::vec3> shown;
    Surfels surfels;

    void add(glm::vec3 position, glm::vec3 normal, glm::vec3 radiance)
    {
        surfels.position.push_back(position);
        surfels.normal.push_back(normal);
        shown.push_back(radiance);
    }

    [[nodiscard]] std::vector<MaterialPair> pairs(size_t perPlace) const
    {
        return pairsIn({}, perPlace);
    }
    [[nodiscard]] std::vector<MaterialPair> pairsIn(const Scan& around, size_t perPlace) const
    {
        return drawPairs(shown, all(), surfels, RayScene(around), perPlace);
    }
    /// What places show is their albedo here.
    [[nodiscard]] std::vector<MaterialPair> acrossWalls(size_t perPlace,
                                                        std::span<const uint8_t> rooms = {}) const
    {
        return drawAcrossWalls(shown, all(), surfels, perPlace, rooms);
    }
    [[nodiscard]] std::vector<uint32_t> all() const
    {
        std::vector<uint32_t> numbers(surfels.count());
        std::iota(numbers.begin(), numbers.end(), 0u);
        return numbers;
    }
};

/// A place on one of four walls of a room of 4 m, on its floor or its ceiling.
void addToRoom(Places& room, float x, size_t surface, glm::vec3 albedo)
{
    const glm::vec3 normal[] = {{1, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 0, -1}, kUp, scenes::kDown};
    const glm::vec3 position[] = {{0, 1, x}, {x, 1, 0}, {4, 1, x}, {x, 1, 4}, {x, 0, 2}, {x, 3, 2}};
    room.add(position[surface], normal[surface], albedo);
}

/// A row of places that differ in what `place(i)` adds.
template<class AddPlace>
Places hundred(const AddPlace& addPlace)
{
    Places places;
    for (int i = 0; i < 100; ++i) addPlace(places, static_cast<float>(i) * 0.04f, i);
    return places;
}

} // namespace

TEST(Pairs, AreOfOneRoomWhereRoomsAreKnown)
{
    const Places places = hundred([](Places& house, float x, int) {
        house.add({x, 0.0f, 1.0f}, kUp, glm::vec3(0.5f));
    });
    std::vector<uint8_t> rooms;
    for (const uint32_t i : places.all()) rooms.push_back(i % 10 == 0 ? 1 : 0);
    const auto pairs =
        drawPairs(places.shown, places.all(), places.surfels, RayScene(Scan{}), 2, rooms);
    EXPECT_EQ(pairs.size(), 2 * rooms.size()); // of the lesser room as well
    for (const auto [p, q] : pairs) EXPECT_EQ(rooms[p], rooms[q]);
}

TEST(Pairs, LieOnOnePlane)
{
    const Places places = hundred([](Places& room, float x, int i) {
        const float height = i % 3 == 0 ? 0.7f : 0.0f; // a table over a floor
        const glm::vec3 normal = i % 3 == 1 ? glm::vec3(1, 0, 0) : kUp;
        room.add({i % 3 == 1 ? 0.0f : x, height, 1.0f}, normal, glm::vec3(0.5f));
    });
    const auto pairs = places.pairs(8);
    EXPECT_GT(pairs.size(), 500u);
    for (const MaterialPair pair : pairs) EXPECT_EQ(pair.p % 3, pair.q % 3);
}

// The same hue in light and shadow may be one material; another hue is not, whatever the light.
TEST(Pairs, AreOfOneHueAtAnyBrightness)
{
    const Places places = hundred([](Places& room, float x, int i) {
        const glm::vec3 hue =
            i % 2 == 0 ? glm::vec3(0.6f, 0.5f, 0.4f) : glm::vec3(0.2f, 0.5f, 0.8f);
        room.add({x, 0.0f, 0.0f}, kUp, (i % 4 < 2 ? 1.0f : 0.05f) * hue);
    });
    bool acrossBrightness = false;
    for (const MaterialPair pair : places.pairs(8)) {
        EXPECT_EQ(pair.p % 2, pair.q % 2);
        acrossBrightness |= pair.p % 4 != pair.q % 4;
    }
    EXPECT_TRUE(acrossBrightness);
}

// Each room is painted by itself.
TEST(Pairs, LieInOneRoom)
{
    const Places places = hundred([](Places& room, float x, int) {
        room.add({x, 0.0f, 0.0f}, kUp, glm::vec3(0.5f));
    });
    const scenes::Panel wall{{1.99f, 0, -9}, {0, 0, 18}, {0, 9, 0}};
    const Scan house = scenes::panels(std::span(&wall, 1), 8, scenes::plain(glm::vec3(0.5f)));
    const std::vector<MaterialPair> drawn = places.pairsIn(house, 4);
    EXPECT_GT(drawn.size(), 390u);
    EXPECT_NEAR(roomsOf(places.surfels, RayScene(house)), 2.0, 0.2);
    EXPECT_EQ(roomsOf(places.surfels, RayScene(Scan{})), 1.0);
    for (const MaterialPair pair : drawn) EXPECT_EQ(pair.p < 50, pair.q < 50);
}

// Of fifty rooms with two places each, one pair in a hundred lies in one: a thousand are too few.
TEST(Pairs, ManyRoomsAreCounted)
{
    const Places places = hundred([](Places& row, float x, int) {
        row.add({x, 0.0f, 0.0f}, kUp, glm::vec3(0.5f));
    });
    std::vector<scenes::Panel> walls;
    for (float x = 0.06f; x < 4.0f; x += 0.08f)
        walls.push_back({{x, 0, -9}, {0, 0, 18}, {0, 9, 0}});
    const Scan building = scenes::panels(walls, 8, scenes::plain(glm::vec3(0.5f)));
    EXPECT_NEAR(roomsOf(places.surfels, RayScene(building)), 99.0, 40.0);
}

// Out of a window and in by another leads no way from room to room.
TEST(Pairs, RoomsAreCountedByTheirFloors)
{
    const scenes::Panel wall{{1.99f, -1, -0.5f}, {0, 0, 1}, {0, 4, 0}};
    const scenes::Panel floor{{0, -1, -0.5f}, {0, 0, 1}, {4, 0, 0}};
    const Places places = hundred([](Places& room, float x, int) {
        room.add({x, 0.0f, 0.0f}, kUp, glm::vec3(0.5f));
    });
    const auto roomsIn = [&](std::initializer_list<scenes::Panel> house) {
        return roomsOf(places.surfels, RayScene(scenes::panels(std::vector(house), 8,
                                                               scenes::plain(glm::vec3(0.5f)))));
    };
    EXPECT_NEAR(roomsIn({floor, wall}), 2.0, 0.2);
    EXPECT_EQ(roomsIn({floor}), 1.0);
}

TEST(Pairs, BlackPlacesHaveNone)
{
    const Places places = hundred([](Places& room, float x, int i) {
        room.add({x, 0.0f, 0.0f}, kUp, glm::vec3(i % 2 == 0 ? 0.5f : 0.001f));
    });
    for (const MaterialPair pair : places.pairs(4)) {
        EXPECT_EQ(pair.p % 2, 0u);
        EXPECT_EQ(pair.q % 2, 0u);
    }
}

TEST(Pairs, AreAsManyAsAskedForAndTheSameEveryTime)
{
    const Places places = hundred([](Places& room, float x, int) {
        room.add({x, 0.0f, 0.0f}, kUp, glm::vec3(0.5f));
    });
    const auto first = places.pairs(5);
    const auto second = places.pairs(5);
    EXPECT_EQ(first.size(), 500u);
    ASSERT_EQ(first.size(), second.size());
    for (size_t i = 0; i < first.size(); ++i) {
        EXPECT_NE(first[i].p, first[i].q);
        EXPECT_EQ(first[i].p, second[i].p);
        EXPECT_EQ(first[i].q, second[i].q);
    }
}

TEST(Pairs, OnePlaceHasNobody)
{
    Places places;
    places.add(glm::vec3(0.0f), kUp, glm::vec3(0.5f));
    EXPECT_THAT(places.pairs(4), testing::IsEmpty());
}

// The second wall is a fifth darker by the drift that is to be found; the third is of another hue,
// and the fourth of the same hue and half as bright, as other paint is.
TEST(Pairs, AcrossWallsAreOfOneHueAndAboutAsBright)
{
    const glm::vec3 cream(0.6f, 0.55f, 0.45f);
    const Places places = hundred([&](Places& room, float x, int i) {
        const glm::vec3 paint[] = {cream,        0.8f * cream, {0.55f, 0.55f, 0.5f},
                                   0.5f * cream, cream,        cream};
        const auto surface = static_cast<size_t>(i % 6);
        addToRoom(room, x, surface, paint[surface]);
    });
    const auto pairs = places.acrossWalls(8);
    EXPECT_GT(pairs.size(), 50u);
    for (const MaterialPair pair : pairs) {
        EXPECT_LT(pair.p % 6, 2u);
        EXPECT_EQ(pair.q % 6, 1 - pair.p % 6);
    }
}

// One in twenty of a wall's places is as bright as the next wall by chance: were partners looked
// for until some agree, all of that wall would be paired with these.
TEST(Pairs, AcrossWallsAreOfWhoIsLookedAtWhateverItsPaint)
{
    const Places places = hundred([](Places& room, float x, int i) {
        const bool isOfNextByChance = i % 40 == 1;
        addToRoom(room, x, static_cast<size_t>(i % 2),
                  glm::vec3(i % 2 == 0 || isOfNextByChance ? 0.6f : 0.4f));
    });
    EXPECT_LT(places.acrossWalls(2).size(), 40u); // of 200 that are looked at
}

TEST(Pairs, AcrossWallsAreOfOneRoom)
{
    const Places places = hundred([](Places& house, float x, int i) {
        addToRoom(house, x, static_cast<size_t>(i % 4), glm::vec3(0.5f));
    });
    std::vector<uint8_t> rooms;
    for (const uint32_t i : places.all()) rooms.push_back(i < 50 ? 0 : 1);
    const auto pairs = places.acrossWalls(2, rooms);
    EXPECT_EQ(pairs.size(), 200u);
    for (const auto [p, q] : pairs) EXPECT_EQ(rooms[p], rooms[q]);
}

} // namespace relamp
