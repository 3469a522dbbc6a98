#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace relamp
{

/// Follows bounces of light until what is to come is less than can be seen; what each adds is ever
/// less, at last by an even ratio, and the rest of such a series is known. Returns how many were
/// followed.
///
/// `sent` is the mean luminance of what surfaces send before the first. `bounce(step, weight)` lets
/// every `step`-th ray bring that, counted `weight` times, and returns the mean that is sent on.
template<class Bounce>
size_t followBounces(float sent, const Bounce& bounce)
{
    constexpr size_t kMost = 64;
    constexpr size_t kFewest = 3;     // before their series can be told
    constexpr float kUnseen = 0.01f;  // of all light
    constexpr float kSlowest = 0.95f; // ratio of a series that is believed
    // Of their rays, one that surfaces ask in the first bounces and all later ones: what is to come
    // is ever less, and ever more even.
    constexpr std::array<size_t, 3> kSteps{1, 2, 4};

    float all = sent;
    size_t bounces = 0;
    for (float last = sent; bounces < kMost && (bounces == 0 || last > 0.0f);) {
        const size_t step = kSteps[std::min(bounces, kSteps.size() - 1)];
        sent = bounce(step, 1.0f);
        const float ratio = std::min(sent / last, kSlowest);
        const float rest = sent * ratio / (1.0f - ratio);
        last = sent;
        all += sent;
        ++bounces;
        if (bounces < kFewest || rest > kUnseen * all) continue;
        // What is to come is the next again and again, each time a ratio of it.
        bounce(step, 1.0f / (1.0f - ratio));
        break;
    }
    return bounces;
}

} // namespace relamp
