#include "progress_line.h"

#include <limits>

#include <gmock/gmock.h>

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

// A line as wide as the terminal may be broken, and the next would then begin below it.
TEST(ProgressLine, FitsEveryTerminal)
{
    for (const std::string name : {"a", "light at once", "frame 9999 of 9999, visibility"})
        for (int columns = 1; columns <= 65'535;
             columns = columns < 200 ? columns + 1 : 2 * columns)
            for (const double fraction : {0.0, 0.5, 1.0}) {
                const std::string line = progressLine(name, fraction, columns);
                EXPECT_LT(line.size(), static_cast<size_t>(columns)) << line;
                EXPECT_LE(line.size(), 80u) << line;
            }
}

TEST(ProgressLine, SaysWhatItCanWhereThereIsLittleRoom)
{
    EXPECT_EQ(progressLine("bounce", 0.5, 10), "bou  50 %");
    EXPECT_EQ(progressLine("bounce", 0.5, 20), "  bounce  50 %");
    EXPECT_EQ(progressLine("bounce", 0.5, 36), "  bounce       [######      ]  50 %");
    EXPECT_EQ(progressLine("bounce", 1.0, 65'535),
              "  bounce       [##############################] 100 %");
}

TEST(ProgressLine, ATerminalThatDoesNotKnowItsWidthIsAnUsualOne)
{
    EXPECT_EQ(progressLine("bounce", 0.5, 0), progressLine("bounce", 0.5, 80));
}

TEST(ProgressLine, NoFractionDrawsBeyondItsBar)
{
    EXPECT_EQ(progressLine("a", 7.0, 80), progressLine("a", 1.0, 80));
    EXPECT_EQ(progressLine("a", -7.0, 80), progressLine("a", 0.0, 80));
    EXPECT_EQ(progressLine("a", std::numeric_limits<double>::quiet_NaN(), 80),
              progressLine("a", 0.0, 80));
}
