#pragma once

#include "relamp/relight.h"
#include "scenes/radiosity.h"

#include <string>

namespace relamp::scenes
{

/// An empty room under one ceiling panel. A white sheet on a grey wall is burnt out like the panel,
/// but only reflects.
struct LitRoom
{
    static constexpr glm::vec3 kSize{4.0f, 2.5f, 5.0f};
    static constexpr glm::vec3 kLampRadiance{40.0f, 36.0f, 30.0f};
    static constexpr float kLampArea = 0.48f; // m^2
    static constexpr glm::vec3 kLampCentre{1.0f, 2.5f, 2.4f};
    static constexpr glm::vec3 kSheetCentre{0.0f, 1.4f, 2.5f}; // on the wall x = 0

    LitBox box;
    Scan scan; // a photo of it

    LitRoom();

    static glm::vec3 albedo(glm::vec3 place, glm::vec3 normal);
};

constexpr int kLitRoomPanel = 7; // the panel's number in litDelitRoom()

/// The same room without its light, and its panel as a fixture of this name.
DelitRoom litDelitRoom(const std::string& panel);

} // namespace relamp::scenes
