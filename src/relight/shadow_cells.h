#pragma once

#include "scan/texels.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// Texels of a page that look at a light together: those of one face in a square of pixels 6 mm
/// wide. Where pixels are about as wide, each texel is a cell.
class ShadowCells
{
public:
    struct Texel
    {
        uint32_t index; // of the page's
        uint32_t run;   // of the page's, that it belongs to
    };

    /// Of the texels of `runs`, ascending. `texels` must outlive this.
    ShadowCells(const Texels& texels, size_t page, std::span<const uint32_t> runs);

    [[nodiscard]] size_t count() const { return first_.size() - 1; }
    [[nodiscard]] std::span<const Texel> texelsOf(size_t cell) const
    {
        return std::span(order_).subspan(first_[cell], first_[cell + 1] - first_[cell]);
    }
    /// That its middle texel belongs to; the others lie beside it and face the same way.
    [[nodiscard]] uint32_t runOf(size_t cell) const { return run_[cell]; }

    static constexpr size_t kAround = 8;
    /// Cells beside it of the same face, at most kAround. Returns how many.
    size_t around(size_t cell, uint32_t* cells) const;

    static constexpr size_t kBetween = 4;
    /// Cells whose middles lie around a texel's, on its face, and by how much each counts in
    /// linear interpolation, in sum 1; at most kBetween. Returns how many; 0 where it is a cell by
    /// itself.
    size_t between(const Texel& texel, uint32_t* cells, float* weights) const;

private:
    static constexpr uint32_t kNone = ~0u;

    void sortBySquare();
    [[nodiscard]] uint32_t squareOf(const Texel& texel) const;
    [[nodiscard]] bool areOfOneFace(uint32_t run, uint32_t other) const;

    const Texels& texels_;
    const PageTexels& page_;
    uint32_t width_; // pixels
    uint32_t side_;  // pixels of a square
    uint32_t squaresAcross_;
    uint32_t squaresDown_;
    std::vector<Texel> order_;       // by cell
    std::vector<uint32_t> first_;    // of cells, into order_, and one more
    std::vector<uint32_t> run_;      // of cells
    std::vector<uint32_t> square_;   // of cells; kNone: of another face than the square's cell
    std::vector<uint32_t> inSquare_; // of squares: the cell; empty where each texel is a cell
};

} // namespace relamp
