#include "lights/area_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace relamp
{

AreaLight::AreaLight(std::vector<ClippedPatch> patches) : patches_(std::move(patches))
{
    float area = 0.0f;
    for (const ClippedPatch& patch : patches_) {
        area += patch.area;
        areaUpTo_.push_back(area);
        centre_ += patch.area * patch.position;
    }
    centre_ /= area;
    firstOfShare_.resize(patches_.size());
    for (size_t step = 0, first = 0; step < patches_.size(); ++step) {
        const float share = static_cast<float>(step) / static_cast<float>(patches_.size());
        while (first + 1 < patches_.size() && areaUpTo_[first] < share * area) ++first;
        firstOfShare_[step] = static_cast<uint32_t>(first);
    }
    for (const ClippedPatch& patch : patches_)
        radius_ = std::max(radius_, glm::distance(patch.position, centre_) + std::sqrt(patch.area));
}

} // namespace relamp
