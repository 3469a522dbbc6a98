#pragma once

#include "base/instruction_set.h"
#include "relamp/scan.h"
#include "thesis/direct.h"
#include "thesis/rsm.h"

#include <array>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace relamp
{

/// Cubic cells over a box, with one empty cell around them so that propagation needs no border
/// case.
struct LpvGrid
{
    LpvGrid(const Bounds& bounds, int size); // `size` cells along the longest side, 4..128

    glm::ivec3 cells{0};    // including the border
    glm::vec3 origin{0.0f}; // world position of the corner of cell (0, 0, 0)
    float cell = 0.0f;      // m

    [[nodiscard]] size_t count() const
    {
        return static_cast<size_t>(cells.x) * static_cast<size_t>(cells.y) *
               static_cast<size_t>(cells.z);
    }
    [[nodiscard]] size_t indexOf(glm::ivec3 at) const
    {
        return (static_cast<size_t>(at.z) * static_cast<size_t>(cells.y) +
                static_cast<size_t>(at.y)) *
                   static_cast<size_t>(cells.x) +
               static_cast<size_t>(at.x);
    }
    /// The cell that holds a place, kept off the border.
    [[nodiscard]] glm::ivec3 cellAt(glm::vec3 world) const;
};

/// Piece of surface that holds up light.
struct Blocker
{
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};
    float area = 0.0f; // m^2
};

/// Light propagation volume (Kaplanyan & Dachsbacher 2010): bounce light spread step by step over a
/// grid of intensities in two bands of spherical harmonics, RGB.
class Lpv
{
public:
    /// Spherical harmonics, four coefficients a channel, one value a cell: [channel][coefficient].
    using Field = std::array<std::array<std::vector<float>, 4>, 3>;

    explicit Lpv(const LpvGrid& grid);
    /// With light that has been spread elsewhere; to be read out only.
    Lpv(const LpvGrid& grid, Field accumulated);

    [[nodiscard]] const LpvGrid& grid() const { return grid_; }
    /// Light of the last step alone, and of all steps.
    [[nodiscard]] const Field& travelling() const { return travelling_; }
    [[nodiscard]] const Field& accumulated() const { return accumulated_; }

    /// Fills the geometry volume, half a cell off the grid of light, from the scan's surfaces.
    void block(std::span<const Blocker> blockers);
    /// Adds bounce light, each half a cell in front of its surface.
    void inject(std::span<const BounceLight> lights);
    /// One step of all light to the next cells. `first`: surfaces do not hold up what they sent.
    void propagate(bool first, InstructionSet set = bestInstructionSet());
    /// Packs what has accumulated for irradiance(); call after the last step.
    void finish();

    /// Irradiance on the texels of a block. Entries behind its last texel are unspecified.
    void irradiance(const TexelBlock& block, RgbBlock& out,
                    InstructionSet set = bestInstructionSet()) const;

private:
    LpvGrid grid_;
    Field travelling_;
    Field arriving_;
    Field accumulated_;
    std::array<std::array<std::vector<float>, 4>, 3>
        faceCoverage_;          // [axis]: between a cell and the next
    std::vector<float> packed_; // 16 a cell: r, g, b and padding of each coefficient
};

} // namespace relamp
