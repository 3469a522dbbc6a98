#include "read_room.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace
{

ReadRoom roomWithin(const relamp::Bounds& bounds, const std::vector<relamp::ScanCamera>& cameras)
{
    relamp::Scan scan;
    scan.cameras = cameras;
    RoomMesh mesh;
    mesh.bounds = bounds;
    return {.scan = std::make_shared<const relamp::Scan>(scan),
            .mesh = std::make_shared<const RoomMesh>(mesh)};
}

} // namespace

TEST(ReadRoom, IsLookedAtFromTheScansOwnCamera)
{
    const relamp::Camera own{{1.0f, 2.0f, 3.0f}, {1, 0, 0}, {0, 1, 0}, 0.5f};
    const Outlook outlook =
        firstOutlook(roomWithin({glm::vec3(0.0f), glm::vec3(4.0f)}, {{.camera = own}}));
    EXPECT_EQ(outlook.camera.position, own.position);
    EXPECT_EQ(outlook.camera.forward, own.forward);
    EXPECT_EQ(outlook.camera.fieldOfView, own.fieldOfView);
}

// Even into a room that is a mere point, which has no diagonal to look along.
TEST(ReadRoom, IsElseLookedAtFromWithin)
{
    for (const float size : {4.0f, 0.0f}) {
        const relamp::Bounds bounds{glm::vec3(-1.0f), glm::vec3(-1.0f + size)};
        const Outlook outlook = firstOutlook(roomWithin(bounds, {}));
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(outlook.camera.position[c], bounds.low[c]);
            EXPECT_LE(outlook.camera.position[c], bounds.high[c]);
        }
        EXPECT_NEAR(glm::length(outlook.camera.forward), 1.0f, 1e-5f);
        EXPECT_EQ(outlook.distance > 0.0f, size > 0.0f);
    }
}
