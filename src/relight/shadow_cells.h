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
    /// Cells of the squares beside its own, of its face, at most kAround. Returns how many; 0 where
    /// it has no square, and is one texel.
    size_t around(size_t cell, uint32_t* cells) const;

    static constexpr size_t kBetween = 4;
    /// Its own and those of around() whose middles lie around a texel of it, and by how much each
    /// counts in linear interpolation, in sum 1; at most kBetween. Returns how many; 0 where it has
    /// no square.
    size_t between(size_t cell, const Texel& texel, uint32_t* cells, float* weights) const;

private:
    static constexpr uint32_t kNone = ~0u;

    void sortBySquare();
    void add(size_t first, uint32_t run, uint32_t square, glm::vec3 middle);
    [[nodiscard]] uint32_t squareOf(const Texel& texel) const;
    [[nodiscard]] bool areOfOneFace(uint32_t run, uint32_t other) const;
    [[nodiscard]] bool areBeside(uint32_t cell, uint32_t other) const;

    const Texels& texels_;
    size_t index_; // of the page
    const PageTexels& page_;
    uint32_t width_; // pixels
    uint32_t side_;  // pixels of a square
    uint32_t squaresAcross_;
    uint32_t squaresDown_;
    std::vector<Texel> order_;    // by cell
    std::vector<uint32_t> first_; // of cells, into order_, and one more
    std::vector<uint32_t> run_;   // of cells
    // Where each texel is a cell, these are empty.
    std::vector<uint32_t> square_;   // of cells; kNone: apart from the square's cell
    std::vector<glm::vec3> middle_;  // of cells: where their middle texel lies
    std::vector<uint32_t> inSquare_; // of squares: the cell
};

} // namespace relamp
