#include "history.h"

#include <gtest/gtest.h>

namespace
{

TEST(History, GoesBackAndForth)
{
    History<int> history(1);
    history.record(2, "two");
    history.settle();
    history.record(3, "three");

    EXPECT_EQ(history.undoName(), "three");
    EXPECT_EQ(history.undo(), 2);
    EXPECT_EQ(history.undo(), 1);
    EXPECT_FALSE(history.canUndo());
    EXPECT_EQ(history.undo(), 1);
    EXPECT_EQ(history.redo(), 2);
    EXPECT_EQ(history.redo(), 3);
    EXPECT_FALSE(history.canRedo());
}

TEST(History, ADragIsOneStep)
{
    History<int> history(0);
    for (int i = 1; i < 10; ++i) history.record(i, "drag");
    history.settle();
    history.record(20, "drag");

    EXPECT_EQ(history.undo(), 9);
    EXPECT_EQ(history.undo(), 0);
}

TEST(History, AChangeAfterUndoForgetsWhatWasUndone)
{
    History<int> history(0);
    history.record(1, "a");
    history.settle();
    history.record(2, "b");
    history.undo();
    history.record(5, "c");

    EXPECT_FALSE(history.canRedo());
    EXPECT_EQ(history.undo(), 1);
}

TEST(History, WhatDoesNotChangeIsNoStep)
{
    History<int> history(0);
    history.record(0, "nothing");

    EXPECT_FALSE(history.canUndo());
}

} // namespace
