#include "relight/radiosity_gpu.h"

#include "relight/follow_bounces.h"
#include "relight/radiosity.comp.h"
#include "relight/radiosity.gpu.h"
#include "relight/radiosity.shared.h"
#include "relight/radiosity_sides.comp.h"
#include "relight/radiosity_start.comp.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace relamp
{
namespace
{

constexpr float kMostOnDevice = 1e3f; // irradiance, radiance: far from both ends of halves

/// Sides in the order of their clusters, and where those begin.
struct Members
{
    std::vector<uint32_t> first;
    std::vector<uint32_t> sides;
};

Members membersOf(const Transport& transport)
{
    Members members;
    members.first.assign(transport.clusters() + 1, 0);
    for (const uint32_t cluster : transport.clusterOf) ++members.first[cluster + 1];
    std::partial_sum(members.first.begin(), members.first.end(), members.first.begin());
    std::vector<uint32_t> next = members.first;
    members.sides.resize(transport.sides.size());
    for (uint32_t side = 0; side < transport.sides.size(); ++side)
        members.sides[next[transport.clusterOf[side]]++] = side;
    return members;
}

std::vector<uint32_t> surfelsOf(const Transport& transport)
{
    std::vector<uint32_t> surfels;
    for (const Side side : transport.sides) surfels.push_back(side.surfel());
    return surfels;
}

std::vector<glm::vec4> scaled(std::span<const glm::vec3> values, float scale)
{
    std::vector<glm::vec4> entries;
    entries.reserve(values.size());
    for (const glm::vec3 value : values) entries.emplace_back(scale * value, 0.0f);
    return entries;
}

float mostOf(std::span<const glm::vec3> values)
{
    float most = 0.0f;
    for (const glm::vec3 v : values) most = std::max({most, v.r, v.g, v.b});
    return most;
}

} // namespace

RadiosityGpu::RadiosityGpu(const gpu::Device& device, const Transport& transport)
    : device_(device), gather_(device), start_(device, kRadiosityStartSpirv),
      bounce_(device, kRadiositySpirv), sides_(device, kRadiositySidesSpirv),
      clusters_(transport.clusters()), beyond_(Transport::radiancesBeyond()),
      ofClusters_(device, transport.ofClusters.first, transport.ofClusters.target),
      ofFronts_(device, transport.ofFronts.first, transport.ofFronts.target),
      firstMember_(device, membersOf(transport).first), member_(device, membersOf(transport).sides),
      clusterOf_(device, transport.clusterOf), surfel_(device, surfelsOf(transport)),
      weight_(device, transport.weight), albedo_(device, ofFronts_.count),
      direct_(device, transport.sides.size()), met_(device, transport.sides.size()),
      known_(device, ofFronts_.count), sky_(device, beyond_), albedoOfClusters_(device, clusters_),
      irradiance_(device, clusters_), sent_(device, clusters_ + beyond_),
      sentBySides_(device, transport.sides.size() + beyond_), arriving_(device, clusters_),
      onFronts_(device, ofFronts_.count),
      sums_(device, (clusters_ + start_.groupSize() - 1) / start_.groupSize()),
      readSums_(device, sums_.buffer().size(), gpu::Buffer::Place::host)
{}

void RadiosityGpu::setLight(std::span<const glm::vec3> direct, std::span<const glm::vec3> sky,
                            const KnownLight& known)
{
    const float most = std::max({mostOf(direct), mostOf(sky), mostOf(known.irradiance)});
    scale_ = most > 0.0f ? kMostOnDevice / most : 1.0f;
    direct_.upload(scaled(direct, scale_));
    std::vector<glm::vec3> met(direct.begin(), direct.end());
    for (size_t i = 0; i < known.direct.size(); ++i)
        met[i] = glm::max(met[i] - known.direct[i], 0.0f); // but for rounding
    met_.upload(scaled(met, scale_));
    std::vector<glm::vec4> onFronts = scaled(known.irradiance, scale_);
    onFronts.resize(known_.count(), glm::vec4(0.0f));
    known_.upload(onFronts);
    std::vector<glm::uvec2> bins(beyond_, glm::uvec2(0));
    for (size_t bin = 0; bin < sky.size(); ++bin)
        bins[bin] = packedHalves(glm::vec4(scale_ * sky[bin], 0.0f));
    sky_.upload(bins);
}

/// Runs the commands and adds up what clusters send after them.
float RadiosityGpu::meanSent(gpu::Commands& commands)
{
    commands.barrier();
    commands.copy(sums_.buffer(), 0, readSums_, 0, sums_.buffer().size());
    commands.run();
    std::vector<float> sums(sums_.count());
    std::memcpy(sums.data(), readSums_.bytes().data(), sums.size() * sizeof(float));
    const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
    return static_cast<float>(sum / static_cast<double>(clusters_));
}

float RadiosityGpu::start()
{
    const size_t skyBytes = sky_.buffer().size();
    gpu::Commands commands(device_);
    commands.dispatch(start_, clusters_,
                      RadiosityStartArguments{.firstMember = firstMember_.ref(),
                                              .member = member_.ref(),
                                              .weight = weight_.ref(),
                                              .surfel = surfel_.ref(),
                                              .albedo = albedo_.ref(),
                                              .direct = direct_.ref(),
                                              .ofClusters = albedoOfClusters_.ref(),
                                              .irradiance = irradiance_.ref(),
                                              .sent = sent_.ref(),
                                              .sums = sums_.ref(),
                                              .count = static_cast<uint32_t>(clusters_)});
    commands.copy(sky_.buffer(), 0, sent_.buffer(), sent_.buffer().size() - skyBytes, skyBytes);
    commands.copy(sky_.buffer(), 0, sentBySides_.buffer(), sentBySides_.buffer().size() - skyBytes,
                  skyBytes);
    return meanSent(commands);
}

/// Lets everything receive what was sent, which counts `weight` times, and send it on. Returns the
/// mean of that.
float RadiosityGpu::bounceOnce(size_t step, float weight)
{
    gpu::Commands commands(device_);
    gather_.gather(commands, ofClusters_, sent_, arriving_, clusters_, step);
    commands.dispatch(bounce_, sent_.count(),
                      RadiosityArguments{.albedo = albedoOfClusters_.ref(),
                                         .arriving = arriving_.irradiance.ref(),
                                         .irradiance = irradiance_.ref(),
                                         .sent = sent_.ref(),
                                         .sums = sums_.ref(),
                                         .weight = weight,
                                         .count = static_cast<uint32_t>(clusters_),
                                         .sending = static_cast<uint32_t>(sent_.count())});
    return meanSent(commands);
}

/// What the first `count` sides send of their own direct light and of what comes from others.
void RadiosityGpu::send(gpu::Commands& commands, const gpu::Array<glm::vec4>& irradiance,
                        bool ofClusters, size_t count)
{
    commands.dispatch(sides_, count,
                      RadiositySidesArguments{.clusterOf = clusterOf_.ref(),
                                              .surfel = surfel_.ref(),
                                              .albedo = albedo_.ref(),
                                              .direct = met_.ref(),
                                              .irradiance = irradiance.ref(),
                                              .known = known_.ref(),
                                              .sent = sentBySides_.ref(),
                                              .ofClusters = ofClusters ? 1u : 0u,
                                              .count = static_cast<uint32_t>(count)});
    commands.barrier();
}

/// The last two ways, between the sides themselves.
void RadiosityGpu::arrive()
{
    gpu::Commands commands(device_);
    const size_t fronts = ofFronts_.count;
    send(commands, irradiance_, true, clusterOf_.count());
    gather_.gather(commands, ofFronts_, sentBySides_, onFronts_, fronts, kStepOfSides);
    send(commands, onFronts_.irradiance, false, fronts);
    gather_.gather(commands, ofFronts_, sentBySides_, onFronts_, fronts);
    commands.run();
}

Bounced RadiosityGpu::bounce(std::span<const glm::vec3> albedo, std::span<const glm::vec3> direct,
                             std::span<const glm::vec3> sky, const KnownLight& known)
{
    albedo_.upload(scaled(albedo, 1.0f));
    setLight(direct, sky, known);
    const size_t bounces =
        followBounces(start(), [&](size_t step, float weight) { return bounceOnce(step, weight); });
    arrive();
    Bounced bounced{.bounces = bounces};
    for (const glm::vec4 arriving : onFronts_.irradiance.download()) {
        bounced.irradiance.push_back(glm::vec3(arriving) / scale_);
        bounced.noise.push_back(arriving.w / scale_);
    }
    return bounced;
}

} // namespace relamp
