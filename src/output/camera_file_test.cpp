#include "output/camera_file.h"

#include "relamp/error.h"
#include "scenes/temporary_folder.h"

#include <glm/gtc/constants.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using testing::HasSubstr;
using testing::IsEmpty;

class CameraFile : public testing::Test
{
protected:
    Camera read(const std::string& text)
    {
        return readCamera(folder_.write("camera.json", text), warnings_);
    }

    std::string refusal(const std::string& text)
    {
        try {
            read(text);
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("camera.json"));
            return error.what();
        }
        return "";
    }

    std::vector<std::string> warnings_;

private:
    scenes::TemporaryFolder folder_;
};

} // namespace

TEST_F(CameraFile, LooksFromAPlaceAtAPlace)
{
    const Camera camera = read(R"({"format": "relamp camera 1", "position": [1, 1.5, 2],
                                   "target": [1, 1.5, -1], "fieldOfView": 90})");
    EXPECT_EQ(camera.position, glm::vec3(1.0f, 1.5f, 2.0f));
    EXPECT_EQ(camera.forward, glm::vec3(0.0f, 0.0f, -1.0f));
    EXPECT_EQ(camera.up, glm::vec3(0.0f, 1.0f, 0.0f));
    EXPECT_NEAR(camera.fieldOfView, glm::half_pi<float>(), 1e-6f);
    EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(CameraFile, StraightDownIsAView)
{
    const Camera camera =
        read(R"({"position": [0, 9, 0], "forward": [0, -2, 0], "across": "height", "lens": 35})");
    EXPECT_EQ(camera.forward, glm::vec3(0.0f, -1.0f, 0.0f));
    EXPECT_EQ(camera.up, glm::vec3(0.0f, 0.0f, -1.0f));
    EXPECT_EQ(camera.across, Across::height);
    EXPECT_THAT(warnings_, testing::ElementsAre(HasSubstr("\"lens\" is not known")));
}

TEST_F(CameraFile, WhatIsNoViewIsRefusedWithLineAndKey)
{
    EXPECT_THAT(refusal("{}"), HasSubstr("\"position\" is missing"));
    EXPECT_THAT(refusal(R"({"position": [1, 2, 3]})"), HasSubstr("needs either \"target\""));
    EXPECT_THAT(refusal(R"({"position": [1, 2, 3], "target": [1, 2, 4], "forward": [1, 0, 0]})"),
                HasSubstr("needs either \"target\""));
    EXPECT_THAT(refusal("{\"position\": [1, 2, 3],\n\"target\": [1, 2, 3]}"),
                HasSubstr("elsewhere (line 2)"));
    EXPECT_THAT(refusal(R"({"position": [1, 2, 3], "forward": [0, 0, 0]})"),
                HasSubstr("has no length"));
    EXPECT_THAT(refusal(R"({"position": [1, 2, 3], "forward": [0, 0, 1], "up": [0, 0, -2]})"),
                HasSubstr("\"up\""));
    EXPECT_THAT(refusal(R"({"position": [1, 2, 3], "forward": [0, 0, 1], "fieldOfView": 180})"),
                HasSubstr("1 to 170 degrees"));
    EXPECT_THAT(refusal(R"({"position": [1, 2, 3], "forward": [0, 0, 1], "across": "depth"})"),
                HasSubstr("\"width\" or \"height\""));
    EXPECT_THAT(refusal(R"({"position": [1, 2, 1e30], "forward": [0, 0, 1]})"),
                HasSubstr("between -1e9 and 1e9"));
    EXPECT_THAT(refusal(R"({"format": "relamp lights 1"})"), HasSubstr("relamp camera 1"));
    EXPECT_THAT(refusal("[1]"), HasSubstr("not an object"));
}

} // namespace relamp
