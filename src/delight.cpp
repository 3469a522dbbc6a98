#include "relamp/delight.h"

#include "albedo/page_layers.h"
#include "decomposition_state.h"
#include "fit/correction_map.h"
#include "lights/fixture_map.h"
#include "relamp/delighter.h"
#include "scan/overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace relamp
{

Decomposition delight(std::shared_ptr<const Scan> scan, const DelightOptions& options,
                      Progress& progress)
{
    return Delighter(std::move(scan)).solve(options, progress);
}

Decomposition delight(Scan&& scan, const DelightOptions& options, Progress& progress)
{
    return Delighter(std::move(scan)).solve(options, progress);
}

Decomposition::Decomposition(std::unique_ptr<State> state) : state_(std::move(state)) {}
Decomposition::~Decomposition() = default;
Decomposition::Decomposition(Decomposition&&) noexcept = default;
Decomposition& Decomposition::operator=(Decomposition&&) noexcept = default;

const std::shared_ptr<const Scan>& Decomposition::scan() const
{
    return state_->scan;
}

const Lights& Decomposition::lights() const
{
    return state_->solution.lights;
}

const std::vector<PointLight>& Decomposition::mergedLights() const
{
    return state_->solution.merged;
}

const std::vector<Opening>& Decomposition::openings() const
{
    return state_->solution.openings;
}

DelightOptions Decomposition::optionsInForce() const
{
    const Solution& solution = state_->solution;
    DelightOptions options = solution.options;
    options.engine = solution.engine ? solution.engine().engine : EngineOptions{Engine::cpu, "cpu"};
    return options;
}

const Closure& Decomposition::closure() const
{
    return state_->solution.closure;
}

const CrossValidation& Decomposition::crossValidation() const
{
    return state_->solution.crossValidation;
}

float CrossValidation::gain() const
{
    constexpr float kLeast = 1e-3f; // stops, that a texture of bytes tells
    return 20.0f * std::log10(std::max(scan, kLeast) / std::max(albedo, kLeast));
}

std::vector<std::string> Decomposition::warnings() const
{
    const Solution& solution = state_->solution;
    std::vector<std::string> warnings = solution.warnings;
    if (auto note = noteOn(state_->texels->overlap)) warnings.push_back(std::move(*note));
    if (!solution.engine) return warnings;
    if (std::string note = solution.engine().note; !note.empty())
        warnings.push_back(std::move(note));
    return warnings;
}

size_t Decomposition::texelCount() const
{
    return state_->texels->count();
}

double Decomposition::area() const
{
    return state_->texels->area;
}

PageGeometry Decomposition::geometry(size_t page) const
{
    const Image& image = state_->scan->pages[page].image;
    const PageTexels& texels = state_->texels->pages[page];
    PageGeometry geometry{image.width, image.height, std::vector<float>(3 * image.pixels()),
                          std::vector<float>(3 * image.pixels())};
    const TexelLoader loader(*state_->texels, page);
    forEachBlock(texels, [&](size_t begin, size_t count) {
        TexelBlock block;
        loader.loadGeometry(begin, count, block);
        for (size_t i = 0; i < count; ++i) {
            const size_t at = 3 * size_t{texels.pixel[begin + i]};
            std::copy_n(std::array{block.x[i], block.y[i], block.z[i]}.begin(), 3,
                        &geometry.positions[at]);
            std::copy_n(std::array{block.nx[i], block.ny[i], block.nz[i]}.begin(), 3,
                        &geometry.normals[at]);
        }
    });
    return geometry;
}

const Decomposition::State& Decomposition::state() const
{
    return *state_;
}

FixtureMap Decomposition::fixtures(size_t page) const
{
    const GlowMarks& glowing = state_->solution.glowing;
    return fixtureMapOf(*state_->texels, page, state_->solution.fixtureOf,
                        glowing.areNone() ? std::vector<bool>() : glowing.isGlowing[page]);
}

CorrectionMap Decomposition::correction(size_t page) const
{
    return correctionMapOf(*state_->texels, page, state_->solution.lit);
}

PageLayers Decomposition::layers(size_t page, Progress& progress) const
{
    const Solution& solution = state_->solution;
    const AlbedoOptions& options = solution.options.albedo;
    if (solution.onDevice)
        if (auto layers = solution.onDevice(page, solution.texels, options, progress))
            return std::move(*layers);
    return makeLayers(*state_->texels, page, solution.texels, options, progress);
}

} // namespace relamp
