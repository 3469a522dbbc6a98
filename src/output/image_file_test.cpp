#include "relamp/error.h"
#include "relamp/image.h"
#include "scenes/temporary_folder.h"

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

Image twoPixels()
{
    Image image;
    image.width = 2;
    image.height = 1;
    image.rgb = std::vector<uint8_t>{10, 128, 255, 0, 64, 200};
    return image;
}

TEST(WriteImage, IsReadAsItWasWritten)
{
    const scenes::TemporaryFolder folder;
    Progress progress;
    for (const char* name : {"a.png", "a.exr"}) {
        writeImage(twoPixels(), folder / name, progress);
        const Image written = twoPixels();
        const Image read = readImage(folder / name);
        const Radiance before(written);
        const Radiance after(read);
        for (size_t i = 0; i < 2; ++i)
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[i][c], before[i][c], 1e-3f) << name;
    }
}

TEST(WriteImage, RefusesOtherEndingsAndPlaces)
{
    const scenes::TemporaryFolder folder;
    Progress progress;
    for (const char* name : {"a.jpg", "a", "nowhere/a.png"})
        EXPECT_THROW(writeImage(twoPixels(), folder / name, progress), Error) << name;
}

} // namespace
} // namespace relamp
