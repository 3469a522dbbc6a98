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

/// A number for each of some cells that lie side by side.
struct alignas(64) Lanes
{
    float of[kLanes];
};
using Harmonics = std::array<Lanes, 4>;
using Intensity = std::array<Harmonics, 3>;

void load(const std::array<std::vector<float>, 4>& rows, size_t at, size_t count, Harmonics& lanes)
{
    for (size_t k = 0; k < 4; ++k) std::copy_n(rows[k].data() + at, count, lanes[k].of);
}

glm::vec4 at(const Harmonics& lanes, size_t lane)
{
    return {lanes[0].of[lane], lanes[1].of[lane], lanes[2].of[lane], lanes[3].of[lane]};
}

/// Light that comes through one face, of which the normal is along `axis`.
template<int axis, bool blocking>
void gatherFace(const Face& face, const Intensity& in, const Harmonics& coverage, Intensity& out)
{
    // The lobe of an axis has two coefficients that are not zero: the first, and the axis's own.
    constexpr size_t own = axis == 0 ? 3 : axis;
    const glm::vec4 lobe = face.solidAngle / kPi * shLobe(face.normal);
    const float alongAxis = lobe[own];
    Lanes open;
    for (size_t lane = 0; lane < kLanes; ++lane)
        open.of[lane] = blocking ? 1.0f - blocked(at(coverage, lane), face.direction) : 1.0f;
    for (size_t c = 0; c < 3; ++c)
        for (size_t lane = 0; lane < kLanes; ++lane) {
            const float passed = sentTowards(at(in[c], lane), face.direction) * open.of[lane];
            out[c][0].of[lane] += passed * lobe.x;
            out[c][own].of[lane] += passed * alongAxis;
        }
}

/// Light from the neighbours on one side, through the five faces of each.
template<int axis, bool blocking>
void gatherSource(const Source& source, const Intensity& in, const Harmonics& coverage,
                  Intensity& out)
{
    constexpr int aside = axis == 0 ? 1 : 0; // as faceNormal() has them
    constexpr int asideToo = axis == 2 ? 1 : 2;
    gatherFace<axis, blocking>(source.faces[0], in, coverage, out);
    gatherFace<aside, blocking>(source.faces[1], in, coverage, out);
    gatherFace<aside, blocking>(source.faces[2], in, coverage, out);
    gatherFace<asideToo, blocking>(source.faces[3], in, coverage, out);
    gatherFace<asideToo, blocking>(source.faces[4], in, coverage, out);
}

template<bool blocking>
void gatherFrom(const PropagateArgs& args, const Source& source, size_t cell, size_t count,
                Intensity& out)
{
    const LpvGrid& grid = *args.grid;
    const auto offset =
        source.step.x + grid.cells.x * (source.step.y + grid.cells.y * source.step.z);
    const size_t from = cell + static_cast<size_t>(static_cast<ptrdiff_t>(offset));
    Intensity in{};
    for (size_t c = 0; c < 3; ++c) load((*args.from)[c], from, count, in[c]);
    // Coverage is stored at the lower of the two cells that a face parts.
    Harmonics coverage{};
    load((*args.coverage)[static_cast<size_t>(source.axis)],
         source.step[source.axis] < 0 ? from : cell, count, coverage);
    if (source.axis == 0) gatherSource<0, blocking>(source, in, coverage, out);
    if (source.axis == 1) gatherSource<1, blocking>(source, in, coverage, out);
    if (source.axis == 2) gatherSource<2, blocking>(source, in, coverage, out);
}

/// Light that `count` cells from `cell` on get from all neighbours; at most kLanes.
void gatherCells(const PropagateArgs& args, size_t cell, size_t count)
{
    Intensity out{};
    for (const Source& source : *args.sources)
        args.blocking ? gatherFrom<true>(args, source, cell, count, out)
                      : gatherFrom<false>(args, source, cell, count, out);
    for (size_t c = 0; c < 3; ++c)
        for (size_t k = 0; k < 4; ++k)
            std::copy_n(out[c][k].of, count, (*args.to)[c][k].data() + cell);
}

void propagateKernel(const PropagateArgs& args, const Slab& slab)
{
    const LpvGrid& grid = *args.grid;
    const auto count = static_cast<size_t>(grid.cells.x - 2);
    const size_t most = std::min(count, kLanes);
    for (int z = slab.firstZ; z < slab.endZ; ++z)
        for (int y = 1; y + 1 < grid.cells.y; ++y) {
            const size_t row = grid.indexOf({1, y, z});
            // The last cells of a row come with some that have been gathered before.
            for (size_t first = 0; first < count; first += most) {
                const size_t cell = row + std::min(first, count - most);
                // A count that the compiler knows is a vector register.
                most == kLanes ? gatherCells(args, cell, kLanes) : gatherCells(args, cell, most);
            }
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

/// The packed cells around the texels of a block, from `first` on, each as much as it is near.
void mixCells(const ReadOutArgs& args, const Lookups& at, size_t first, size_t count,
              float (&mixed)[kLanes][kPacked])
{
    const LpvGrid& grid = *args.grid;
    const auto stepY = static_cast<size_t>(grid.cells.x);
    const size_t stepZ = stepY * static_cast<size_t>(grid.cells.y);
    const size_t corner[8] = {0,     1,         stepY,         stepY + 1,
                              stepZ, stepZ + 1, stepZ + stepY, stepZ + stepY + 1};
    for (size_t lane = 0; lane < count; ++lane) {
        const size_t i = first + lane;
        const float x[2] = {1.0f - at.x[i], at.x[i]};
        const float y[2] = {1.0f - at.y[i], at.y[i]};
        const float z[2] = {1.0f - at.z[i], at.z[i]};
        const float* __restrict source = args.packed + kPacked * static_cast<size_t>(at.cell[i]);
        float weight[8];
        for (size_t c = 0; c < 8; ++c) weight[c] = x[c & 1] * y[c >> 1 & 1] * z[c >> 2];
        float* __restrict out = mixed[lane];
        for (size_t k = 0; k < kPacked; ++k) {
            float sum = 0.0f;
            for (size_t c = 0; c < 8; ++c) sum += weight[c] * source[kPacked * corner[c] + k];
            out[k] = sum;
        }
    }
}

void readOutKernel(const ReadOutArgs& args)
{
    const TexelBlock& block = *args.block;
    Lookups at;
    lookUp(*args.grid, block, at);
    const float toIrradiance = 4.0f / (args.grid->cell * args.grid->cell);
    alignas(64) float sh[kLanes][kPacked] = {};
    for (size_t first = 0; first < block.count; first += kLanes) {
        mixCells(args, at, first, std::min(kLanes, block.count - first), sh);
        alignas(64) float rgb[kLanes][4];
        for (size_t lane = 0; lane < kLanes; ++lane) {
            const size_t i = first + lane;
            const glm::vec3 normal(block.nx[i], block.ny[i], block.nz[i]);
            for (size_t c = 0; c < 4; ++c)
                rgb[lane][c] = irradianceFromCell(
                    {sh[lane][c], sh[lane][4 + c], sh[lane][8 + c], sh[lane][12 + c]}, normal,
                    toIrradiance);
        }
        for (size_t lane = 0; lane < kLanes; ++lane) {
            args.out->r[first + lane] = rgb[lane][0];
            args.out->g[first + lane] = rgb[lane][1];
            args.out->b[first + lane] = rgb[lane][2];
        }
    }
}

/// Indices of the cells that `cellAt(i)` gives.
template<class CellAt>
std::vector<size_t> cellsOf(const LpvGrid& grid, size_t count, const CellAt& cellAt)
{
    std::vector<size_t> cells(count);
    forEachChunk(count, 1024, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) cells[i] = grid.indexOf(cellAt(i));
    });
    return cells;
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
    const std::vector<size_t> cells = cellsOf(grid_, blockers.size(), [&](size_t i) {
        return grid_.cellAt(blockers[i].position - 0.5f * grid_.cell);
    });
    std::vector<glm::vec4> corners(grid_.count(), glm::vec4(0.0f));
    for (size_t i = 0; i < blockers.size(); ++i)
        corners[cells[i]] +=
            blockers[i].area / (grid_.cell * grid_.cell) * shLobe(blockers[i].normal);
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
    const std::vector<size_t> cells = cellsOf(grid_, lights.size(), [&](size_t i) {
        return grid_.cellAt(lights[i].position + 0.5f * grid_.cell * lights[i].normal);
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
