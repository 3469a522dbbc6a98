#include "lights/camera_item.h"

#include "relamp/error.h"
#include "relamp/lights.h"
#include "relamp/response.h"
#include "scenes/refusal.h"
#include "scenes/temporary_folder.h"

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using testing::HasSubstr;

constexpr Response kCurved{{0.7f, 0.8f, 0.9f, 1.0f, 1.25f}};

Response responseIn(const std::string& text)
{
    const scenes::TemporaryFolder folder;
    std::vector<std::string> warnings;
    const Response response = readResponse(folder.write("camera.json", text), warnings);
    EXPECT_THAT(warnings, testing::IsEmpty());
    return response;
}

} // namespace

TEST(ResponseFile, IsALightsFileAReportOrACurveAlone)
{
    const std::string camera = R"({"response": [0.7, 0.8, 0.9, 1, 1.25]})";
    EXPECT_EQ(responseIn(R"({"camera": )" + camera + "}"), kCurved);
    EXPECT_EQ(responseIn(R"({"format": "relamp lights 1", "ambient": [1, 1, 1], "camera": )" +
                         camera + "}"),
              kCurved);
    EXPECT_EQ(
        responseIn(R"({"program": "relamp 0.2", "lights": {"camera": {"contrast": 1.1, "model": )" +
                   camera + "}}}"),
        kCurved);
}

// The gain that drifted over that scan is of no other.
TEST(ResponseFile, TakesTheCurveAloneOfAllThatACameraDid)
{
    EXPECT_EQ(responseIn(R"({"camera": {"response": [0.7, 0.8, 0.9, 1, 1.25], "gain": {
                       "origin": [0, 0, 0], "spacing": 1, "count": [1, 1, 1], "stops": [0]}}})"),
              kCurved);
}

TEST(ResponseFile, OfACameraThatDidNothingIsStraight)
{
    EXPECT_TRUE(responseIn(R"({"format": "relamp lights 1", "ambient": [1, 1, 1]})").isStraight());
    EXPECT_TRUE(responseIn(R"({"format": "relamp lights 1", "ambient": [1, 1, 1],
                               "camera": {}})")
                    .isStraight());
    EXPECT_TRUE(responseIn(R"({"lights": {"camera": {"model": {}}}})").isStraight());
}

TEST(ResponseFile, ThatTellsNoCameraIsRefused)
{
    const auto refusal = [](const std::string& text) {
        return scenes::refusalOf([&] { responseIn(text); });
    };
    EXPECT_THAT(refusal(R"({"lights": []})"), HasSubstr("tells no camera"));
    EXPECT_THAT(refusal(R"({"format": "relamp camera 1", "position": [0, 0, 0]})"),
                HasSubstr("tells no camera"));
    EXPECT_THAT(refusal(R"({"camera": {"response": [1, 1]}})"), HasSubstr("must be 5 slopes"));
    EXPECT_THAT(refusal(R"({"camera": {"respons": [1, 1, 1, 1, 1]}})"),
                HasSubstr("lacks \"response\""));
    EXPECT_THAT(refusal(R"({"camera": [1, 1, 1, 1, 1]})"), HasSubstr("must be an object"));
}

} // namespace relamp
