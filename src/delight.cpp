#include "relamp/delight.h"

#include "albedo/page_layers.h"
#include "decomposition_state.h"
#include "relamp/error.h"
#include "shading/buried.h"
#include "solve/by_gather.h"
#include "solve/by_pathtrace.h"
#include "solve/by_thesis.h"
#include "solve/found_room.h"

#include <utility>

namespace relamp
{

namespace
{

/// The thesis filters within surfels, the others look about from each and need them small.
SurfelOptions surfelsFor(const DelightOptions& options)
{
    return options.solver == Solver::thesis ? SurfelOptions{} : surfelsOf(options.gather.quality);
}

std::unique_ptr<Decomposition::State> stateOf(const Scan& scan, Progress& progress)
{
    const Progress::Stage stage(progress, "bvh");
    return std::make_unique<Decomposition::State>(scan);
}

auto solverOf(Solver solver)
{
    switch (solver) {
    case Solver::thesis:
        return solveByThesis;
    case Solver::pathtrace:
        return solveByPathtrace;
    case Solver::gather:
        break;
    }
    return solveByGather;
}

void checkEngine(const DelightOptions& options)
{
    if (options.solver == Solver::thesis) return;
    if (options.engine.engine != Engine::gpu && options.engine.gpu.empty()) return;
    throw Error(ErrorCode::unsupported,
                "the GPU computes the thesis solver alone: leave --engine and --gpu out, or take "
                "--solver thesis");
}

} // namespace

Decomposition delight(const Scan& scan, const DelightOptions& options, Progress& progress)
{
    checkEngine(options);
    auto state = stateOf(scan, progress);
    state->texels = rasterizeAtlas(scan, progress, surfelsFor(options));
    checkOverlap(state->texels);
    if (options.solver != Solver::thesis) separateBuried(state->texels, state->scene, progress);
    state->solution = solverOf(options.solver)(state->texels, state->scene, options, progress);
    return Decomposition(std::move(state));
}

Decomposition::Decomposition(std::unique_ptr<State> state) : state_(std::move(state)) {}
Decomposition::~Decomposition() = default;
Decomposition::Decomposition(Decomposition&&) noexcept = default;
Decomposition& Decomposition::operator=(Decomposition&&) noexcept = default;

const Lights& Decomposition::lights() const
{
    return state_->solution.lights;
}

const std::vector<PointLight>& Decomposition::mergedLights() const
{
    return state_->solution.merged;
}

const DelightOptions& Decomposition::optionsInForce() const
{
    return state_->solution.options;
}

const Closure& Decomposition::closure() const
{
    return state_->solution.closure;
}

const std::vector<std::string>& Decomposition::warnings() const
{
    return state_->solution.warnings;
}

size_t Decomposition::texelCount() const
{
    return state_->texels.count();
}

double Decomposition::area() const
{
    return state_->texels.area;
}

const Decomposition::State& Decomposition::state() const
{
    return *state_;
}

PageLayers Decomposition::layers(size_t page, Progress& progress) const
{
    const Solution& solution = state_->solution;
    return makeLayers(state_->texels, page,
                      {solution.shade, solution.shining, solution.trust, solution.fill},
                      solution.options.albedo, progress);
}

} // namespace relamp
