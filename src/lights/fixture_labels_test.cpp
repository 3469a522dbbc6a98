#include "lights/fixture_labels.h"

#include "lights/candidates.h"
#include "relamp/scan.h"
#include "scenes/scenes.h"
#include "scenes/surfaces.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using Surface = std::vector<ClippedPatch>;

constexpr glm::vec3 kWindow(0.0f, 1.4f, 2.5f);
constexpr glm::vec3 kPanel(2.0f, 2.5f, 2.5f);
constexpr glm::vec3 kSconce(4.0f, 1.6f, 2.5f);
constexpr glm::vec3 kOnTable(1.0f, 0.7f, 0.0f);

/// A room with a window, a panel in the ceiling, a lamp on a wall and one at a table's height.
Scan litRoom(int pixels)
{
    return scenes::room({4.0f, 2.5f, 5.0f}, pixels, [](glm::vec3 p, glm::vec3) {
        const bool shines = glm::distance(p, kWindow) < 0.6f || glm::distance(p, kPanel) < 0.3f ||
                            glm::distance(p, kSconce) < 0.2f || glm::distance(p, kOnTable) < 0.15f;
        return glm::vec3(shines ? 1.0f : 0.3f);
    });
}

/// What is burnt out at these places, each a fixture.
std::vector<Surface> surfacesAt(const scenes::Surfaces& room, const std::vector<glm::vec3>& places)
{
    const auto candidates = findCandidates(room.texels, room.radiance);
    std::vector<Surface> surfaces;
    for (const glm::vec3 place : places)
        surfaces.push_back(candidates.at(nearestTo(candidates, place)).patches);
    return surfaces;
}

std::vector<FixtureLabel> labelsAt(const scenes::Surfaces& room,
                                   const std::vector<glm::vec3>& places)
{
    Progress progress;
    return labelsOf(room.texels, coarsePiecesOf(room.texels, progress), surfacesAt(room, places),
                    {}, progress);
}

} // namespace

TEST(FixtureLabels, NameTheKindByItsPlaceAndTheNumberByItsSize)
{
    const scenes::Surfaces room(litRoom(64));
    const auto labels = labelsAt(room, {kWindow, kPanel, kSconce, kOnTable});
    EXPECT_EQ(labels[0].name, "window 0");
    EXPECT_EQ(labels[1].name, "ceiling lamp 1");
    EXPECT_EQ(labels[2].name, "wall lamp 2");
    EXPECT_EQ(labels[3].name, "table lamp 3");
    for (size_t i = 0; i < labels.size(); ++i) EXPECT_EQ(labels[i].id, static_cast<int>(i));
}

// The fit finds lamps by falling power, and a draft does not find them all.
TEST(FixtureLabels, DoNotDependOnTheOrderNorOnWhatElseIsFound)
{
    const scenes::Surfaces room(litRoom(64));
    const auto labels = labelsAt(room, {kSconce, kWindow});
    EXPECT_EQ(labels[0].name, "wall lamp 2");
    EXPECT_EQ(labels[1].name, "window 0");
}

// A draft reads pictures of 512 pixels; this one has four times that.
TEST(FixtureLabels, AreTheSameOnACoarseCopyOfTheTexture)
{
    const std::vector<glm::vec3> places{kOnTable, kPanel, kSconce, kWindow};
    const scenes::Surfaces fine(litRoom(680));
    ASSERT_GT(fine.scan.pages[0].image.width, 1024);
    const scenes::Surfaces coarse(coarsened(litRoom(680), 512));
    ASSERT_LE(coarse.scan.pages[0].image.width, 512);
    const auto ofFine = labelsAt(fine, places);
    const auto ofCoarse = labelsAt(coarse, places);
    for (size_t i = 0; i < places.size(); ++i) {
        EXPECT_EQ(ofFine[i].id, ofCoarse[i].id) << i;
        EXPECT_EQ(ofFine[i].name, ofCoarse[i].name) << i;
    }
}

// By the floor and ceiling of its own room: on the lower storey a lamp hangs far below the roof.
TEST(FixtureLabels, OfAHouseAreByStorey)
{
    constexpr glm::vec3 kStorey(4.0f, 2.5f, 5.0f);
    constexpr float kUp = 2.8f; // m from floor to floor
    constexpr glm::vec3 kBelow(2.0f, 2.5f, 2.5f);
    constexpr glm::vec3 kOnTableAbove(1.0f, kUp + 0.7f, 0.0f);
    std::vector<scenes::Panel> walls = scenes::wallsOf(kStorey);
    for (scenes::Panel wall : scenes::wallsOf(kStorey)) {
        wall.corner.y += kUp;
        walls.push_back(wall);
    }
    const scenes::Surfaces house(scenes::panels(walls, 64, [&](glm::vec3 p, glm::vec3) {
        const bool shines =
            glm::distance(p, kBelow) < 0.3f || glm::distance(p, kOnTableAbove) < 0.15f;
        return glm::vec3(shines ? 1.0f : 0.3f);
    }));
    std::vector<uint8_t> roomOfSurfel;
    for (const glm::vec3 place : house.texels.surfels.position)
        roomOfSurfel.push_back(place.y < 0.5f * (kStorey.y + kUp) ? 0 : 1);
    Progress progress;
    const auto surfaces = surfacesAt(house, {kBelow, kOnTableAbove});
    const CoarsePieces coarse = coarsePiecesOf(house.texels, progress);
    const auto labels = labelsOf(house.texels, coarse, surfaces, roomOfSurfel, progress);
    EXPECT_EQ(labels[0].name, "ceiling lamp 0");
    EXPECT_EQ(labels[1].name, "table lamp 1");
    const auto asOneRoom = labelsOf(house.texels, coarse, surfaces, {}, progress);
    EXPECT_EQ(asOneRoom[0].name, "floor lamp 0");
    EXPECT_EQ(asOneRoom[1].id, labels[1].id);
}

// Such as a lamp in a hole of the ceiling, which was not scanned, or one that is not burnt out.
TEST(FixtureLabels, OfWhatLiesOnNoPieceAreByItsOwnPlace)
{
    const scenes::Surfaces room(litRoom(64));
    const Surface inCeiling{{{2.0f, 2.5f, 1.0f}, {0.0f, -1.0f, 0.0f}, 0.2f, Surfels::kNone}};
    Progress progress;
    const auto labels = labelsOf(room.texels, coarsePiecesOf(room.texels, progress),
                                 std::vector<Surface>{inCeiling}, {}, progress);
    EXPECT_GE(labels[0].id, 4); // behind all pieces
    EXPECT_EQ(labels[0].name, "ceiling lamp " + std::to_string(labels[0].id));
}

TEST(FixtureLabels, NoTwoHaveOneNumber)
{
    const scenes::Surfaces room(litRoom(64));
    const auto labels = labelsAt(room, {kPanel, kPanel, kPanel});
    EXPECT_NE(labels[0].id, labels[1].id);
    EXPECT_NE(labels[1].id, labels[2].id);
    EXPECT_NE(labels[0].id, labels[2].id);
    EXPECT_NE(labels[1].name, labels[2].name);
}

} // namespace relamp
