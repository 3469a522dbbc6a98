#include "relight/by_paths.h"

#include "base/radiometry.shared.h"
#include "lights/lamp_surface.h"
#include "relight/relit_page.h"
#include "relight/sky_bins.h"
#include "shading/path_tracer.h"
#include "solve/by_pathtrace.h"

#include <memory>
#include <utility>

namespace relamp
{
namespace
{

/// Lights that somebody put up: rays pass them by.
class UnseenLights
{
public:
    explicit UnseenLights(const Relighter::State& state)
        : walls_(state.texels, state.scene, {}, state.radiance.isClipped),
          windowOpenings_(state.active.windowOpenings),
          wallsWithOpenings_(state.texels, state.scene, windowOpenings_, state.radiance.isClipped)
    {
        for (const ActiveLight& light : state.active.lights)
            if (!light.isFixture) lights_.push_back(light);
    }
    UnseenLights(const UnseenLights&) = delete;
    UnseenLights& operator=(const UnseenLights&) = delete;

    [[nodiscard]] glm::vec3 at(const TexelSite& place, Random& random) const
    {
        const glm::vec3 origin = place.position + kOffSurface * place.normal;
        glm::vec3 sum(0.0f);
        for (const ActiveLight& light : lights_) {
            const float share = random.next();
            const glm::vec2 u{random.next(), random.next()};
            const Look look = light.source->look(origin, place.normal, share, u);
            if (look.irradiance <= 0.0f) continue;
            const Ray ray{.origin = origin, .direction = look.direction, .farthest = look.distance};
            uint8_t blocked = 0;
            (light.source->isSun() ? wallsWithOpenings_ : walls_).blocked({&ray, 1}, {&blocked, 1});
            if (blocked == 0) sum += look.irradiance / kPi * light.emission;
        }
        return sum;
    }

private:
    Obstacles walls_;
    std::vector<uint8_t> windowOpenings_;
    Obstacles wallsWithOpenings_;
    std::vector<ActiveLight> lights_;
};

TracedRoom tracedRoomOf(const Relighter::State& state)
{
    std::vector<Shiner> shiners;
    for (const ActiveLight& light : state.active.lights)
        if (light.isFixture) shiners.push_back({light.surface, light.emission});
    TracedRoom room{.albedo = reflecting(state),
                    .shines = state.active.shines,
                    .emission = state.active.emission,
                    .isClipped = state.radiance.isClipped,
                    .lamps = LampSurface(lampTexels(state.texels, state.radiance, shiners)),
                    .ambient = glm::vec3(1.0f),
                    .outside = {},
                    .unseenLights = {}};
    room.outside = [sky = state.active.sky](glm::vec3 direction) {
        return sky[SkyBins::of(direction)];
    };
    const auto unseen = std::make_shared<const UnseenLights>(state);
    room.unseenLights = [unseen](const TexelSite& place, Random& random) {
        return unseen->at(place, random);
    };
    return room;
}

} // namespace

TexelShading shadingByPaths(const Relighter::State& state)
{
    const auto room = std::make_shared<const TracedRoom>(tracedRoomOf(state));
    return shadingOf(state.texels, state.scene, room, state.options.pathtrace);
}

} // namespace relamp
