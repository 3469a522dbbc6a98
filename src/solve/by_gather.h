#pragma once

#include "base/kept.h"
#include "scan/rays.h"
#include "scan/texels.h"
#include "solve/reevaluate.h"
#include "solve/reevaluate_engine.h"
#include "solve/solution.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// The default: lamps are what the walls say they are, direct light has area and shadows, and the
/// scan itself is the light field that bounce light is gathered from.
///
/// Keeps the room that it has solved, for other powers and options.
class GatherSolver
{
public:
    /// Both must outlive this and its solutions.
    GatherSolver(const Texels& texels, const RayScene& scene) : texels_(texels), scene_(scene) {}

    /// What rays met is kept from the last time where it is the same, and all but the division
    /// where only the albedo's options are others.
    Solution solve(const DelightOptions& options, Progress& progress);
    /// As Delighter::reevaluate(), on the engine of the options that solve() had.
    Solution reevaluate(const Lights& lights, const AlbedoOptions& albedo, Progress& progress);
    [[nodiscard]] bool hasSolved() const { return kept_.has_value(); }

private:
    /// A room, which may have other powers by now, and how its lamps were found.
    struct KeptRoom
    {
        SolvedRoom room;
        DelightOptions asked;
        Lights found;
        LampPowers powers; // that were found
        Kept<EngineOptions, std::shared_ptr<ReevaluateEngine>> engine;
    };

    [[nodiscard]] bool isOfKept(const DelightOptions& options) const;
    void keep(SolvedRoom room, const DelightOptions& asked,
              std::shared_ptr<ReevaluateEngine> engine);
    LampPowers setPowers(const Lights& lights);

    const Texels& texels_;
    const RayScene& scene_;
    std::optional<KeptRoom> kept_;
};

} // namespace relamp
