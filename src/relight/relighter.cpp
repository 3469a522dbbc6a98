#include "base/fail.h"
#include "fit/correction_map.h"
#include "lights/fixture_map.h"
#include "relight/by_lpv.h"
#include "relight/by_paths.h"
#include "relight/relighter_state.h"
#include "relight/relit_page.h"
#include "relight/room_transport.h"
#include "relight/window_openings.h"
#include "scan/overlap.h"
#include "shading/enclosed_texels.h"
#include "solve/find_room.h"

#include "relamp/error.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace relamp
{
namespace
{

const RelightOptions& checked(const RelightOptions& options)
{
    const bool wantsGpu = options.engine.engine == Engine::gpu || !options.engine.gpu.empty();
    if (wantsGpu && options.solver != Solver::gather)
        throw Error(ErrorCode::unsupported,
                    "the GPU follows the bounces of the solver gather alone: leave --engine and "
                    "--gpu out, or take --solver gather");
    return options;
}

void checkSizes(const Scan& scan, std::span<const Image> albedo, std::span<const Image> confidence)
{
    for (size_t p = 0; p < scan.pages.size(); ++p) {
        const Image& page = scan.pages[p].image;
        const auto isSame = [&](std::span<const Image> images) {
            return p < images.size() && images[p].width == page.width &&
                   images[p].height == page.height;
        };
        if (!isSame(albedo) || (!confidence.empty() && !isSame(confidence)))
            throw Error(ErrorCode::sizeMismatch,
                        fmt::format("texture {} of the scan is {} x {}, its albedo is not; it "
                                    "belongs to another scan",
                                    p, page.width, page.height));
    }
}

void checkMaps(const DelitRoom& room)
{
    const auto fits = [](const FixtureMap& map, const Page& page) {
        return map.width == page.image.width && map.height == page.image.height &&
               map.id.size() == page.image.pixels();
    };
    if (!room.fixtures.empty() && !std::ranges::equal(room.fixtures, room.scan->pages, fits))
        fail(ErrorCode::sizeMismatch,
             room.folder.empty() ? "the room" : (room.folder / "fixtures*.png").string(),
             "the map of fixtures has another size than the room's texture, so it belongs to "
             "another scan; let relamp delight write the folder anew, with --force");
}

Texels checkedTexels(const DelitRoom& room, const RayScene& scene, Progress& progress)
{
    checkSizes(*room.scan, room.albedo, room.confidence);
    checkMaps(room);
    Texels texels = rasterizeAtlas(*room.scan, progress, surfelsOf(room.gather));
    checkOverlap(texels);
    separateEnclosed(texels, scene, progress);
    return texels;
}

void addNoteOfEngine(const RadiosityLight& radiosity, std::vector<std::string>& warnings)
{
    if (!radiosity.noteOfEngine().empty()) warnings.push_back(radiosity.noteOfEngine());
}

} // namespace

Relighter::State::State(const DelitRoom& of, const RelightOptions& with, Progress& progress)
    : room(of), options(checked(with)), scene(*of.scan), texels(checkedTexels(of, scene, progress)),
      radiance(collectRadiance(texels, progress, burntOutBy(of.fixtures))),
      lit(correctionBy(of.correction, texels, of.folder)),
      surfaces(surfacesOfRoom(of, {texels, scene, radiance}, warningsOfRoom)),
      transport(transportOfRoom({texels, scene, radiance}, with, warningsOfRoom, progress)),
      open(std::make_shared<const TexelMarks>(openShares(texels, scene))), painted(of.albedo),
      albedo(texels, of.albedo, of.confidence, radiance.isClipped),
      isOpening(likelyWindowOpenings(scene, surfaces)),
      radiosity(texels, scene, transport, radiance.isClipped, lit, with)
{}

ActiveLights Relighter::State::activeUnder(const Relighting& lighting) const
{
    return activate(texels, {room.captured, surfaces},
                    withWindowOpenings(lighting, room.captured, isOpening));
}

Relighter::Relighter(const DelitRoom& room, const RelightOptions& options, Progress& progress)
    : state_(std::make_unique<State>(room, options, progress))
{}

Relighter::~Relighter() = default;
Relighter::Relighter(Relighter&&) noexcept = default;
Relighter& Relighter::operator=(Relighter&&) noexcept = default;

void Relighter::repaint(std::span<const Image> albedo, std::span<const Image> confidence)
{
    State& state = *state_;
    checkSizes(*state.room.scan, albedo, confidence);
    state.albedo = RoomAlbedo(state.texels, albedo, confidence, state.radiance.isClipped);
    state.painted = albedo;
    state.shade = {};
}

void Relighter::glance(const Relighting& lighting, Progress& progress)
{
    State& state = *state_;
    if (state.options.solver != Solver::gather) return light(lighting, progress);
    state.warnings = state.warningsOfRoom;
    state.active = state.activeUnder(lighting);
    state.radiosity.set(state.active, reflecting(state), ShadowDetail::sides, progress);
    state.shade = {};
    addNoteOfEngine(state.radiosity, state.warnings);
}

void Relighter::light(const Relighting& lighting, Progress& progress)
{
    State& state = *state_;
    state.warnings = state.warningsOfRoom;
    state.active = state.activeUnder(lighting);
    switch (state.options.solver) {
    case Solver::gather:
        state.radiosity.set(state.active, reflecting(state), ShadowDetail::texels, progress);
        state.shade = withRims(
            state.texels, state.radiosity.shading(),
            rimsOf(state.texels.surfels, state.radiance, state.radiosity.onFronts()), state.open);
        break;
    case Solver::thesis:
        state.shade = shadingByLpv(state, state.warnings, progress);
        break;
    case Solver::pathtrace:
        state.shade = shadingByPaths(state);
        break;
    }
    addNoteOfEngine(state.radiosity, state.warnings);
}

Image Relighter::radiance(size_t page, Progress& progress) const
{
    return relitPage(*state_, page, progress);
}

Image Relighter::shading(size_t page, int longestSide, Progress& progress) const
{
    return shadingPage(*state_, page, longestSide, progress);
}

const DelitRoom& Relighter::room() const
{
    return state_->room;
}

const std::vector<std::string>& Relighter::warnings() const
{
    return state_->warnings;
}

const Relighter::State& Relighter::state() const
{
    return *state_;
}

std::vector<Image> relight(const DelitRoom& room, const Relighting& lighting,
                           const RelightOptions& options, Progress& progress)
{
    Relighter relighter(room, options, progress);
    relighter.light(lighting, progress);
    std::vector<Image> pages;
    for (size_t p = 0; p < room.scan->pages.size(); ++p)
        pages.push_back(relighter.radiance(p, progress));
    return pages;
}

} // namespace relamp
