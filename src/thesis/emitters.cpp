#include "thesis/emitters.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "image/burnt_out.shared.h"
#include "lights/shining.shared.h"
#include "thesis/expand.shared.h"

#include <algorithm>

namespace relamp
{
namespace
{

struct EmitterSum
{
    glm::vec3 plain{0.0f};
    float plainArea = 0.0f;
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};
    glm::vec3 intensity{0.0f};
    float weight = 0.0f; // luminance of intensity
    float area = 0.0f;
};

/// `clips`: the texture cannot hold more than white, so what is white may have been brighter.
void add(const TexelBlock& block, size_t i, bool clips, const EmitterOptions& options,
         EmitterSum& sum)
{
    const glm::vec3 radiance(block.r[i], block.g[i], block.b[i]);
    const float area = block.area[i];
    if (isEmitting(radiance, clips, options.threshold)) {
        const glm::vec3 intensity =
            area * (clips ? expanded(radiance, options.expansion) : radiance);
        const float weight = luminance(intensity);
        sum.position += weight * glm::vec3(block.x[i], block.y[i], block.z[i]);
        sum.normal += weight * glm::vec3(block.nx[i], block.ny[i], block.nz[i]);
        sum.intensity += intensity;
        sum.weight += weight;
        sum.area += area;
    } else if (!isBurntOut(radiance, clips)) {
        sum.plain += area * radiance;
        sum.plainArea += area;
    }
}

Emitter emitterFrom(const EmitterSum& sum, uint32_t surfel)
{
    Emitter emitter;
    emitter.position = sum.position / sum.weight;
    const float length = glm::length(sum.normal);
    emitter.normal = length > 0.0f ? sum.normal / length : glm::vec3(0.0f);
    emitter.intensity = sum.intensity;
    emitter.area = sum.area;
    emitter.surfel = surfel;
    return emitter;
}

/// A surfel that lies on two pages has an emitter of each; they are one.
void mergeSameSurfel(std::vector<Emitter>& emitters)
{
    std::stable_sort(emitters.begin(), emitters.end(),
                     [](const Emitter& a, const Emitter& b) { return a.surfel < b.surfel; });
    std::vector<Emitter> merged;
    for (const Emitter& e : emitters) {
        if (merged.empty() || merged.back().surfel != e.surfel) {
            merged.push_back(e);
            continue;
        }
        Emitter& m = merged.back();
        const float wm = luminance(m.intensity);
        const float we = luminance(e.intensity);
        m.position = (wm * m.position + we * e.position) / (wm + we);
        const glm::vec3 normal = wm * m.normal + we * e.normal;
        const float length = glm::length(normal);
        m.normal = length > 0.0f ? normal / length : glm::vec3(0.0f);
        m.intensity += e.intensity;
        m.area += e.area;
    }
    emitters = std::move(merged);
}

} // namespace

SurfelLight collectLight(const Texels& texels, const EmitterOptions& options, Progress& progress)
{
    const size_t surfels = texels.surfels.count();
    SurfelLight light;
    light.radiance.assign(surfels, glm::vec3(0.0f));
    light.area.assign(surfels, 0.0f);
    Progress::Stage stage(progress, "lights", texels.pages.size());
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        const PageTexels& page = texels.pages[p];
        const TexelLoader loader(texels, p);
        const bool clips = texels.scan->pages[p].image.clipsAtWhite;
        const size_t runs = page.runs.size() - 1;
        std::vector<EmitterSum> sums(runs);
        forEachRun(page, [&](size_t run, TexelBlock& block) {
            forEachBlockOfRun(page, run, [&](size_t begin, size_t count) {
                loader.load(begin, count, block);
                loader.loadArea(begin, count, block);
                for (size_t i = 0; i < count; ++i) add(block, i, clips, options, sums[run]);
            });
        });
        for (size_t run = 0; run < runs; ++run) {
            const uint32_t surfel = page.runs[run].surfel;
            light.radiance[surfel] += sums[run].plain;
            light.area[surfel] += sums[run].plainArea;
            if (sums[run].weight > 0.0f) light.emitters.push_back(emitterFrom(sums[run], surfel));
        }
        stage.advance();
    }
    for (size_t s = 0; s < surfels; ++s)
        if (light.area[s] > 0.0f) light.radiance[s] /= light.area[s];
    mergeSameSurfel(light.emitters);
    return light;
}

int joinFixtures(SurfelLight& light, const Texels& texels, const EmitterOptions& options)
{
    std::vector<Emitter>& emitters = light.emitters;
    const float reach = 1.75f * texels.surfels.size; // neighbouring cells, and across one empty
    std::vector<int> emitterOf(texels.surfels.count(), -1);
    for (size_t i = 0; i < emitters.size(); ++i)
        emitterOf[emitters[i].surfel] = static_cast<int>(i);
    DisjointSets sets(emitters.size());
    for (uint32_t i = 0; i < emitters.size(); ++i)
        texels.surfels.forEachInReach(emitters[i].position, [&](size_t surfel) {
            const int other = emitterOf[surfel];
            if (other < 0) return;
            const glm::vec3 way =
                emitters[static_cast<size_t>(other)].position - emitters[i].position;
            if (glm::dot(way, way) < reach * reach) sets.join(i, static_cast<uint32_t>(other));
        });

    std::vector<float> power(emitters.size(), 0.0f); // of each set, at its representative
    float total = 0.0f;
    for (uint32_t i = 0; i < emitters.size(); ++i) {
        power[sets.find(i)] += luminance(emitters[i].intensity);
        total += luminance(emitters[i].intensity);
    }
    std::vector<uint32_t> kept;
    for (uint32_t i = 0; i < emitters.size(); ++i)
        if (power[i] > options.leastPower * total) kept.push_back(i);
    std::stable_sort(kept.begin(), kept.end(),
                     [&](uint32_t a, uint32_t b) { return power[a] > power[b]; });

    std::vector<int> numberOf(emitters.size(), -1);
    for (size_t k = 0; k < kept.size(); ++k) numberOf[kept[k]] = static_cast<int>(k);
    for (uint32_t i = 0; i < emitters.size(); ++i) emitters[i].fixture = numberOf[sets.find(i)];
    std::erase_if(emitters, [](const Emitter& e) { return e.fixture < 0; });
    return static_cast<int>(kept.size());
}

} // namespace relamp
