#pragma once

#include "base/kept.h"
#include "scan/rays.h"
#include "scan/texels.h"
#include "solve/solution.h"
#include "thesis/emitters.h"
#include "thesis/thesis_engine.h"
#include "thesis/thesis_shading.h"

#include <memory>
#include <vector>

namespace relamp
{

/// Choi's system: median cut of what is burnt out, point lights without shadows, bounce light by
/// RSM and LPV, ambient light; parameters that are left open follow from the scan.
///
/// Stages run again only where something that they depend on is not as it was the last time.
class ThesisSolver
{
public:
    /// Both must outlive this and its solutions.
    ThesisSolver(const Texels& texels, const RayScene& scene);

    Solution solve(const DelightOptions& options, Progress& progress);

private:
    struct Emission
    {
        SurfelLight light; // with the emitters of `lights`
        Lights lights;
    };

    const Emission& emissionOf(const ThesisOptions& thesis, Progress& progress);

    const Texels& texels_;
    const RayScene& scene_;
    ThesisStages stages_;
    Kept<std::vector<float>, Emission> emission_;
    Kept<EngineOptions, std::shared_ptr<ThesisEngine>> engine_;
};

} // namespace relamp
