#include "scenes/form_factors.h"

#include <gtest/gtest.h>

namespace relamp::scenes
{

// Each wall of a cube has a fifth of the view of any other, but for the digits of the tables.
TEST(FormFactors, AreThoseOfTheTables)
{
    EXPECT_NEAR(opposite(1.0, 1.0, 1.0), 0.199825, 1e-6);
    EXPECT_NEAR(adjacent(1.0, 1.0, 1.0), 0.200044, 1e-6);
}

// Every ray from a wall of a closed box meets one of the others; and what two walls exchange is
// the same both ways.
TEST(FormFactors, OfABoxAddUpToOne)
{
    const double x = 4.0;
    const double y = 2.5;
    const double z = 5.0;
    EXPECT_NEAR(opposite(x, z, y) + 2.0 * adjacent(x, z, y) + 2.0 * adjacent(z, x, y), 1.0, 1e-9);
    EXPECT_NEAR(x * adjacent(z, x, y), y * adjacent(z, y, x), 1e-9);
}

} // namespace relamp::scenes
