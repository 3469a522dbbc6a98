#include "shading/room_sights.h"

#include <random>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

constexpr size_t kParts = 40;

/// Some see nothing at all, most see few others, and some as much as others do.
RoomSights someSights()
{
    RoomSights sights(kParts);
    std::mt19937 random(7);
    for (size_t a = 0; a < kParts; ++a)
        for (size_t b = 0; b < kParts; ++b)
            if (a % 9 != 0 && b % 9 != 0 && random() % 4 == 0)
                sights.add(a, b, 1.0 + static_cast<double>(random() % 3));
    return sights;
}

std::vector<double> seenByAll(const RoomSights& sights)
{
    std::vector<double> seen;
    for (size_t part = 0; part < sights.parts(); ++part) seen.push_back(sights.seenBy(part));
    return seen;
}

} // namespace

// By a search of all pairs each time.
TEST(JoinedParts, ThoseComeFirstThatSeeMostOfEachOther)
{
    RoomSights sights = someSights();
    RoomSights known = sights;
    std::vector<double> seen = seenByAll(known);
    JoinedParts parts(sights, seen);
    size_t joined = 0;
    while (const auto two = parts.next()) {
        double most = 0.0;
        std::pair<size_t, size_t> wanted;
        for (size_t a = 0; a < kParts; ++a)
            for (size_t b = a + 1; b < kParts; ++b) {
                if (seen[a] <= 0.0 || seen[b] <= 0.0) continue;
                const double near = known.ofEachOther(a, b) / (seen[a] * seen[b]);
                if (near <= most) continue;
                most = near;
                wanted = {a, b};
            }
        ASSERT_EQ(std::pair(two->into, two->from), wanted);
        EXPECT_EQ(two->ofEachOther, known.ofEachOther(wanted.first, wanted.second));
        known.join(wanted.first, wanted.second);
        seen[wanted.first] += std::exchange(seen[wanted.second], 0.0);
        ++joined;
    }
    EXPECT_GT(joined, kParts / 2);
}

TEST(JoinedParts, ThatSeeNothingStayAlone)
{
    RoomSights sights(3);
    sights.add(0, 2, 1.0);
    sights.add(2, 0, 1.0);
    JoinedParts parts(sights, seenByAll(sights));
    const auto two = parts.next();
    ASSERT_TRUE(two);
    EXPECT_EQ(two->into, 0u);
    EXPECT_EQ(two->from, 2u);
    EXPECT_EQ(two->ofEachOther, 2.0);
    EXPECT_FALSE(parts.next());
}

} // namespace relamp
