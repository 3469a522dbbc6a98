#pragma once

#include "relamp/progress.h"
#include "relamp/relight.h"
#include "relight/active_lights.h"
#include "relight/glow.h"
#include "relight/obstacles.h"
#include "relight/radiosity_engine.h"
#include "relight/shadows.h"
#include "relight/transport.h"
#include "scan/texels.h"
#include "shading/lamp_sight.h"
#include "shading/texel_shading.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// A light with what it does to the room at emission 1.
struct ShadowedLight
{
    ActiveLight light;
    LampSight onSides;              // by sides of the transport
    std::vector<float> onFronts;    // irradiance on fronts of surfels, without the rays' noise
    std::optional<Shadows> shadows; // on texels; none where only sides were asked for
};

/// A glow with what it does to the room at emission 1.
struct SeenGlow
{
    std::shared_ptr<const ShadowedLight> light;
    Glow glow;
    std::vector<glm::vec3> onFronts; // irradiance, without the rays' noise
};

/// How finely shadows are found.
enum class ShadowDetail { sides, texels };

/// Light in a room by shadow rays and radiosity. What rays found of a light is kept as long as the
/// next relighting has the same light, however bright.
class RadiosityLight
{
public:
    /// `lit`: of surfels, as correctionOf() gives it; empty: nothing is known of that. The
    /// arguments, but for the options, must outlive this. Throws Error(device) as RadiosityEngine.
    RadiosityLight(const Texels& texels, const RayScene& scene, const Transport& transport,
                   std::span<const std::vector<bool>> isClipped, std::span<const float> lit,
                   const RelightOptions& options);

    /// Takes over the light; `albedo` is that of surfels. What comes from the room's own lamps, and
    /// bounces, is as little as it was found to be; the light of others is as the mesh has it.
    void set(const ActiveLights& active, std::span<const glm::vec3> albedo, ShadowDetail detail,
             Progress& progress);

    /// The shading under the light that was set with ShadowDetail::texels. It stays valid when
    /// another is set.
    [[nodiscard]] TexelShading shading() const;

    /// Irradiance on surfels' fronts under the light that was set; empty before.
    [[nodiscard]] std::span<const glm::vec3> onFronts() const { return onFronts_; }

    /// As RadiosityEngine.
    [[nodiscard]] const std::string& noteOfEngine() const { return engine_.note(); }

private:
    void findShadows(const ActiveLights& active, ShadowDetail detail, Progress& progress);
    [[nodiscard]] std::shared_ptr<const ShadowedLight>
    shadowed(const ActiveLight& light, std::shared_ptr<const ShadowedLight> known,
             ShadowDetail detail, const Obstacles& obstacles) const;

    using SeenGlows = std::vector<std::shared_ptr<const SeenGlow>>;

    [[nodiscard]] bool isCorrected(size_t light) const;
    std::vector<glm::vec3> bounced(std::span<const size_t> lights,
                                   std::span<const glm::vec3> albedo,
                                   std::span<const glm::vec3> sky, const SeenGlows& known);
    void findGlows(std::span<const size_t> lights, std::span<const glm::vec3> albedo,
                   std::span<const glm::vec3> direct, const SeenGlows& known);

    const Texels& texels_;
    const RayScene& scene_;
    const Transport& transport_;
    std::span<const std::vector<bool>> isClipped_;
    std::span<const float> lit_;
    size_t shadowRays_;
    RadiosityEngine engine_;

    std::vector<uint8_t> windowOpenings_;
    std::vector<std::shared_ptr<const ShadowedLight>> lights_;
    std::vector<glm::vec3> emissions_;
    SeenGlows glows_;                                        // of lights; null: it has none
    std::vector<glm::vec3> glowingAlbedo_;                   // that these have
    std::shared_ptr<const std::vector<glm::vec3>> indirect_; // irradiance on fronts
    std::vector<glm::vec3> onFronts_;                        // and direct light with it
};

} // namespace relamp
