#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

namespace relamp
{

/// Values of a picture where they lie in memory, row 0 on top: what a library that knows strides,
/// like NumPy, looks at without a copy. Lives no longer than what it looks at.
template<class Value>
struct PixelView
{
    const Value* first = nullptr; // channel 0 of row 0, column 0
    int width = 0;
    int height = 0;
    int channels = 0;
    std::ptrdiff_t rowStride = 0;    // in values, from a row to the next
    std::ptrdiff_t columnStride = 0; // in values, from a pixel of a row to the next

    [[nodiscard]] const Value& at(int row, int column, int channel = 0) const
    {
        assert(row >= 0 && row < height && column >= 0 && column < width);
        assert(channel >= 0 && channel < channels);
        return first[row * rowStride + column * columnStride + channel];
    }

    /// One channel of it.
    [[nodiscard]] PixelView channel(int which) const
    {
        assert(which >= 0 && which < channels);
        return {first + which, width, height, 1, rowStride, columnStride};
    }

    /// A rectangle of it, which lies within.
    [[nodiscard]] PixelView part(int row, int column, int rows, int columns) const
    {
        assert(row >= 0 && rows >= 0 && row + rows <= height);
        assert(column >= 0 && columns >= 0 && column + columns <= width);
        return {first + row * rowStride + column * columnStride,
                columns,
                rows,
                channels,
                rowStride,
                columnStride};
    }
};

/// `values` as a picture of this size, row by row: those of an Image, of PageLayers or of
/// PageGeometry. As many channels as there are values a pixel; none where there are no values.
template<class Value>
PixelView<Value> pixelView(const std::vector<Value>& values, int width, int height)
{
    const auto row = static_cast<std::ptrdiff_t>(width);
    const std::ptrdiff_t pixels = row * height;
    const int channels = pixels > 0 ? static_cast<int>(std::ssize(values) / pixels) : 0;
    assert(std::ssize(values) == channels * pixels);
    return {values.data(), width, height, channels, channels * row, channels};
}
template<class Value>
PixelView<Value> pixelView(std::vector<Value>&& values, int width, int height) = delete;

} // namespace relamp
