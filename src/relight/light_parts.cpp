#include "lights/shining.h"
#include "relamp/lightmaps.h"
#include "relight/relighter_state.h"
#include "relight/window_openings.h"

#include <set>
#include <utility>

#include <fmt/format.h>

namespace relamp
{
namespace
{

/// All that is on in `lighting` switched off; windows stay what they are.
Relighting switchedOff(const Relighting& lighting)
{
    Relighting off = lighting;
    off.windowsAreSaid = true;
    off.lights.clear();
    off.sky = {};
    for (LitFixture& lit : off.fixtures) lit.fixture.radiance = glm::vec3(0.0f);
    return off;
}

std::string unlike(std::string name, std::set<std::string>& taken)
{
    for (int i = 2; !taken.insert(name).second; ++i) name = fmt::format("{} ({})", name, i);
    return name;
}

std::string nameOf(const Lights& captured, const Fixture& fixture, size_t place)
{
    const size_t own = captured.placeOf(fixture.id);
    if (own < captured.fixtures.size()) return captured.nameOf(own);
    return fixture.name.empty() ? fmt::format("fixture {}", place + 1) : fixture.name;
}

} // namespace

std::vector<LightPart> partsOf(const Relighting& lighting, const Relighter& relighter)
{
    const Lights& captured = relighter.room().captured;
    const Relighting all = withWindowOpenings(lighting, captured, relighter.state().isOpening);
    const Relighting off = switchedOff(all);
    std::vector<LightPart> parts;
    std::set<std::string> taken;
    const auto add = [&](const std::string& name) -> LightPart& {
        return parts.emplace_back(LightPart{unlike(name, taken), -1, off});
    };
    for (size_t i = 0; i < all.fixtures.size(); ++i) {
        const Fixture& fixture = all.fixtures[i].fixture;
        if (isDark(fixture.radiance)) continue;
        LightPart& part = add(nameOf(captured, fixture, i));
        part.fixture = captured.placeOf(fixture.id) < captured.fixtures.size() ? fixture.id : -1;
        part.lighting.fixtures[i].fixture = fixture;
    }
    for (const NewLight& light : all.lights) {
        if (isDark(light.emission)) continue;
        LightPart& part = add(light.type == LightType::sun
                                  ? "sun"
                                  : fmt::format("light {}", &light - all.lights.data() + 1));
        part.lighting.lights = {light};
    }
    if (!isDark(all.sky.radiance)) add("sky").lighting.sky = all.sky;
    return parts;
}

} // namespace relamp
