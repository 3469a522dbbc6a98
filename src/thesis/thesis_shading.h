#pragma once

#include "base/kept.h"
#include "relamp/lights.h"
#include "relamp/progress.h"
#include "relamp/thesis.h"
#include "scan/rays.h"
#include "scan/texels.h"
#include "shading/texel_shading.h"
#include "thesis/direct.h"
#include "thesis/emitters.h"
#include "thesis/flatten.h"
#include "thesis/lpv.h"

#include <memory>
#include <span>
#include <vector>

namespace relamp
{

/// Choi's shading of a room: lights without shadows, bounce light by RSM and LPV, and ambient
/// light.
struct ThesisShading
{
    ThesisOptions parameters; // with everything that was derived filled in
    LightArrays lights;       // before `parameters.power`
    glm::vec3 ambient{0.0f};
    std::shared_ptr<const Lpv> bounce; // before `parameters.power`; null without bounce light
};

/// Irradiance becomes shading, under the parameters power and ambient.
void toShading(RgbBlock& block, size_t count, float power, glm::vec3 ambient);

/// Shading at the texels of a block. Entries behind its last texel are unspecified.
void shade(const ThesisShading& shading, const TexelBlock& block, ShadingBlock& out);

/// The lights that cast a reflective shadow map each.
std::vector<PointLight> lightsOfShadowMaps(const Lights& lights, const ThesisOptions& parameters);

/// Fills in the parameters that follow from the lights and the size of the room: attenuation, merge
/// distance.
ThesisOptions deriveParameters(const ThesisOptions& parameters, const Lights& lights,
                               const Bounds& room);

/// Spreads the light that surfaces pass on: `leaving` is what arrived, multiplied by a colour.
std::shared_ptr<const Lpv> spread(const Texels& texels, std::span<const BounceLight> leaving,
                                  const ThesisOptions& parameters);

/// The CPU's stages, again and again: one runs where something that it depends on is not as it was.
class ThesisStages
{
public:
    /// Both must outlive this.
    ThesisStages(const Texels& texels, const RayScene& scene) : texels_(texels), scene_(scene) {}

    /// The whole shading but power and ambient, which stay as `parameters` has them: flattened
    /// texture, reflective shadow maps of the merged lights, light propagation volume.
    ThesisShading solve(const Lights& lights, const ThesisOptions& parameters, Progress& progress);

private:
    [[nodiscard]] std::shared_ptr<const Lpv>
    bounce(const Lights& lights, const ThesisOptions& parameters, Progress& progress);

    const Texels& texels_;
    const RayScene& scene_;
    Kept<std::vector<float>, Flattened> flattened_;
    Kept<std::vector<float>, std::shared_ptr<const Lpv>> bounce_;
};

/// Once.
ThesisShading solveThesis(const Texels& texels, const RayScene& scene, const Lights& lights,
                          const ThesisOptions& parameters, Progress& progress);

} // namespace relamp
