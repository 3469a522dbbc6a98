#include "lights/fixture_map.h"

#include "image/burnt_out.shared.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace relamp
{
namespace
{

/// What the burnt-out texels of a surfel say, by whose they are.
struct Vote
{
    uint32_t surfel;
    int32_t fixture;
    size_t texels;
};

/// Looks up pixels of a page in a map that may be of another size.
class MapOfPage
{
public:
    MapOfPage(const FixtureMap& map, const Image& page)
        : map_(map), width_(static_cast<size_t>(page.width)),
          height_(static_cast<size_t>(page.height))
    {}

    [[nodiscard]] int32_t at(uint32_t pixel) const
    {
        const size_t x =
            (2 * (pixel % width_) + 1) * static_cast<size_t>(map_.width) / (2 * width_);
        const size_t y =
            (2 * (pixel / width_) + 1) * static_cast<size_t>(map_.height) / (2 * height_);
        return map_.id[y * static_cast<size_t>(map_.width) + x];
    }

private:
    const FixtureMap& map_;
    size_t width_;
    size_t height_;
};

void addVotes(const FixtureMap& map, const Texels& texels, size_t p,
              const std::vector<bool>& isClipped, std::vector<Vote>& votes)
{
    const MapOfPage fixtures(map, texels.scan->pages[p].image);
    const PageTexels& page = texels.pages[p];
    for (size_t run = 0; run + 1 < page.runs.size(); ++run) {
        const uint32_t surfel = page.runs[run].surfel;
        const size_t first = votes.size();
        for (size_t i = page.runs[run].begin; i < page.runs[run + 1].begin; ++i) {
            const uint32_t pixel = page.pixel[i];
            if (!isClipped[pixel]) continue;
            const int32_t fixture = fixtures.at(pixel);
            const auto same =
                std::find_if(votes.begin() + static_cast<std::ptrdiff_t>(first), votes.end(),
                             [fixture](const Vote& vote) { return vote.fixture == fixture; });
            if (same == votes.end())
                votes.push_back({surfel, fixture, 1});
            else
                ++same->texels;
        }
    }
}

/// Of each surfel that is some fixture's, ascending.
std::vector<std::pair<uint32_t, int32_t>> winnersOf(std::vector<Vote> votes)
{
    const auto byFixture = [](const Vote& a, const Vote& b) {
        return std::tie(a.surfel, a.fixture) < std::tie(b.surfel, b.fixture);
    };
    std::sort(votes.begin(), votes.end(), byFixture);
    std::vector<std::pair<uint32_t, int32_t>> winners;
    for (size_t v = 0; v < votes.size();) {
        const uint32_t surfel = votes[v].surfel;
        std::pair<size_t, int32_t> most{0, FixtureMap::kNone};
        while (v < votes.size() && votes[v].surfel == surfel) {
            const int32_t fixture = votes[v].fixture;
            size_t count = 0; // of all pages
            for (; v < votes.size() && votes[v].surfel == surfel && votes[v].fixture == fixture;
                 ++v)
                count += votes[v].texels;
            if (count > most.first) most = {count, fixture};
        }
        if (most.second >= 0) winners.emplace_back(surfel, most.second);
    }
    return winners;
}

} // namespace

FixtureMap fixtureMapOf(const Texels& texels, size_t page, std::span<const int32_t> fixtureOf,
                        const std::vector<bool>& isGlowing)
{
    const Image& image = texels.scan->pages[page].image;
    const float burntOut = image.clipsAtWhite ? kBurntOut : 1.0f;
    FixtureMap map{image.width, image.height, {}};
    map.id.assign(image.pixels(), FixtureMap::kNone);
    const PageTexels& texelsOfPage = texels.pages[page];
    const TexelLoader loader(texels, page);
    forEachRun(texelsOfPage, [&](size_t run, TexelBlock& block) {
        const int32_t fixture = fixtureOf[texelsOfPage.runs[run].surfel];
        forEachBlockOfRun(texelsOfPage, run, [&](size_t begin, size_t count) {
            loader.loadRadiance(begin, count, block);
            for (size_t i = 0; i < count; ++i) {
                const uint32_t pixel = texelsOfPage.pixel[begin + i];
                if (brightestChannel({block.r[i], block.g[i], block.b[i]}) >= burntOut ||
                    (!isGlowing.empty() && isGlowing[pixel]))
                    map.id[pixel] = fixture;
            }
        });
    });
    return map;
}

PixelMarks burntOutBy(std::span<const FixtureMap> maps)
{
    PixelMarks isBurntOut;
    for (const FixtureMap& map : maps) {
        std::vector<bool>& page = isBurntOut.emplace_back(map.id.size());
        std::transform(map.id.begin(), map.id.end(), page.begin(),
                       [](int32_t fixture) { return fixture != FixtureMap::kNone; });
    }
    return isBurntOut;
}

SurfacesOfFixtures surfacesBy(std::span<const FixtureMap> maps, const Texels& texels,
                              const SurfelRadiance& radiance)
{
    std::vector<Vote> votes;
    for (size_t p = 0; p < maps.size(); ++p)
        addVotes(maps[p], texels, p, radiance.isClipped[p], votes);
    SurfacesOfFixtures surfaces;
    auto patch = radiance.clipped.begin();
    for (const auto& [surfel, fixture] : winnersOf(std::move(votes))) {
        while (patch != radiance.clipped.end() && patch->surfel < surfel) ++patch;
        if (patch == radiance.clipped.end()) break;
        if (patch->surfel == surfel) surfaces[fixture].push_back(*patch);
    }
    return surfaces;
}

} // namespace relamp
