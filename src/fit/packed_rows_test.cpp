#include "fit/packed_rows.h"

#include <algorithm>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::SizeIs;

constexpr size_t kPackedColumns = 3 * kLanes + 5;

/// Row i has i + 1 in column i and nothing else; from 300 on rows are empty.
PackedRows diagonal()
{
    return {400, kPackedColumns, [](size_t i, std::span<float> row) {
                if (i < 300) row[i % kPackedColumns] = static_cast<float>(i + 1);
            }};
}

} // namespace

TEST(PackedRows, KeepNoGroupsOfZeros)
{
    const PackedRows rows = diagonal();
    for (const size_t i : {0u, 17u, 52u, 299u}) {
        const PackedRows::Row row = rows.row(i);
        const size_t column = i % kPackedColumns;
        EXPECT_THAT(row.groups, ElementsAre(column / kLanes));
        EXPECT_EQ(row.values[column % kLanes], static_cast<float>(i + 1));
        EXPECT_EQ(std::count(row.values, row.values + kLanes, 0.0f), int{kLanes} - 1);
    }
    EXPECT_THAT(rows.row(399).groups, SizeIs(0));
}

TEST(PackedRows, GiveWhatIsInTheColumnsThatOneAsksFor)
{
    const PackedRows rows = diagonal();
    std::vector<float> numbers(3);
    rows.pick(51, std::vector<size_t>{0, 51, 52}, numbers);
    EXPECT_THAT(numbers, ElementsAre(0.0f, 52.0f, 0.0f));
    rows.pick(350, std::vector<size_t>{0, 51, 52}, numbers);
    EXPECT_THAT(numbers, Each(0.0f));
}

} // namespace relamp
