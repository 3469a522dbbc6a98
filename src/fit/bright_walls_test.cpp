#include "fit/bright_walls.h"

#include "base/radiometry.shared.h"
#include "scenes/lit_room.h"
#include "scenes/surfaces.h"

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using scenes::LitRoom;

/// The room's panel, then the sheet that it burns out, as lamps to be; and no other light.
struct PanelAndSheet
{
    scenes::Surfaces room{LitRoom().scan};
    HitLists hits = scenes::hitListsOf(room, 16);
    std::vector<Candidate> lamps = findCandidates(room.texels, room.radiance);
    RadianceField field = fieldOf(room.radiance);
    size_t panel = nearestTo(lamps, LitRoom::kLampCentre);
    size_t sheet = nearestTo(lamps, LitRoom::kSheetCentre);

    PanelAndSheet()
    {
        for (auto* light : {&field.plain, &field.clipped, &field.back})
            std::fill(light->begin(), light->end(), glm::vec3(0.0f));
    }

    /// Luminance of a wall instead of one, where the panel and the sheet have these radiances.
    [[nodiscard]] float insteadOf(size_t lamp, glm::vec3 ofPanel, glm::vec3 ofSheet) const
    {
        std::vector<std::span<const ClippedPatch>> patches;
        for (const Candidate& candidate : lamps) patches.emplace_back(candidate.patches);
        const BrightWalls walls(room.texels, room.rays, hits, patches);
        std::vector<glm::vec3> radiances(lamps.size(), glm::vec3(0.0f));
        radiances[panel] = ofPanel;
        radiances[sheet] = ofSheet;
        return walls.insteadOf(lamp, field, glm::vec3(0.0f), radiances);
    }
};

} // namespace

TEST(BrightWalls, AreAsBrightAsTheOtherLampMakesThem)
{
    const PanelAndSheet all;
    const AreaSample light =
        sampleAreaLight(all.room.rays, AreaLight(all.lamps[all.panel].patches),
                        LitRoom::kSheetCentre, glm::vec3(1.0f, 0.0f, 0.0f), 1024, 0.5f);
    const float expected = 0.75f * luminance(light.visible * LitRoom::kLampRadiance) / kPi;
    EXPECT_GT(expected, 0.8f); // with the bounce light it is burnt out
    const float found = all.insteadOf(all.sheet, LitRoom::kLampRadiance, glm::vec3(0.0f));
    EXPECT_NEAR(found / expected, 1.0f, 0.2f);
}

TEST(BrightWalls, AreNotLitByTheLampInTheirPlace)
{
    const PanelAndSheet all;
    EXPECT_EQ(all.insteadOf(all.panel, LitRoom::kLampRadiance, glm::vec3(0.0f)), 0.0f);
    EXPECT_GT(all.insteadOf(all.panel, LitRoom::kLampRadiance, glm::vec3(1.0f)), 0.0f);
}

} // namespace relamp
