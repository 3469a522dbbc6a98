#pragma once

#include "relamp/camera.h"

#include <tuple>

#include <glm/vec3.hpp>

/// Camera.arguments() of relamp/relit.py: position, unit forward, unit up, field of view.
using CameraArguments = std::tuple<std::tuple<float, float, float>, std::tuple<float, float, float>,
                                   std::tuple<float, float, float>, float>;

inline relamp::Camera cameraOf(const CameraArguments& given)
{
    const auto vectorOf = [](const std::tuple<float, float, float>& v) {
        return glm::vec3(std::get<0>(v), std::get<1>(v), std::get<2>(v));
    };
    return {.position = vectorOf(std::get<0>(given)),
            .forward = vectorOf(std::get<1>(given)),
            .up = vectorOf(std::get<2>(given)),
            .fieldOfView = std::get<3>(given)};
}
