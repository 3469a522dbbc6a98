#include "relamp/delighter.h"

#include "decomposition_state.h"
#include "relamp/error.h"
#include "scan/inside_out.h"
#include "scan/overlap.h"
#include "shading/enclosed_texels.h"
#include "solve/by_gather.h"
#include "solve/by_pathtrace.h"
#include "solve/find_room.h"
#include "thesis/by_thesis.h"

#include <cassert>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace relamp
{
namespace
{

/// The thesis filters within surfels, the others look about from each and need them small.
SurfelOptions surfelsFor(const DelightOptions& options)
{
    return options.solver == Solver::thesis ? SurfelOptions{} : surfelsOf(options.gather);
}

/// Before long work begins.
void checkEngine(const DelightOptions& options)
{
    if (options.solver != Solver::pathtrace) return checkDevice(options.engine);
    if (options.engine.engine != Engine::gpu && options.engine.gpu.empty()) return;
    throw Error(ErrorCode::unsupported,
                "paths are traced by the CPU alone: leave --engine and --gpu out, or take another "
                "solver");
}

} // namespace

struct Delighter::State
{
    explicit State(std::shared_ptr<const Scan> of) : scan(std::move(of)) {}

    void prepare(const DelightOptions& options, Progress& progress);
    Solution solve(const DelightOptions& options, Progress& progress);
    [[nodiscard]] Decomposition decompositionOf(Solution solution) const;

    std::shared_ptr<const Scan> scan; // outlives all below, which refers to it
    std::shared_ptr<const RayScene> scene;
    std::shared_ptr<const Texels> texels;
    SurfelOptions surfels;             // of `texels`
    std::optional<std::string> facing; // what is to say of which way they face
    std::optional<GatherSolver> gather;
    std::optional<ThesisSolver> thesis;
    Solver last = Solver::pathtrace; // that solved; nothing was: none that re-evaluates
};

/// Rays and texels, where they are not there yet. Solvers that know others go.
void Delighter::State::prepare(const DelightOptions& options, Progress& progress)
{
    if (!scene) {
        const Progress::Stage stage(progress, "bvh");
        scene = std::make_shared<const RayScene>(*scan);
    }
    const SurfelOptions wanted = surfelsFor(options);
    if (texels && surfels == wanted) return;
    gather.reset();
    thesis.reset();
    texels.reset();
    auto found = std::make_shared<Texels>(rasterizeAtlas(*scan, progress, wanted));
    checkOverlap(*found);
    if (options.solver != Solver::thesis) separateEnclosed(*found, *scene, progress);
    texels = std::move(found);
    surfels = wanted;
    facing = noteOnFacing(texels->surfels, *scene);
    gather.emplace(*texels, *scene);
    thesis.emplace(*texels, *scene);
}

Solution Delighter::State::solve(const DelightOptions& options, Progress& progress)
{
    switch (options.solver) {
    case Solver::thesis:
        return thesis->solve(options, progress);
    case Solver::pathtrace:
        return solveByPathtrace(*texels, *scene, options, progress);
    case Solver::gather:
        break;
    }
    return gather->solve(options, progress);
}

Decomposition Delighter::State::decompositionOf(Solution solution) const
{
    if (facing) solution.warnings.push_back(*facing);
    return Decomposition(std::make_unique<Decomposition::State>(
        Decomposition::State{scan, scene, texels, std::move(solution)}));
}

Delighter::Delighter(std::shared_ptr<const Scan> scan)
    : state_(std::make_unique<State>(std::move(scan)))
{
    assert(state_->scan);
}
Delighter::Delighter(Scan&& scan) : Delighter(std::make_shared<const Scan>(std::move(scan))) {}
Delighter::~Delighter() = default;
Delighter::Delighter(Delighter&&) noexcept = default;
Delighter& Delighter::operator=(Delighter&&) noexcept = default;

Decomposition Delighter::solve(const DelightOptions& options, Progress& progress)
{
    checkEngine(options);
    state_->prepare(options, progress);
    Solution solution = state_->solve(options, progress);
    state_->last = options.solver;
    return state_->decompositionOf(std::move(solution));
}

bool Delighter::canReevaluate() const
{
    return state_->last == Solver::gather && state_->gather && state_->gather->hasSolved();
}

Decomposition Delighter::reevaluate(const Lights& lights, const AlbedoOptions& albedo,
                                    Progress& progress)
{
    if (!canReevaluate())
        throw Error(ErrorCode::unsupported,
                    "lamps of a room can be changed when the solver gather has solved it");
    return state_->decompositionOf(state_->gather->reevaluate(lights, albedo, progress));
}

} // namespace relamp
