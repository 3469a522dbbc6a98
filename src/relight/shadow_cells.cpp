#include "relight/shadow_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr double kSide = 0.006;      // m
constexpr float kOneFace = 0.7f;     // cosine: a corner of a room is none
constexpr float kWayBeside = 0.018f; // m between middles of cells beside each other: 3 kSide
constexpr size_t kSampled = 1000;    // texels
constexpr double kMostOf = 0.9;      // of them are finer than what counts as a page's texel

/// Metres along a texel of a page whose charts may differ.
double texelOn(const Texels& texels, size_t page)
{
    const std::vector<uint32_t>& facet = texels.pages[page].facet;
    std::vector<float> areas;
    const size_t step = std::max<size_t>(facet.size() / kSampled, 1);
    for (size_t i = 0; i < facet.size(); i += step)
        areas.push_back(texels.facets.facets[facet[i]].texelArea);
    const auto most =
        areas.begin() + static_cast<std::ptrdiff_t>(kMostOf * static_cast<double>(areas.size()));
    std::nth_element(areas.begin(), most, areas.end());
    return std::sqrt(static_cast<double>(*most));
}

/// How many pixels are about kSide.
uint32_t sideOn(const Texels& texels, size_t page)
{
    const Page& picture = texels.scan->pages[page];
    if (picture.ofVertices || texels.pages[page].count() == 0) return 1;
    const double texel = texelOn(texels, page);
    const double most = std::max(picture.image.width, picture.image.height);
    return texel > 0.0 ? static_cast<uint32_t>(std::clamp(std::round(kSide / texel), 1.0, most))
                       : 1;
}

} // namespace

ShadowCells::ShadowCells(const Texels& texels, size_t page, std::span<const uint32_t> runs)
    : texels_(texels), index_(page), page_(texels.pages[page]),
      width_(static_cast<uint32_t>(texels.scan->pages[page].image.width)),
      side_(sideOn(texels, page)), squaresAcross_((width_ + side_ - 1) / side_),
      squaresDown_((static_cast<uint32_t>(texels.scan->pages[page].image.height) + side_ - 1) /
                   side_)
{
    size_t count = 0;
    for (const uint32_t run : runs) count += page_.runs[run + 1].begin - page_.runs[run].begin;
    order_.reserve(count);
    for (const uint32_t run : runs)
        for (uint32_t texel = page_.runs[run].begin; texel < page_.runs[run + 1].begin; ++texel)
            order_.push_back({texel, run});
    if (side_ > 1) {
        sortBySquare();
        return;
    }
    first_.resize(count + 1);
    std::iota(first_.begin(), first_.end(), 0u);
    run_.reserve(count);
    for (const Texel& texel : order_) run_.push_back(texel.run);
}

uint32_t ShadowCells::squareOf(const Texel& texel) const
{
    const uint32_t pixel = page_.pixel[texel.index];
    return pixel / width_ / side_ * squaresAcross_ + pixel % width_ / side_;
}

bool ShadowCells::areOfOneFace(uint32_t run, uint32_t other) const
{
    const Surfels& surfels = texels_.surfels;
    const uint32_t a = page_.runs[run].surfel;
    const uint32_t b = page_.runs[other].surfel;
    return a == b ||
           (surfels.areBeside(a, b) && glm::dot(surfels.normal[a], surfels.normal[b]) > kOneFace);
}

bool ShadowCells::areBeside(uint32_t cell, uint32_t other) const
{
    return glm::distance(middle_[cell], middle_[other]) < kWayBeside &&
           areOfOneFace(run_[cell], run_[other]);
}

void ShadowCells::add(size_t first, uint32_t run, uint32_t square, glm::vec3 middle)
{
    first_.push_back(static_cast<uint32_t>(first));
    run_.push_back(run);
    square_.push_back(square);
    middle_.push_back(middle);
}

/// Those of a square stay in the order of their surfels. Those of another face than its middle one
/// become cells by themselves, and so do all where the page's texels are wider than most: they
/// stand apart.
void ShadowCells::sortBySquare()
{
    std::vector<uint32_t> end(size_t{squaresAcross_} * squaresDown_ + 1, 0);
    for (const Texel& texel : order_) ++end[squareOf(texel) + 1];
    for (size_t square = 1; square < end.size(); ++square) end[square] += end[square - 1];
    std::vector<Texel> sorted(order_.size());
    for (const Texel& texel : order_) sorted[end[squareOf(texel)]++] = texel; // now its end
    order_ = std::move(sorted);

    inSquare_.assign(end.size() - 1, kNone);
    for (uint32_t square = 0, begin = 0; square + 1 < end.size(); begin = end[square++]) {
        if (begin == end[square]) continue;
        const std::span all = std::span(order_).subspan(begin, end[square] - begin);
        const Texel middle = all[all.size() / 2];
        const glm::vec3 place = texels_.siteOf(index_, middle.index).position;
        const auto isOwn = [&](const Texel& texel) {
            return areOfOneFace(middle.run, texel.run) &&
                   glm::distance(texels_.siteOf(index_, texel.index).position, place) < kWayBeside;
        };
        const float texel = std::sqrt(texels_.facets.facets[page_.facet[middle.index]].texelArea);
        auto apart = all.end();
        if (static_cast<float>(side_) * texel > 2.0f * static_cast<float>(kSide))
            apart = all.begin();
        else if (all.front().run != all.back().run)
            apart = std::stable_partition(all.begin(), all.end(), isOwn);
        if (apart != all.begin()) {
            inSquare_[square] = static_cast<uint32_t>(first_.size());
            add(begin, middle.run, square, place);
        }
        for (; apart != all.end(); ++apart)
            add(begin + static_cast<size_t>(apart - all.begin()), apart->run, kNone, place);
    }
    first_.push_back(static_cast<uint32_t>(order_.size()));
}

size_t ShadowCells::around(size_t cell, uint32_t* cells) const
{
    if (inSquare_.empty() || square_[cell] == kNone) return 0;
    const uint32_t column = square_[cell] % squaresAcross_;
    const uint32_t row = square_[cell] / squaresAcross_;
    size_t count = 0;
    for (uint32_t y = std::max(row, 1u) - 1; y <= std::min(row + 1, squaresDown_ - 1); ++y)
        for (uint32_t x = std::max(column, 1u) - 1; x <= std::min(column + 1, squaresAcross_ - 1);
             ++x) {
            const uint32_t other = inSquare_[size_t{y} * squaresAcross_ + x];
            if (other == kNone || other == cell || !areBeside(static_cast<uint32_t>(cell), other))
                continue;
            cells[count++] = other;
        }
    return count;
}

size_t ShadowCells::between(size_t cell, const Texel& texel, uint32_t* cells, float* weights) const
{
    if (inSquare_.empty() || square_[cell] == kNone) return 0;
    const uint32_t pixel = page_.pixel[texel.index];
    // In squares, from the middle of the first.
    const auto along = [&](uint32_t at) {
        return (static_cast<float>(at) + 0.5f) / static_cast<float>(side_) - 0.5f;
    };
    const float x = along(pixel % width_);
    const float y = along(pixel / width_);
    const float left = std::floor(x);
    const float top = std::floor(y);
    size_t count = 0;
    float sum = 0.0f;
    for (int corner = 0; corner < 4; ++corner) {
        const float column = left + static_cast<float>(corner % 2);
        const float row = top + static_cast<float>(corner / 2);
        if (column < 0.0f || row < 0.0f || column >= static_cast<float>(squaresAcross_) ||
            row >= static_cast<float>(squaresDown_))
            continue;
        const uint32_t other =
            inSquare_[static_cast<size_t>(row) * squaresAcross_ + static_cast<size_t>(column)];
        if (other == kNone || !areBeside(static_cast<uint32_t>(cell), other)) continue;
        cells[count] = other;
        weights[count] = (1.0f - std::abs(x - column)) * (1.0f - std::abs(y - row));
        sum += weights[count++];
    }
    for (size_t i = 0; i < count; ++i) weights[i] /= sum;
    return count;
}

} // namespace relamp
