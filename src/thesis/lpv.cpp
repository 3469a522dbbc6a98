#include "thesis/lpv.h"

#include "base/lanes.h"
#include "base/parallel.h"
#include "thesis/lpv.shared.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relamp
{
namespace
{

constexpr size_t kPacked = 16; // floats a cell in the packed field: one cache line

struct Face
{
    glm::vec3 normal;    // where light leaves the cell, and where it is sent on to
    glm::vec3 direction; // from the centre of the source cell to the centre of the face
    float solidAngle;
};

/// The five faces through which light from the neighbour on one side enters a cell and goes on.
struct Source
{
    glm::ivec3 step; // from the cell to the neighbour that the light comes from
    int axis;        // of `step`
    std::array<Face, 5> faces;
};

std::array<Source, 6> makeSources()
{
    std::array<Source, 6> sources{};
    for (int s = 0; s < 6; ++s) {
        Source& source = sources[static_cast<size_t>(s)];
        source.axis = s / 2;
        source.step = -glm::ivec3(travelFrom(s));
        for (int f = 0; f < 5; ++f)
            source.faces[static_cast<size_t>(f)] = {faceNormal(s, f), faceDirection(s, f),
                                                    faceSolidAngle(f)};
    }
    return sources;
}

struct Slab
{
    int firstZ;
    int endZ;
};

struct PropagateArgs
{
    const LpvGrid* grid;
    const Lpv::Field* from;
    Lpv::Field* to;
    Lpv::Field* accumulated;
    const std::array<std::array<std::vector<float>, 4>, 3>* coverage;
    const std::array<Source, 6>* sources;
    bool blocking;
};

/// Rows of the four coefficients of one channel, or of coverage.
struct Rows
{
    const float* k[4];

    Rows(const std::array<std::vector<float>, 4>& of, size_t at)
        : k{of[0].data() + at, of[1].data() + at, of[2].data() + at, of[3].data() + at}
    {}
    [[nodiscard]] glm::vec4 operator[](size_t x) const
    {
        return {k[0][x], k[1][x], k[2][x], k[3][x]};
    }
};

/// Light that reaches `count` cells of a row through one face of theirs.
template<bool blocking>
void gatherFace(const Face& face, const Rows& in, const Rows& coverage, size_t count,
                std::array<std::vector<float>, 4>& channel, size_t row)
{
    // The lobe of an axis has two coefficients that are not zero: the first, and the axis's own.
    const glm::vec4 lobe = face.solidAngle / kPi * shLobe(face.normal);
    const int axis = lobe.y != 0.0f ? 1 : lobe.z != 0.0f ? 2 : 3;
    const float alongAxis = lobe.y + lobe.z + lobe.w;
    const glm::vec3 direction = face.direction;
    float* all = channel[0].data() + row;
    float* along = channel[static_cast<size_t>(axis)].data() + row;
    RELAMP_INDEPENDENT_ITERATIONS
    for (size_t x = 0; x < count; ++x) {
        const float passed = blocking ? passedThrough(in[x], coverage[x], direction)
                                      : max(dot(in[x], shBasis(direction)), 0.0f);
        all[x] += passed * lobe.x;
        along[x] += passed * alongAxis;
    }
}

/// Light that reaches `count` cells of one row from one neighbour, through its five faces.
void gatherRow(const PropagateArgs& args, const Source& source, size_t row, size_t count)
{
    const LpvGrid& grid = *args.grid;
    const auto offset =
        source.step.x + grid.cells.x * (source.step.y + grid.cells.y * source.step.z);
    const size_t from = row + static_cast<size_t>(static_cast<ptrdiff_t>(offset));
    // Coverage is stored at the lower of the two cells that a face parts.
    const size_t wall = source.step[source.axis] < 0 ? from : row;
    const Rows coverage((*args.coverage)[static_cast<size_t>(source.axis)], wall);
    for (size_t c = 0; c < 3; ++c) {
        const Rows in((*args.from)[c], from);
        for (const Face& face : source.faces)
            args.blocking ? gatherFace<true>(face, in, coverage, count, (*args.to)[c], row)
                          : gatherFace<false>(face, in, coverage, count, (*args.to)[c], row);
    }
}

void propagateKernel(const PropagateArgs& args, const Slab& slab)
{
    const LpvGrid& grid = *args.grid;
    const auto count = static_cast<size_t>(grid.cells.x - 2);
    for (int z = slab.firstZ; z < slab.endZ; ++z)
        for (int y = 1; y + 1 < grid.cells.y; ++y) {
            const size_t row = grid.indexOf({1, y, z});
            for (auto& channel : *args.to)
                for (auto& coefficient : channel)
                    std::fill_n(coefficient.data() + row, count, 0.0f);
            for (const Source& source : *args.sources) gatherRow(args, source, row, count);
            for (size_t c = 0; c < 3; ++c)
                for (size_t k = 0; k < 4; ++k) {
                    const float* add = (*args.to)[c][k].data() + row;
                    float* __restrict sum = (*args.accumulated)[c][k].data() + row;
                    for (size_t x = 0; x < count; ++x) sum[x] += add[x];
                }
        }
}

struct ReadOutArgs
{
    const LpvGrid* grid;
    const float* packed;
    const TexelBlock* block;
    RgbBlock* out;
};

/// Where the texels of a block look: half a cell off their surface.
struct Lookups
{
    alignas(64) int32_t cell[TexelBlock::kCapacity];
    alignas(64) float x[TexelBlock::kCapacity], y[TexelBlock::kCapacity],
        z[TexelBlock::kCapacity]; // part of a cell
};

void lookUp(const LpvGrid& grid, const TexelBlock& block, Lookups& out)
{
    const glm::ivec3 cells = grid.cells;
    const glm::vec3 origin = grid.origin;
    const float cell = grid.cell;
    for (size_t i = 0; i < block.count; ++i) {
        const glm::vec3 position(block.x[i], block.y[i], block.z[i]);
        const glm::vec3 normal(block.nx[i], block.ny[i], block.nz[i]);
        const glm::vec3 at = lookUpPlace(position, normal, origin, cell, cells);
        const int32_t x = static_cast<int32_t>(at.x); // at >= 0: this is floor
        const int32_t y = static_cast<int32_t>(at.y);
        const int32_t z = static_cast<int32_t>(at.z);
        out.cell[i] = (z * cells.y + y) * cells.x + x;
        out.x[i] = at.x - static_cast<float>(x);
        out.y[i] = at.y - static_cast<float>(y);
        out.z[i] = at.z - static_cast<float>(z);
    }
}

void readOutKernel(const ReadOutArgs& args)
{
    const LpvGrid& grid = *args.grid;
    const TexelBlock& block = *args.block;
    Lookups at;
    lookUp(grid, block, at);
    const auto stepY = static_cast<size_t>(grid.cells.x);
    const size_t stepZ = stepY * static_cast<size_t>(grid.cells.y);
    const size_t corner[8] = {0,     1,         stepY,         stepY + 1,
                              stepZ, stepZ + 1, stepZ + stepY, stepZ + stepY + 1};
    const float toIrradiance = 4.0f / (grid.cell * grid.cell);
    for (size_t i = 0; i < block.count; ++i) {
        const float x[2] = {1.0f - at.x[i], at.x[i]};
        const float y[2] = {1.0f - at.y[i], at.y[i]};
        const float z[2] = {1.0f - at.z[i], at.z[i]};
        float sh[kPacked] = {};
        for (size_t c = 0; c < 8; ++c) {
            const float weight = x[c & 1] * y[c >> 1 & 1] * z[c >> 2];
            const float* source =
                args.packed + kPacked * (static_cast<size_t>(at.cell[i]) + corner[c]);
            RELAMP_KEEP_LOOP
            for (size_t k = 0; k < kPacked; ++k) sh[k] += weight * source[k];
        }
        const glm::vec3 normal(block.nx[i], block.ny[i], block.nz[i]);
        args.out->r[i] = irradianceFromCell({sh[0], sh[4], sh[8], sh[12]}, normal, toIrradiance);
        args.out->g[i] = irradianceFromCell({sh[1], sh[5], sh[9], sh[13]}, normal, toIrradiance);
        args.out->b[i] = irradianceFromCell({sh[2], sh[6], sh[10], sh[14]}, normal, toIrradiance);
    }
}

void resize(Lpv::Field& field, size_t count)
{
    for (auto& channel : field)
        for (auto& coefficient : channel) coefficient.assign(count, 0.0f);
}

} // namespace

LpvGrid::LpvGrid(const Bounds& bounds, int size)
{
    const glm::vec3 extent = bounds.extent();
    const float longest = std::max({extent.x, extent.y, extent.z, 1e-3f});
    cell = longest / static_cast<float>(size);
    cells = glm::ivec3(glm::ceil(extent / cell - 1e-4f)) + 2;
    cells = glm::max(cells, glm::ivec3(3));
    origin = bounds.centre() - 0.5f * cell * glm::vec3(cells);
}

glm::ivec3 LpvGrid::cellAt(glm::vec3 world) const
{
    return cellHolding(world, origin, cell, cells);
}

Lpv::Lpv(const LpvGrid& grid) : grid_(grid)
{
    resize(travelling_, grid_.count());
    resize(arriving_, grid_.count());
    resize(accumulated_, grid_.count());
    for (auto& axis : faceCoverage_)
        for (auto& coefficient : axis) coefficient.assign(grid_.count(), 0.0f);
}

Lpv::Lpv(const LpvGrid& grid, Field accumulated) : grid_(grid), accumulated_(std::move(accumulated))
{
    finish();
}

void Lpv::block(std::span<const Blocker> blockers)
{
    // Corners between cells: corner (i, j, k) is the upper corner of cell (i, j, k).
    std::vector<glm::vec4> corners(grid_.count(), glm::vec4(0.0f));
    for (const Blocker& b : blockers) {
        const glm::ivec3 at = grid_.cellAt(b.position - 0.5f * grid_.cell);
        corners[grid_.indexOf(at)] += b.area / (grid_.cell * grid_.cell) * shLobe(b.normal);
    }
    // A face lies between four corners.
    const auto stepY = static_cast<size_t>(grid_.cells.x);
    const size_t stepZ = stepY * static_cast<size_t>(grid_.cells.y);
    const size_t step[3] = {1, stepY, stepZ};
    for (size_t axis = 0; axis < 3; ++axis) {
        const size_t a = step[(axis + 1) % 3];
        const size_t b = step[(axis + 2) % 3];
        forEachChunk(grid_.count(), 4096, [&](size_t begin, size_t end) {
            for (size_t i = std::max(begin, a + b); i < end; ++i) {
                const glm::vec4 cover =
                    0.25f * (corners[i] + corners[i - a] + corners[i - b] + corners[i - a - b]);
                for (int k = 0; k < 4; ++k)
                    faceCoverage_[axis][static_cast<size_t>(k)][i] = cover[k];
            }
        });
    }
}

void Lpv::inject(std::span<const BounceLight> lights)
{
    std::vector<size_t> cells(lights.size());
    forEachChunk(lights.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            cells[i] = grid_.indexOf(
                grid_.cellAt(lights[i].position + 0.5f * grid_.cell * lights[i].normal));
    });
    // A channel a task: sums are made in the order of the lights, whatever the number of threads.
    forEach(3, [&](size_t c) {
        for (size_t i = 0; i < lights.size(); ++i) {
            const glm::vec4 sh =
                lights[i].flux[static_cast<int>(c)] / kPi * shLobe(lights[i].normal);
            for (int k = 0; k < 4; ++k) travelling_[c][static_cast<size_t>(k)][cells[i]] += sh[k];
        }
    });
    accumulated_ = travelling_;
}

void Lpv::propagate(bool first, InstructionSet set)
{
    static const std::array<Source, 6> sources = makeSources();
    const PropagateArgs args{&grid_,         &travelling_, &arriving_, &accumulated_,
                             &faceCoverage_, &sources,     !first};
    forEachChunk(static_cast<size_t>(grid_.cells.z - 2), 1, [&](size_t begin, size_t end) {
        const Slab slab{static_cast<int>(begin) + 1, static_cast<int>(end) + 1};
        runKernel<propagateKernel>(set, args, slab);
    });
    std::swap(travelling_, arriving_);
}

void Lpv::finish()
{
    packed_.assign(kPacked * grid_.count(), 0.0f);
    forEachChunk(grid_.count(), 2048, [&](size_t begin, size_t end) {
        for (size_t c = 0; c < 3; ++c)
            for (size_t k = 0; k < 4; ++k)
                for (size_t i = begin; i < end; ++i)
                    packed_[kPacked * i + 4 * k + c] = accumulated_[c][k][i];
    });
}

void Lpv::irradiance(const TexelBlock& block, RgbBlock& out, InstructionSet set) const
{
    const ReadOutArgs args{&grid_, packed_.data(), &block, &out};
    runKernel<readOutKernel>(set, args);
}

} // namespace relamp
