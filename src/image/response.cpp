#include "image/response.h"

#include "image/burnt_out.shared.h"

#include <algorithm>
#include <cmath>

namespace relamp
{
namespace
{

constexpr float kDarkest = 1e-6f; // below, as good as black

} // namespace

std::array<float, Response::kKnots> slopeAt(float texture)
{
    const float x = std::log2(std::max(texture, kDarkest));
    std::array<float, Response::kKnots> part{};
    if (x <= Response::kAt.front()) {
        part.front() = 1.0f;
        return part;
    }
    size_t k = 1;
    while (k + 1 < Response::kKnots && x > Response::kAt[k]) ++k;
    const float width = Response::kAt[k] - Response::kAt[k - 1];
    const float right = std::min((x - Response::kAt[k - 1]) / width, 1.0f);
    part[k - 1] = 1.0f - right;
    part[k] = right;
    return part;
}

std::array<float, Response::kKnots> bendAt(float texture)
{
    constexpr float kLn2 = 0.6931472f;
    const float x = std::min(std::log2(std::max(texture, kDarkest)), Response::kAt.back());
    std::array<float, Response::kKnots> part{};
    for (size_t k = Response::kKnots - 1; k > 0; --k) {
        const float left = Response::kAt[k - 1];
        const float width = Response::kAt[k] - left;
        const float from = std::clamp((x - left) / width, 0.0f, 1.0f); // integrate from here to 1
        part[k] -= kLn2 * width * 0.5f * (1.0f - from * from);
        part[k - 1] -= kLn2 * width * 0.5f * (1.0f - from) * (1.0f - from);
    }
    part.front() -= kLn2 * std::max(Response::kAt.front() - x, 0.0f);
    return part;
}

float Response::contrast() const
{
    float sum = 0.0f;
    for (size_t k = 1; k + 1 < kKnots; ++k) sum += slope[k];
    return static_cast<float>(kKnots - 2) / sum;
}

float Response::operator()(float texture) const
{
    if (isStraight() || texture <= 0.0f || texture >= kBurntOut) return texture;
    const std::array<float, kKnots> bend = bendAt(texture);
    float log = 0.0f;
    for (size_t k = 0; k < kKnots; ++k) log += slope[k] * bend[k];
    return std::min(std::exp(log), kBrightestPlain);
}

} // namespace relamp
