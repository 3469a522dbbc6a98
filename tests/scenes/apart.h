#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp::scenes
{

/// How far the engines are apart, as shares of the CPU's values; halves round at 1/2048.
class Apart
{
public:
    explicit Apart(float least) : least_(least) {}

    void add(glm::vec3 ofGpu, glm::vec3 ofCpu)
    {
        for (int c = 0; c < 3; ++c)
            shares_.push_back(std::abs(ofGpu[c] - ofCpu[c]) / std::max(ofCpu[c], least_));
    }
    [[nodiscard]] float most() const { return *std::max_element(shares_.begin(), shares_.end()); }
    /// Share of values that are further apart than `far`.
    [[nodiscard]] double beyond(float far) const
    {
        const auto count =
            std::count_if(shares_.begin(), shares_.end(), [&](float s) { return s > far; });
        return static_cast<double>(count) / static_cast<double>(shares_.size());
    }

private:
    float least_; // smaller values are compared as if they were this
    std::vector<float> shares_;
};

} // namespace relamp::scenes
