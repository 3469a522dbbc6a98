#include "relamp/picture.h"

#include "scenes/scenes.h"

#include <limits>

#include <gmock/gmock.h>

namespace relamp
{

// From inside a box to its walls; from below the floor, whose back does not count, to the ceiling;
// up from above there is nothing.
TEST(Photographer, SeesPastBacksUpToWhatFacesIt)
{
    DelitRoom room;
    room.scan = std::make_shared<const Scan>(
        scenes::room({4.0f, 2.5f, 5.0f}, 16, scenes::plain(glm::vec3(0.5f))));
    Progress progress;
    const Photographer photographer(room, progress);
    const std::vector<glm::vec3> ways{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
    constexpr float kNothing = std::numeric_limits<float>::infinity();

    EXPECT_THAT(photographer.distancesSeen({1.0f, 1.0f, 2.0f}, ways),
                testing::Pointwise(testing::FloatNear(1e-4f), {3.0f, 2.0f, 1.5f}));
    EXPECT_THAT(photographer.distancesSeen({1.0f, -1.0f, 2.0f}, ways),
                testing::ElementsAre(kNothing, kNothing, testing::FloatNear(3.5f, 1e-4f)));
    EXPECT_THAT(photographer.distancesSeen({1.0f, 3.0f, 2.0f}, ways), testing::Each(kNothing));
}

} // namespace relamp
