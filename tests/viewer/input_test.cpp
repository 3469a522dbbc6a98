#include "input.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

namespace
{

TEST(Input, ChordsAreReadAndNamed)
{
    for (const char* name : {"f", "1", "ctrl+z", "ctrl+shift+z", "+", "pageup", "f12", "["}) {
        const auto chord = chordNamed(name);
        ASSERT_TRUE(chord) << name;
        EXPECT_EQ(nameOf(*chord), name);
    }
    EXPECT_EQ(chordNamed("Ctrl+S"), (KeyChord{GLFW_KEY_S, GLFW_MOD_CONTROL}));
}

TEST(Input, WhatIsNoKeyIsNone)
{
    for (const char* name : {"", "ctrl+", "hyper+x", "f13", "ab"})
        EXPECT_FALSE(chordNamed(name)) << name;
}

} // namespace
