#include "settings.h"

#include "scenes/temporary_folder.h"

#include <gtest/gtest.h>

namespace
{

TEST(Settings, AreReadAsTheyWereWritten)
{
    const relamp::scenes::TemporaryFolder folder;
    Settings settings;
    settings.width = 1500;
    settings.walks = true;
    settings.recent = {"/a/b.glb"};

    ASSERT_TRUE(writeSettings(folder / "deep/viewer.json", settings));
    const Settings read = readSettings(folder / "deep/viewer.json");

    EXPECT_EQ(read.width, 1500);
    EXPECT_TRUE(read.walks);
    EXPECT_EQ(read.recent, settings.recent);
}

TEST(Settings, WhatIsBrokenIsAsIfItWereNotThere)
{
    const relamp::scenes::TemporaryFolder folder;
    for (const char* text : {"", "{", "[]", "{\"width\": \"wide\"}"})
        EXPECT_EQ(readSettings(folder.write("viewer.json", text)).width, Settings{}.width) << text;
    EXPECT_EQ(readSettings(folder.write("viewer.json", R"({"width": 1e300})")).width, 16384);
    EXPECT_EQ(readSettings(folder.write("viewer.json", R"({"width": -1e300})")).width, 320);
    EXPECT_FALSE(writeSettings(folder.write("file", "") / "viewer.json", {}));
}

} // namespace
